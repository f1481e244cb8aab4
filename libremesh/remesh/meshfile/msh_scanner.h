//! \file
//! Numbers of Gmsh's .msh files, which stand there as text or in binary. Private to their reader.
#pragma once

#include <bit>
#include <cmath>

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {

//! Goes from section to section. Each is `$Name`, its content, `$EndName`. Nothing is inline:
//! numbers are read in many places, and the module for browsers is to stay small.
class MshScanner {
public:
    //! Reads the section MeshFormat, with which a file begins.
    //! \param file  outlives this.
    //! \throw IoError  it is no file of version 2 or 4.1.
    explicit MshScanner(SourceFile& file);

    //! Version 2 numbers nodes and elements by int; version 4.1 by size_t.
    [[nodiscard]] bool is_version_2() const { return is_version_2_; }
    [[nodiscard]] bool is_binary() const { return file_.is_binary; }

    //! The name of the next section; nothing at the end of the file.
    [[nodiscard]] std::optional<std::string> next_section();
    //! Requires the end of a section whose content was read.
    void end_section(const std::string& name);
    //! Passes over the rest of a section, whatever it holds.
    void skip_section(const std::string& name);
    //! What follows is binary in a binary file: it begins on the next line.
    void begin_numbers();

    //! The next number of that type.
    //! \param what  for errors.
    std::int64_t integer(const char* what);
    double real(const char* what);
    //! A size_t.
    std::uint64_t size(const char* what);
    //! The number of a node or an element, by which others name it.
    std::uint64_t tag(const char* what);
    //! A number that is a text in binary files as well.
    std::int64_t text_integer(const char* what);
    double text_real(const char* what);
    //! A number that must not be negative, and is a text in binary files as well.
    std::uint64_t text_count(const char* what);
    //! The name in quotes that comes next and ends a line.
    std::string quoted_name();

    //! Of the last number or section.
    [[nodiscard]] std::size_t start() const { return start_; }
    template <typename... Parts>
    [[noreturn]] void fail(Parts... parts) const {
        file_.fail_damaged(start_, parts...);
    }

private:
    void read_version();
    void find_text(const char* what);
    //! The next bytes.
    const char* take(std::size_t count, const char* what);
    [[noreturn]] void fail_truncated(const char* what) const;

    SourceFile& file_;
    TextScanner scan_;
    std::size_t start_ = 0;
    bool is_version_2_ = false;
    std::size_t size_of_count_ = 8;
    std::endian order_ = std::endian::little;
};

}  // namespace remesh
