#include "agvd/core/error.h"
#include "remesh/meshfile/byte_order.h"
#include "remesh/meshfile/deflated.h"
#include "remesh/meshfile/zip_archive.h"

namespace remesh {
namespace {

constexpr std::uint16_t zip_version = 20;  // That of deflated parts.
constexpr std::uint16_t zip_deflated = 8;
constexpr std::uint16_t first_of_1980 = 0x21;  // Times would make different bytes in each run.

}  // namespace

void ZipWriter::add(const std::string& name, const std::string& content, Ticker& ticker) {
    require_size(content.size());
    const std::string packed = pack_for_zip(content, ticker);
    require_size(bytes_.size() + packed.size());
    std::string fields;  // The same in both places.
    append(fields, zip_version);
    append(fields, std::uint16_t{0});  // Flags.
    append(fields, zip_deflated);
    append(fields, std::uint16_t{0});  // Midnight.
    append(fields, first_of_1980);
    append(fields, crc32_of(content));
    append(fields, static_cast<std::uint32_t>(packed.size()));
    append(fields, static_cast<std::uint32_t>(content.size()));
    append(fields, static_cast<std::uint16_t>(name.size()));
    append(fields, std::uint16_t{0});  // No further fields.

    directory_ += "PK\1\2";
    append(directory_, zip_version);
    directory_ += fields;
    directory_.append(10, '\0');  // No comment, the first disk, no attributes.
    append(directory_, static_cast<std::uint32_t>(bytes_.size()));
    directory_ += name;
    bytes_ += "PK\3\4" + fields + name;
    bytes_ += packed;
    ++num_parts_;
}

std::string ZipWriter::finish() && {
    require_size(bytes_.size() + directory_.size());
    const std::size_t begin = bytes_.size();
    bytes_ += directory_ + "PK\5\6" + std::string(4, '\0');
    append(bytes_, static_cast<std::uint16_t>(num_parts_));
    append(bytes_, static_cast<std::uint16_t>(num_parts_));
    append(bytes_, static_cast<std::uint32_t>(directory_.size()));
    append(bytes_, static_cast<std::uint32_t>(begin));
    append(bytes_, std::uint16_t{0});  // No comment.
    return std::move(bytes_);
}

void ZipWriter::require_size(std::size_t size) const {
    if (size < UINT32_MAX) return;
    throw InvalidInput("the mesh is too large for a ZIP file of 4 GB; write .ply");
}

}  // namespace remesh
