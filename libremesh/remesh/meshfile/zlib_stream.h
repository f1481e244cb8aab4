//! \file
//! Streams of zlib over input that lies in memory. Private; only sources that are compiled with
//! zlib include it.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <new>
#include <string>
#include <string_view>

#include "remesh/names.h"

namespace remesh {

//! Memory is taken and the ticker polls in steps of this size.
constexpr std::size_t zlib_chunk_size = 1 << 22;

//! What surrounds the deflated data; see zlib.h, inflateInit2 and deflateInit2.
enum class ZlibWrapping : int { None = -MAX_WBITS, Zlib = MAX_WBITS, Gzip = MAX_WBITS + 16 };

class ZStream {
public:
    //! Fills the bytes from `begin` to their end, as far as the input goes, and cuts off the rest.
    //! \param step  inflate or deflate, with its flush mode. \return what it returned last.
    template <typename Step>
    int fill(std::string& bytes, std::size_t begin, const Step& step) {
        stream_.next_out = reinterpret_cast<Bytef*>(bytes.data() + begin);
        stream_.avail_out = static_cast<uInt>(bytes.size() - begin);
        int status = Z_OK;
        while (status == Z_OK && stream_.avail_out > 0) {
            if (stream_.avail_in == 0) take_input();
            status = step(stream_, left_.empty());
            if (status == Z_BUF_ERROR && stream_.avail_in == 0 && !left_.empty()) status = Z_OK;
        }
        bytes.resize(bytes.size() - stream_.avail_out);
        return status;
    }

    //! Bytes of the input that were not used.
    [[nodiscard]] std::size_t num_left() const { return left_.size() + stream_.avail_in; }

protected:
    explicit ZStream(std::string_view input) : left_(input) {}
    ZStream(const ZStream&) = delete;
    ZStream& operator=(const ZStream&) = delete;
    ~ZStream() = default;

    static void require(int status) {
        if (status != Z_OK) throw std::bad_alloc();  // The other errors are wrong arguments.
    }
    z_stream stream_{};

private:
    void take_input() {
        const std::size_t size = std::min(left_.size(), zlib_chunk_size);
        // zlib does not write to its input.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));
        stream_.avail_in = static_cast<uInt>(size);
        left_.remove_prefix(size);
    }

    std::string_view left_;
};

class Inflater : public ZStream {
public:
    Inflater(std::string_view input, ZlibWrapping wrapping) : ZStream(input) {
        require(::inflateInit2(&stream_, static_cast<int>(wrapping)));
    }
    ~Inflater() { ::inflateEnd(&stream_); }

    //! As fill.
    int unpack(std::string& bytes, std::size_t begin) {
        return fill(bytes, begin,
                    [](z_stream& stream, bool) { return ::inflate(&stream, Z_NO_FLUSH); });
    }
};

class Deflater : public ZStream {
public:
    Deflater(std::string_view input, ZlibWrapping wrapping) : ZStream(input) {
        require(::deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED,
                               static_cast<int>(wrapping), 8, Z_DEFAULT_STRATEGY));
    }
    ~Deflater() { ::deflateEnd(&stream_); }
};

}  // namespace remesh
