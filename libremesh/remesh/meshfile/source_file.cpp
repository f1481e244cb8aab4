// Loads a whole file, or what a pipe delivers, into memory; texts in UTF-16 become UTF-8. The size
// of a regular file is known; a device or a pipe may never end and has a limit.
#include "remesh/meshfile/source_file.h"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/system_file.h"

namespace remesh {
namespace {

void append_utf8(std::uint32_t code, std::string& text) {
    const int num_more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    constexpr std::uint32_t marks[] = {0, 0xC0, 0xE0, 0xF0};
    text += static_cast<char>(marks[num_more] | code >> (6 * num_more));
    for (int k = num_more; k-- > 0;) text += static_cast<char>(0x80 | (code >> (6 * k) & 0x3F));
}

// The byte order of a text in UTF-16 with a byte order mark; nothing if the bytes are something
// else.
std::optional<std::endian> utf16_order(std::string_view bytes) {
    if (bytes.size() % 2 != 0) return std::nullopt;
    std::optional<std::endian> order;
    if (bytes.starts_with("\xFF\xFE")) order = std::endian::little;
    if (bytes.starts_with("\xFE\xFF")) order = std::endian::big;
    // A binary file may begin like that, but it soon has a zero.
    for (std::size_t i = 2; order && i < std::min<std::size_t>(bytes.size(), 80); i += 2) {
        if (load<std::uint16_t>(&bytes[i], *order) == 0) return std::nullopt;
    }
    return order;
}

// The text in UTF-8, without its mark. Half a pair of surrogates becomes '?'.
std::string utf8_of_utf16(std::string_view bytes, std::endian order, Ticker ticker) {
    std::string text;
    text.reserve(bytes.size() / 2);
    const auto unit = [&](std::size_t i) -> std::uint32_t {
        return i + 1 < bytes.size() ? load<std::uint16_t>(&bytes[i], order) : 0u;
    };
    for (std::size_t i = 2; i < bytes.size(); i += 2) {
        ticker.tick();
        std::uint32_t code = unit(i);
        if (code >> 11 == 0xD800 >> 11) {
            const std::uint32_t second = unit(i + 2);
            const bool is_pair = code < 0xDC00 && second >> 10 == 0xDC00 >> 10;
            code = is_pair ? 0x10000 + ((code & 0x3FF) << 10 | (second & 0x3FF)) : '?';
            if (is_pair) i += 2;
        }
        append_utf8(code, text);
    }
    return text;
}

[[noreturn]] void fail_to_read(const std::filesystem::path& path, int reason) {
    throw IoError(joined(path.string(),
                         ": cannot be read: ", std::generic_category().message(reason),
                         "; check its name and permissions"));
}

// Closes what it opened, but not the standard input.
struct Descriptor {
    int fd;
    bool is_ours;
    ~Descriptor() {
        if (fd >= 0 && is_ours) ::close(fd);
    }
};

Descriptor open_for_reading(const std::filesystem::path& path) {
    if (is_standard_input(path)) return {STDIN_FILENO, false};
    return {open_to_read(path), true};
}

void wait_for_bytes(int fd, Poller& poller) {
    do {
        poller.poll();
    } while (!wait_to_read(fd));
}

// How many bytes are read before a file counts as one that never ends. Devices that end are
// terminals; a pipe may bring a mesh of some ten million faces.
std::size_t most_bytes(int fd, const struct stat& status) {
    if (S_ISREG(status.st_mode)) return std::numeric_limits<std::size_t>::max() / 2;
    constexpr std::size_t of_device = std::size_t{1} << 24, of_pipe = std::size_t{1} << 31;
    return S_ISCHR(status.st_mode) && ::isatty(fd) == 0 ? of_device : of_pipe;
}

}  // namespace

std::string SourceFile::place(std::size_t offset) const {
    const std::string_view before = std::string_view(bytes).substr(0, offset);
    if (is_binary) return path.string() + ": byte " + std::to_string(before.size()) + ": ";
    std::size_t line = 1;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool is_crlf = before[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
        if (before[i] == '\n' || (before[i] == '\r' && !is_crlf)) ++line;
    }
    return path.string() + ": line " + std::to_string(line) + ": ";
}

std::string SourceFile::judge_rest(std::size_t offset, const std::string& kind,
                                   std::uint64_t num_announced, std::uint64_t num_more) const {
    constexpr const char* blanks = " \t\r\n\v\f";
    if (!is_binary) offset = std::min(bytes.find_first_not_of(blanks, offset), bytes.size());
    if (offset >= bytes.size()) return {};
    // In a text an element begins with a number; anything else is a remark.
    constexpr std::string_view begins = "+-.0123456789";
    if (!is_binary && begins.find(bytes[offset]) != std::string_view::npos) {
        for (std::size_t at = offset; at < bytes.size(); ++num_more) {
            at = bytes.find_first_not_of(blanks, std::min(bytes.find('\n', at), bytes.size()));
        }
    }
    if (num_more == 0) {
        return joined(place(offset), "the ", bytes.size() - offset,
                      " bytes after the last element are ignored");
    }
    const std::string text = joined("the header announces ", num_announced, " ", kind,
                                    ", the file holds ", num_announced + num_more);
    if (!is_lenient) {
        fail_malformed(offset, text,
                       "; export the file again, or read only what the header announces (remesh "
                       "and agvd diagram: --lenient)");
    }
    return place(offset) + text + "; the others are ignored";
}

SourceFile load_file(const std::filesystem::path& path, Poller& poller) {
    const Descriptor in = open_for_reading(path);
    if (in.fd < 0) fail_to_read(path, errno);
    struct stat status {};
    if (::fstat(in.fd, &status) != 0) fail_to_read(path, errno);
    if (S_ISDIR(status.st_mode)) fail_to_read(path, EISDIR);
    const std::size_t most = most_bytes(in.fd, status);

    // One byte more than the size, so that the end is seen without a second growth. The size of a
    // pipe is unknown: its buffer grows.
    std::string bytes(static_cast<std::size_t>(std::max<off_t>(status.st_size, 1 << 16)) + 1, '\0');
    std::size_t length = 0;
    while (true) {
        constexpr std::size_t most_at_once = 1 << 24;  // Some milliseconds.
        wait_for_bytes(in.fd, poller);
        const auto num = static_cast<unsigned>(std::min(most_at_once, bytes.size() - length));
        const ssize_t got = ::read(in.fd, bytes.data() + length, num);
        if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (got < 0) fail_to_read(path, errno);
        if (got == 0) break;
        length += static_cast<std::size_t>(got);
        if (length > most) {
            throw IoError(
                joined(path.string(), ": the file does not end within ", most >> 20,
                       " MB; name a file that ends, or save what a pipe brings to a file"));
        }
        if (length == bytes.size()) bytes.resize(std::min(2 * length, most + 1));
    }
    bytes.resize(length);
    return take_bytes(path, std::move(bytes), poller);
}

SourceFile take_bytes(const std::filesystem::path& path, std::string bytes, Poller& poller) {
    SourceFile file{.path = path, .bytes = std::move(bytes), .ticker = Ticker(poller)};
    if (file.bytes.empty()) {
        throw IoError(joined(path.string(), ": the file is empty; export the file again"));
    }
    if (const auto order = utf16_order(file.bytes)) {
        file.bytes = utf8_of_utf16(file.bytes, *order, file.ticker);
    }
    return file;
}

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    // Not std::tolower, which depends on the locale.
    for (char& c : lower) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

std::string without_escapes(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned char code = 0;
        const char* const digits = text.data() + i + 1;
        const bool is_code = text[i] == '%' && i + 2 < text.size() &&
                             std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        plain += is_code ? static_cast<char>(code) : text[i];
        if (is_code) i += 2;
    }
    return plain;
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown = "'";
    for (const char c : text.substr(0, longest)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > longest ? "...'" : "'");
}

}  // namespace remesh
