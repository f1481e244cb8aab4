//! \file
//! Files compressed with gzip, deflated data in files of other formats, and ZIP files. Private to
//! the readers and writers. Ask knows_gzip() before: without zlib (AGVD_WITH_ZLIB=OFF) nothing can
//! be unpacked or packed.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "remesh/meshfile/source_file.h"

namespace remesh {

//! Whether this build reads and writes gzip.
[[nodiscard]] bool knows_gzip();

//! Whether the bytes begin as gzip does.
[[nodiscard]] inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

//! Unpacks the bytes of the file, all members one after the other. Memory follows what has been
//! unpacked, in steps of some megabytes, and the ticker polls between them: a small file of a huge
//! content is stopped by the progress callback.
//! \throw IoError  damaged, truncated, or this build has no zlib.  \throw Cancelled
void unpack_gzip(SourceFile& file);

//! Packs the bytes; the same bytes for the same version of zlib.
//! \throw Cancelled
[[nodiscard]] std::string pack_gzip(const std::string& bytes, Ticker ticker);

//! What surrounds deflated data: nothing, as in a ZIP file, or zlib's header and checksum.
enum class DeflatedIn { Zip, Zlib };

//! Appends what `packed` unpacks to. Memory follows what has been unpacked, in steps of some
//! megabytes, and the ticker polls between them, whatever the announced size.
//! \param size  of what comes out.
//! \return false: the data are damaged, or come to another size. Then `bytes` ends anywhere.
//! \throw Cancelled
[[nodiscard]] bool append_unpacked(std::string_view packed, DeflatedIn kind, std::uint64_t size,
                                   Ticker& ticker, std::string& bytes);

//! The bytes, deflated as in a ZIP file; the same bytes for the same version of zlib.
//! \throw Cancelled  \throw IoError  this build has no zlib.
[[nodiscard]] std::string pack_for_zip(const std::string& bytes, Ticker& ticker);

//! The checksum CRC-32 of ZIP files.
[[nodiscard]] std::uint32_t crc32_of(std::string_view bytes);

//! The parts of a ZIP file.
class ZipArchive {
public:
    //! Reads the directory at the end of the file.
    //! \param file  outlives this.
    //! \throw IoError  it is no ZIP file, truncated or damaged.
    explicit ZipArchive(SourceFile& file);

    //! The unpacked part of a name; its path is that of the file and the name. Memory follows what
    //! has been unpacked, see append_unpacked.
    //! \param name  without regard to the case of letters.
    //! \throw IoError  there is none, it is encrypted or damaged.  \throw Cancelled
    [[nodiscard]] SourceFile read(const std::string& name) const;

private:
    struct Entry {
        std::uint64_t flags, method, checksum, packed_size, size, header;
    };
    void read_directory(std::uint64_t begin, std::uint64_t size);
    void require(std::uint64_t begin, std::uint64_t size, const char* what) const;
    void require_mark(std::uint64_t begin, std::string_view mark, const char* what) const;
    //! A whole number of so many bytes, which are there.
    [[nodiscard]] std::uint64_t number(std::uint64_t at, std::size_t num_bytes) const;
    void take_large_numbers(std::uint64_t begin, std::uint64_t end, Entry& entry) const;
    [[nodiscard]] std::string_view packed(const Entry& entry) const;

    const SourceFile& file_;
    std::map<std::string, Entry> entries_;  // By name in lower case.
};

//! A ZIP file of parts (name and content); the same bytes for the same parts.
//! \throw InvalidInput  the file gets larger than 4 GB.  \throw Cancelled
[[nodiscard]] std::string pack_zip(const std::vector<std::pair<std::string, std::string>>& parts,
                                   Ticker& ticker);

}  // namespace remesh
