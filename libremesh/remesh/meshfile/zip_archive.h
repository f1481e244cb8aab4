//! \file
//! The parts of a ZIP file. Private to the reader and the writer of 3MF.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "remesh/meshfile/source_file.h"

namespace remesh {

class ZipArchive {
public:
    //! Reads the directory at the end of the file.
    //! \param file  outlives this.
    //! \throw IoError  it is no ZIP file, truncated or damaged.
    explicit ZipArchive(SourceFile& file);

    [[nodiscard]] bool has(const std::string& name) const;

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

//! Builds a ZIP file; the same bytes for the same parts.
class ZipWriter {
public:
    //! \throw InvalidInput  the file gets larger than 4 GB.
    void add(const std::string& name, const std::string& content, Ticker& ticker);
    [[nodiscard]] std::string finish() &&;

private:
    void require_size(std::size_t size) const;

    std::string bytes_, directory_;
    std::size_t num_parts_ = 0;
};

}  // namespace remesh
