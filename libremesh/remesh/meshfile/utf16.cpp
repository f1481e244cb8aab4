#include "remesh/meshfile/utf16.h"

#include <cstdint>

#include "remesh/meshfile/byte_order.h"

namespace remesh {
namespace {

void append_utf8(std::uint32_t code, std::string& text) {
    const auto rest = [&](int shift) { text += static_cast<char>(0x80 | (code >> shift & 0x3F)); };
    if (code < 0x80) {
        text += static_cast<char>(code);
    } else if (code < 0x800) {
        text += static_cast<char>(0xC0 | code >> 6);
        rest(0);
    } else if (code < 0x10000) {
        text += static_cast<char>(0xE0 | code >> 12);
        rest(6);
        rest(0);
    } else {
        text += static_cast<char>(0xF0 | code >> 18);
        rest(12);
        rest(6);
        rest(0);
    }
}

}  // namespace

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

}  // namespace remesh
