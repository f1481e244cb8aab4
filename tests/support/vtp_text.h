//! \file
//! Builds VTK's XML files in every encoding, for tests of their reader.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "remesh/meshfile/packed.h"

struct VtpStyle {
    enum Encoding { Ascii, Binary, Base64, Raw };  // Base64 and Raw: appended.
    static constexpr std::uint32_t block_size = 16;

    Encoding encoding = Ascii;
    std::endian order = std::endian::little;
    bool is_wide = false;    // Headers of 64 bits.
    bool is_packed = false;  // Compressed.

    [[nodiscard]] bool is_appended() const { return encoding >= Base64; }
    [[nodiscard]] std::string name() const {
        constexpr const char* names[] = {"ascii", "binary", "base64", "raw"};
        return std::string(names[encoding]) + (order == std::endian::big ? ", big endian" : "") +
               (is_wide ? ", 64 bits" : "") + (is_packed ? ", compressed" : "");
    }
};

class VtpText {
public:
    explicit VtpText(const VtpStyle& style, const std::string& type = "PolyData") : style_(style) {
        const bool is_big = style.order == std::endian::big;
        text_ = "<?xml version='1.0'?>\n<VTKFile type='" + type + "' version='1.0' byte_order='" +
                (is_big ? "BigEndian" : "LittleEndian") + "' header_type='" +
                (style.is_wide ? "UInt64" : "UInt32") + "'" +
                (style.is_packed ? " compressor='vtkZLibDataCompressor'" : "") + ">\n";
    }

    void add(const std::string& text) { text_ += text + "\n"; }

    template <typename T>
    void array(const std::string& attributes, const std::vector<T>& values) {
        constexpr const char* formats[] = {"ascii", "binary", "appended", "appended"};
        text_ += "<DataArray " + attributes + " format='" + formats[style_.encoding] + "'";
        if (style_.is_appended()) text_ += " offset='" + std::to_string(appended_.size()) + "'";
        // VTK has keys of its pipeline behind the numbers, others may have them before.
        const std::string key =
            "\n<InformationKey name='L2' location='vtkDataArray'>5 6\n</InformationKey>\n";
        text_ += ">\n" + (style_.is_wide ? key : "");
        if (style_.encoding == VtpStyle::Ascii) {
            std::ostringstream numbers;
            numbers.precision(17);
            for (const T value : values) numbers << +value << ' ';
            text_ += numbers.str();
        } else {
            std::string bytes;
            for (const T value : values) put(value, bytes);
            (style_.is_appended() ? appended_ : text_) += encoded(bytes);
        }
        text_ += (style_.is_wide ? "" : key) + "</DataArray>\n";
    }

    [[nodiscard]] std::string finish() const {
        if (!style_.is_appended()) return text_ + "</VTKFile>\n";
        return text_ + "<AppendedData encoding='" +
               (style_.encoding == VtpStyle::Raw ? "raw" : "base64") + "'>\n_" + appended_ +
               "\n</AppendedData>\n</VTKFile>\n";
    }

private:
    template <typename T>
    void put(T value, std::string& bytes) const {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (style_.order != std::endian::native) std::reverse(raw, raw + sizeof(T));
        bytes.append(raw, sizeof(T));
    }
    void put_count(std::size_t count, std::string& bytes) const {
        if (style_.is_wide) return put(std::uint64_t{count}, bytes);
        put(static_cast<std::uint32_t>(count), bytes);
    }

    // The header and the data. If they are compressed, base64 has them in two pieces.
    [[nodiscard]] std::string encoded(const std::string& bytes) const {
        std::string header, data;
        if (!style_.is_packed) {
            put_count(bytes.size(), header);
            return in_base64(header + bytes);
        }
        const std::size_t size = VtpStyle::block_size;
        put_count((bytes.size() + size - 1) / size, header);
        put_count(size, header);
        put_count(bytes.size() % size, header);
        for (std::size_t at = 0; at < bytes.size(); at += size) {
            const std::string block = zlib_packed(bytes.substr(at, size));
            put_count(block.size(), header);
            data += block;
        }
        return in_base64(header) + in_base64(data);
    }

    static std::string zlib_packed(const std::string& bytes) {
        agvd::Ticker ticker;
        std::string packed = "\x78\x9C" + remesh::pack_for_zip(bytes, ticker);
        std::uint32_t a = 1, b = 0;
        for (const char c : bytes) {
            a = (a + static_cast<unsigned char>(c)) % 65521;
            b = (b + a) % 65521;
        }
        for (const std::uint32_t part : {b >> 8, b, a >> 8, a}) packed += static_cast<char>(part);
        return packed;
    }

    [[nodiscard]] std::string in_base64(const std::string& bytes) const {
        if (style_.encoding == VtpStyle::Raw) return bytes;
        constexpr const char* digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string text;
        for (std::size_t at = 0; at < bytes.size(); at += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const bool is_there = at + k < bytes.size();
                bits = bits << 8 | (is_there ? static_cast<unsigned char>(bytes[at + k]) : 0u);
            }
            for (std::size_t k = 0; k < 4; ++k) {
                text += at + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
            }
        }
        return text;
    }

    VtpStyle style_;
    std::string text_, appended_;
};
