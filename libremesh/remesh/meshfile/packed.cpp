//! Streams of zlib over input that lies in memory. Private; only sources that are compiled with
//! zlib include it.
#include "remesh/meshfile/packed.h"

#include <zlib.h>
#include <algorithm>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace remesh {
namespace {

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

// Each chunk is freed as soon as it is appended, so that nothing is in memory twice.
std::string joined_chunks(std::vector<std::string> chunks) {
    std::size_t size = 0;
    for (const std::string& chunk : chunks) size += chunk.size();
    std::string bytes;
    bytes.reserve(size);
    for (std::string& chunk : chunks) bytes += std::exchange(chunk, {});
    return bytes;
}

// Unpacks one member, which begins at the offset, and goes behind it.
void unpack_member(const SourceFile& file, std::size_t& offset, Ticker& ticker,
                   std::vector<std::string>& chunks) {
    Inflater inflater(std::string_view(file.bytes).substr(offset), ZlibWrapping::Gzip);
    int status = Z_OK;
    while (status == Z_OK) {
        ticker.poll();
        chunks.emplace_back(zlib_chunk_size, '\0');
        status = inflater.unpack(chunks.back(), 0);
    }
    const std::size_t at = file.bytes.size() - inflater.num_left();
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_BUF_ERROR) {
        file.fail_malformed(at,
                            "the compressed data end too early; the file is truncated: export "
                            "it again");
    }
    if (status != Z_STREAM_END) {
        file.fail_malformed(at, "the compressed data are damaged; export the file again");
    }
    offset = at;
}

std::string packed(const std::string& bytes, ZlibWrapping wrapping, Ticker& ticker) {
    Deflater deflater(bytes, wrapping);
    std::vector<std::string> chunks;
    int status = Z_OK;
    while (status == Z_OK) {
        chunks.emplace_back(zlib_chunk_size, '\0');
        status = deflater.fill(chunks.back(), 0, [&](z_stream& stream, bool is_last) {
            ticker.poll();
            return ::deflate(&stream, is_last ? Z_FINISH : Z_NO_FLUSH);
        });
    }
    return joined_chunks(std::move(chunks));
}

}  // namespace

bool knows_gzip() { return true; }

void unpack_gzip(SourceFile& file) {
    file.is_binary = true;
    Ticker ticker = file.ticker;
    std::vector<std::string> chunks;
    std::size_t offset = 0;
    while (is_gzip(std::string_view(file.bytes).substr(offset))) {
        unpack_member(file, offset, ticker, chunks);
    }
    // Tapes and some writers fill the last block with zeros.
    const std::size_t rest =
        std::min(file.bytes.find_first_not_of('\0', offset), file.bytes.size());
    if (rest < file.bytes.size()) {
        file.fail_malformed(rest,
                            "bytes that are not compressed follow those that are; export the "
                            "file again");
    }
    file.bytes = {};
    file.bytes = joined_chunks(std::move(chunks));
    file.is_binary = false;
    if (file.bytes.empty()) {
        file.fail_malformed(0, "the compressed file is empty; export the file again");
    }
}

std::string pack_gzip(const std::string& bytes, Ticker ticker) {
    return packed(bytes, ZlibWrapping::Gzip, ticker);
}

bool append_unpacked(std::string_view packed_bytes, DeflatedIn kind, std::uint64_t size,
                     Ticker& ticker, std::string& bytes) {
    Inflater inflater(packed_bytes,
                      kind == DeflatedIn::Zip ? ZlibWrapping::None : ZlibWrapping::Zlib);
    int status = Z_OK;
    // Also when all has come out: the end of the data must be there. One byte more would show.
    while (status == Z_OK) {
        ticker.poll();
        const std::size_t begin = bytes.size();
        bytes.resize(begin + static_cast<std::size_t>(
                                 std::min<std::uint64_t>(size, zlib_chunk_size - 1) + 1));
        status = inflater.unpack(bytes, begin);
        if (bytes.size() - begin > size) return false;
        size -= bytes.size() - begin;
    }
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    return status == Z_STREAM_END && size == 0 && inflater.num_left() == 0;
}

std::string pack_for_zip(const std::string& bytes, Ticker& ticker) {
    return packed(bytes, ZlibWrapping::None, ticker);
}

std::uint32_t crc32_of(std::string_view bytes) {
    uLong sum = ::crc32(0, nullptr, 0);
    while (!bytes.empty()) {
        const std::size_t size = std::min(bytes.size(), zlib_chunk_size);
        sum = ::crc32(sum, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(size));
        bytes.remove_prefix(size);
    }
    return static_cast<std::uint32_t>(sum);
}

}  // namespace remesh
