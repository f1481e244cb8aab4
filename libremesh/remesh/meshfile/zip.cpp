// ZIP files as far as packages of XML use them: parts that are stored or deflated, also beyond 4 GB
// (format: PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", version 6.3). Sizes are those of
// the directory; none of them is believed.

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"

namespace remesh {
namespace {

constexpr std::string_view local_mark = "PK\3\4", entry_mark = "PK\1\2", end_mark = "PK\5\6",
                           large_end_mark = "PK\6\6", large_place_mark = "PK\6\7";
constexpr std::size_t local_size = 30, entry_size = 46, end_size = 22, large_place_size = 20,
                      large_end_size = 56, longest_comment = 65535;
constexpr std::uint64_t in_large_numbers = 0xFFFFFFFF;  // The number has eight bytes elsewhere.
constexpr std::uint16_t encrypted = 1, stored = 0, deflated = 8;
constexpr const char* zip_again = "; save the file again";

constexpr std::uint16_t zip_version = 20;      // Of the format, which deflated parts need.
constexpr std::uint16_t first_of_1980 = 0x21;  // Times would make different bytes in each run.

}  // namespace

ZipArchive::ZipArchive(SourceFile& file) : file_(file) {
    file.is_binary = true;
    const std::string_view bytes = file.bytes;
    if (!bytes.starts_with("PK")) {
        file_.fail_malformed(
            0, "this is not a ZIP file, as it does not begin with 'PK'; check its extension");
    }
    const std::size_t first = bytes.size() - std::min(bytes.size(), end_size + longest_comment);
    const std::size_t found = bytes.substr(first).rfind(end_mark);
    if (found == std::string_view::npos || first + found + end_size > bytes.size()) {
        file_.fail_malformed(
            bytes.size(), "there is no directory at the end; the file is truncated: save it again");
    }
    const std::size_t end = first + found;
    std::uint64_t size = number(end + 12, 4), begin = number(end + 16, 4);
    if (end >= large_place_size &&
        bytes.substr(end - large_place_size).starts_with(large_place_mark)) {
        const std::uint64_t large_end = number(end - large_place_size + 8, 8);
        require(large_end, large_end_size, "the end of the directory");
        require_mark(large_end, large_end_mark, "the end of the directory");
        size = number(large_end + 40, 8);
        begin = number(large_end + 48, 8);
    }
    read_directory(begin, size);
}

SourceFile ZipArchive::read(const std::string& name) const {
    const auto found = entries_.find(in_lower_case(name));
    if (found == entries_.end()) {
        file_.fail_malformed(file_.bytes.size(), "the package has no part ", in_quotes(name),
                             zip_again);
    }
    const Entry& entry = found->second;
    const std::string of_part = "part " + in_quotes(name);
    SourceFile part{.path = file_.path.string() + ": " + name,
                    .bytes = {},
                    .is_lenient = file_.is_lenient,
                    .with_attributes = file_.with_attributes,
                    .ticker = file_.ticker};
    if ((entry.flags & encrypted) != 0) {
        file_.fail_malformed(entry.header, of_part, " is encrypted; save the file without");
    }
    if (entry.method != stored && entry.method != deflated) {
        file_.fail_malformed(entry.header, of_part, " is compressed by method ", entry.method,
                             ", which is not supported; pack the file anew");
    }
    const std::string_view bytes = packed(entry);
    bool is_whole = true;
    if (entry.method == deflated) {
        is_whole = append_unpacked(bytes, DeflatedIn::Zip, entry.size, part.ticker, part.bytes);
    } else {
        part.ticker.poll();
        part.bytes = bytes;
    }
    if (!is_whole || part.bytes.size() != entry.size || crc32_of(part.bytes) != entry.checksum) {
        file_.fail_malformed(entry.header, of_part, " is damaged", zip_again);
    }
    return part;
}

void ZipArchive::read_directory(std::uint64_t begin, std::uint64_t size) {
    require(begin, size, "the directory");
    Ticker ticker = file_.ticker;
    const std::uint64_t end = begin + size;
    for (std::uint64_t at = begin; at < end;) {
        ticker.tick(16);
        require(at, entry_size, "an entry of the directory");
        require_mark(at, entry_mark, "an entry of the directory");
        const std::uint64_t name_size = number(at + 28, 2), extra_size = number(at + 30, 2),
                            comment_size = number(at + 32, 2);
        require(at, entry_size + name_size + extra_size + comment_size,
                "an entry of the directory");
        Entry entry{.flags = number(at + 8, 2),
                    .method = number(at + 10, 2),
                    .checksum = number(at + 16, 4),
                    .packed_size = number(at + 20, 4),
                    .size = number(at + 24, 4),
                    .header = number(at + 42, 4)};
        const std::uint64_t name_begin = at + entry_size, extra = name_begin + name_size;
        take_large_numbers(extra, extra + extra_size, entry);
        const std::string_view name = std::string_view(file_.bytes).substr(name_begin, name_size);
        if (!entries_.emplace(in_lower_case(name), entry).second) {
            file_.fail_malformed(at, "there are two parts ", in_quotes(name), zip_again);
        }
        at = extra + extra_size + comment_size;
    }
}

void ZipArchive::require(std::uint64_t begin, std::uint64_t size, const char* what) const {
    if (begin <= file_.bytes.size() && size <= file_.bytes.size() - begin) return;
    file_.fail_malformed(file_.bytes.size(), "the file ends within ", what,
                         "; it is truncated or damaged: save it again");
}

void ZipArchive::require_mark(std::uint64_t begin, std::string_view mark, const char* what) const {
    if (std::string_view(file_.bytes).substr(begin).starts_with(mark)) return;
    file_.fail_malformed(begin, "here is not ", what, zip_again);
}

std::uint64_t ZipArchive::number(std::uint64_t at, std::size_t num_bytes) const {
    std::uint64_t value = 0;
    for (std::size_t k = num_bytes; k-- > 0;) {
        value = value << 8 | static_cast<unsigned char>(file_.bytes[at + k]);
    }
    return value;
}

// Of all fields of an entry the one with the mark 1 has the numbers that need eight bytes.
void ZipArchive::take_large_numbers(std::uint64_t begin, std::uint64_t end, Entry& entry) const {
    for (std::uint64_t at = begin; at + 4 <= end;) {
        const std::uint64_t mark = number(at, 2), field_end = at + 4 + number(at + 2, 2);
        if (field_end > end) return;
        at += 4;
        for (std::uint64_t* value : {&entry.size, &entry.packed_size, &entry.header}) {
            if (mark != 1 || *value != in_large_numbers || at + 8 > field_end) continue;
            *value = number(at, 8);
            at += 8;
        }
        at = field_end;
    }
}

std::string_view ZipArchive::packed(const Entry& entry) const {
    constexpr const char* what = "a part";
    require(entry.header, local_size, what);
    require_mark(entry.header, local_mark, "the begin of a part");
    const std::uint64_t begin =
        entry.header + local_size + number(entry.header + 26, 2) + number(entry.header + 28, 2);
    require(begin, entry.packed_size, what);
    return std::string_view(file_.bytes).substr(begin, entry.packed_size);
}

std::string pack_zip(const std::vector<std::pair<std::string, std::string>>& parts,
                     Ticker& ticker) {
    std::string bytes, directory;
    const auto require_size = [](std::size_t size) {
        if (size < UINT32_MAX) return;
        throw InvalidInput("the mesh is too large for a ZIP file of 4 GB; write .ply");
    };
    constexpr std::uint16_t none = 0;
    for (const auto& [name, content] : parts) {
        require_size(content.size());
        const std::string packed = pack_for_zip(content, ticker);
        require_size(bytes.size() + packed.size());
        // The same in both places; no flags, at midnight, no further fields.
        std::string fields;
        append_all(fields, zip_version, none, deflated, none, first_of_1980, crc32_of(content),
                   static_cast<std::uint32_t>(packed.size()),
                   static_cast<std::uint32_t>(content.size()),
                   static_cast<std::uint16_t>(name.size()), none);
        directory += entry_mark;
        append_all(directory, zip_version);
        directory += fields;
        directory.append(10, '\0');  // No comment, the first disk, no attributes.
        append_all(directory, static_cast<std::uint32_t>(bytes.size()));
        directory += name;
        bytes.append(local_mark).append(fields).append(name).append(packed);
    }
    require_size(bytes.size() + directory.size());
    const auto begin = static_cast<std::uint32_t>(bytes.size());
    const auto num_parts = static_cast<std::uint16_t>(parts.size());
    bytes.append(directory).append(end_mark);
    append_all(bytes, none, none, num_parts, num_parts,
               static_cast<std::uint32_t>(directory.size()), begin, none);
    return bytes;
}

}  // namespace remesh
