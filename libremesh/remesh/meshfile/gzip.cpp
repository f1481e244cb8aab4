#include "remesh/meshfile/gzip.h"

#include <utility>
#include <vector>

#include "remesh/meshfile/deflated.h"
#include "remesh/meshfile/zlib_stream.h"

namespace remesh {
namespace {

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
