#include "remesh/meshfile/byte_source.h"

#include <array>

namespace remesh {
namespace {

constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> base64_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(no_digit);
    for (std::size_t i = 0; i < base64_digits.size(); ++i) {
        values[static_cast<unsigned char>(base64_digits[i])] = static_cast<std::uint8_t>(i);
    }
    return values;
}();

}  // namespace

std::optional<std::string_view> ByteSource::take(std::uint64_t count, std::string& buffer,
                                                 Ticker& ticker) {
    if (count > left_.size() + group_.size()) return std::nullopt;
    const auto size = static_cast<std::size_t>(count);
    if (!is_base64_) {
        const std::string_view bytes = left_.substr(0, size);
        left_.remove_prefix(size);
        return bytes;
    }
    buffer.clear();
    buffer.reserve(size);
    while (buffer.size() < size) {
        ticker.tick();
        if (group_.empty() && !decode_group()) return std::nullopt;
        const std::size_t taken = std::min(group_.size(), size - buffer.size());
        buffer.append(group_, 0, taken);
        group_.erase(0, taken);
    }
    return buffer;
}

bool ByteSource::is_at_end() {
    skip_blanks();
    return left_.empty() && group_.empty();
}

// Four digits make three bytes; "xx==" makes one, "xxx=" two.
bool ByteSource::decode_group() {
    std::uint32_t bits = 0;
    std::size_t num_digits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        skip_blanks();
        if (left_.empty()) return false;
        const char c = left_.front();
        left_.remove_prefix(1);
        const std::uint8_t value = base64_values[static_cast<unsigned char>(c)];
        const bool is_filled = num_digits < k;
        if (value == no_digit ? c != '=' || k < 2 : is_filled) return false;
        if (value != no_digit) ++num_digits;
        bits = bits << 6 | value % no_digit;
    }
    for (std::size_t k = 1; k < num_digits; ++k) {
        group_ += static_cast<char>(bits >> (8 * (3 - k)) & 255);
    }
    return true;
}

void ByteSource::skip_blanks() {
    left_.remove_prefix(std::min(left_.find_first_not_of(" \t\r\n"), left_.size()));
}

std::string in_base64(std::string_view bytes, Ticker& ticker) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        ticker.tick();
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + 3; ++k) {
            bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? base64_digits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

}  // namespace remesh
