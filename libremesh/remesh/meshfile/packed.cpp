#include "remesh/meshfile/packed.h"

#include <zlib.h>
#include <algorithm>
#include <new>

namespace remesh {
namespace {

// Memory is taken and the ticker polls in steps of this size.
constexpr std::size_t zlib_chunk_size = 1 << 22;

// What surrounds the deflated data; see zlib.h, inflateInit2 and deflateInit2.
enum class ZlibWrapping : int { None = -MAX_WBITS, Zlib = MAX_WBITS, Gzip = MAX_WBITS + 16 };

// A stream of zlib over input that lies in memory.
class ZStream {
public:
    ZStream(std::string_view input, ZlibWrapping wrapping, bool packs)
        : left_(input), packs_(packs) {
        const int bits = static_cast<int>(wrapping);
        const int status = packs ? ::deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, bits,
                                                  8, Z_DEFAULT_STRATEGY)
                                 : ::inflateInit2(&stream_, bits);
        if (status != Z_OK) throw std::bad_alloc();  // The other errors are wrong arguments.
        // It would name the system, and so differ. Of the other wrappings this is refused.
        constexpr int of_unix = 3;
        header_.os = of_unix;
        if (packs) ::deflateSetHeader(&stream_, &header_);
    }
    ZStream(const ZStream&) = delete;
    ZStream& operator=(const ZStream&) = delete;
    ~ZStream() { packs_ ? ::deflateEnd(&stream_) : ::inflateEnd(&stream_); }

    // Fills the bytes from `begin` to their end, as far as the input goes, and cuts off the rest.
    // \return what zlib returned last.
    int fill(std::string& bytes, std::size_t begin, Ticker& ticker) {
        stream_.next_out = reinterpret_cast<Bytef*>(bytes.data() + begin);
        stream_.avail_out = static_cast<uInt>(bytes.size() - begin);
        int status = Z_OK;
        while (status == Z_OK && stream_.avail_out > 0) {
            ticker.poll();
            if (stream_.avail_in == 0) take_input();
            status = packs_ ? ::deflate(&stream_, left_.empty() ? Z_FINISH : Z_NO_FLUSH)
                            : ::inflate(&stream_, Z_NO_FLUSH);
            if (status == Z_BUF_ERROR && stream_.avail_in == 0 && !left_.empty()) status = Z_OK;
        }
        bytes.resize(bytes.size() - stream_.avail_out);
        if (status == Z_MEM_ERROR) throw std::bad_alloc();
        return status;
    }

    // Bytes of the input that were not used.
    [[nodiscard]] std::size_t num_left() const { return left_.size() + stream_.avail_in; }

private:
    void take_input() {
        const std::size_t size = std::min(left_.size(), zlib_chunk_size);
        // zlib does not write to its input.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));
        stream_.avail_in = static_cast<uInt>(size);
        left_.remove_prefix(size);
    }

    z_stream stream_{};
    gz_header header_{};  // Of Gzip.
    std::string_view left_;
    bool packs_;
};

// Appends all that comes out of a stream. \return what zlib returned last.
int append_chunks(ZStream& stream, Ticker& ticker, std::vector<std::string>& chunks) {
    int status = Z_OK;
    while (status == Z_OK) {
        chunks.emplace_back(zlib_chunk_size, '\0');
        status = stream.fill(chunks.back(), 0, ticker);
    }
    return status;
}

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
    ZStream stream(std::string_view(file.bytes).substr(offset), ZlibWrapping::Gzip, false);
    const int status = append_chunks(stream, ticker, chunks);
    const std::size_t at = file.bytes.size() - stream.num_left();
    if (status == Z_BUF_ERROR) {
        file.fail_malformed(
            at, "the compressed data end too early; the file is truncated: export it again");
    }
    if (status != Z_STREAM_END) file.fail_damaged(at, "the compressed data are damaged");
    offset = at;
}

std::string packed(const std::string& bytes, ZlibWrapping wrapping, Ticker& ticker) {
    ZStream stream(bytes, wrapping, true);
    std::vector<std::string> chunks;
    append_chunks(stream, ticker, chunks);
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
    const std::size_t rest = file.bytes.find_first_not_of('\0', offset);
    if (rest != std::string::npos) {
        file.fail_damaged(rest, "bytes that are not compressed follow those that are");
    }
    file.bytes = {};
    file.bytes = joined_chunks(std::move(chunks));
    file.is_binary = false;
    if (file.bytes.empty()) {
        file.fail_damaged(0, "the compressed file is empty");
    }
}

std::string pack_gzip(const std::string& bytes, Ticker ticker) {
    return packed(bytes, ZlibWrapping::Gzip, ticker);
}

bool append_unpacked(std::string_view packed_bytes, DeflatedIn kind, std::uint64_t size,
                     Ticker& ticker, std::string& bytes) {
    ZStream stream(packed_bytes, kind == DeflatedIn::Zip ? ZlibWrapping::None : ZlibWrapping::Zlib,
                   false);
    int status = Z_OK;
    // Also when all has come out: the end of the data must be there. One byte more would show.
    while (status == Z_OK) {
        const std::size_t begin = bytes.size();
        bytes.resize(begin + static_cast<std::size_t>(
                                 std::min<std::uint64_t>(size, zlib_chunk_size - 1) + 1));
        status = stream.fill(bytes, begin, ticker);
        if (bytes.size() - begin > size) return false;
        size -= bytes.size() - begin;
    }
    return status == Z_STREAM_END && size == 0 && stream.num_left() == 0;
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
