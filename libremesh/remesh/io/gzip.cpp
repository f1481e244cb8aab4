#include "remesh/io/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <utility>
#include <vector>

namespace remesh {
namespace {

constexpr std::size_t chunk_size = 1 << 22;
constexpr int with_gzip_header = MAX_WBITS + 16;  // See zlib.h, deflateInit2.

void require(int status) {
    if (status != Z_OK) throw std::bad_alloc();  // The other errors are wrong arguments.
}

// A stream of zlib, with input that lies in memory.
class ZStream {
public:
    explicit ZStream(std::string_view input) : left_(input) {}
    ZStream(const ZStream&) = delete;
    ZStream& operator=(const ZStream&) = delete;

    // Fills the chunk from its beginning, as far as the input goes.
    // \param step  inflate or deflate, with its flush mode. \return what it returned last.
    template <typename Step>
    int fill(std::string& chunk, const Step& step) {
        stream_.next_out = reinterpret_cast<Bytef*>(chunk.data());
        stream_.avail_out = static_cast<uInt>(chunk.size());
        int status = Z_OK;
        while (status == Z_OK && stream_.avail_out > 0) {
            if (stream_.avail_in == 0) take_input();
            status = step(stream_, left_.empty());
            if (status == Z_BUF_ERROR && stream_.avail_in == 0 && !left_.empty()) status = Z_OK;
        }
        chunk.resize(chunk.size() - stream_.avail_out);
        return status;
    }

    // Bytes of the input that were not used.
    [[nodiscard]] std::size_t num_left() const { return left_.size() + stream_.avail_in; }
    z_stream& operator*() { return stream_; }

private:
    void take_input() {
        const std::size_t size = std::min(left_.size(), chunk_size);
        // zlib does not write to its input.
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left_.data()));
        stream_.avail_in = static_cast<uInt>(size);
        left_.remove_prefix(size);
    }

    z_stream stream_{};
    std::string_view left_;
};

class Inflater : public ZStream {
public:
    explicit Inflater(std::string_view input) : ZStream(input) {
        require(::inflateInit2(&**this, with_gzip_header));
    }
    ~Inflater() { ::inflateEnd(&**this); }
};

class Deflater : public ZStream {
public:
    explicit Deflater(std::string_view input) : ZStream(input) {
        require(::deflateInit2(&**this, Z_DEFAULT_COMPRESSION, Z_DEFLATED, with_gzip_header, 8,
                               Z_DEFAULT_STRATEGY));
    }
    ~Deflater() { ::deflateEnd(&**this); }
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
void unpack_member(const SourceFile& file, std::size_t& offset, agvd::Ticker& ticker,
                   std::vector<std::string>& chunks) {
    Inflater inflater(std::string_view(file.bytes).substr(offset));
    int status = Z_OK;
    while (status == Z_OK) {
        ticker.poll();
        chunks.emplace_back(chunk_size, '\0');
        status = inflater.fill(
            chunks.back(), [](z_stream& stream, bool) { return ::inflate(&stream, Z_NO_FLUSH); });
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

}  // namespace

bool knows_gzip() { return true; }

void unpack_gzip(SourceFile& file) {
    file.is_binary = true;
    agvd::Ticker ticker = file.ticker;
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

std::string pack_gzip(const std::string& bytes, agvd::Ticker ticker) {
    Deflater deflater(bytes);
    std::vector<std::string> chunks;
    int status = Z_OK;
    while (status == Z_OK) {
        chunks.emplace_back(chunk_size, '\0');
        status = deflater.fill(chunks.back(), [&](z_stream& stream, bool is_last) {
            ticker.poll();
            return ::deflate(&stream, is_last ? Z_FINISH : Z_NO_FLUSH);
        });
    }
    return joined_chunks(std::move(chunks));
}

}  // namespace remesh
