//! \file
//! Numbers of Gmsh's .msh files, which stand there as text or in binary. Private to their reader.
#pragma once

#include <bit>
#include <cmath>

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {

//! Goes from section to section. Each is `$Name`, its content, `$EndName`.
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
    std::int64_t integer(const char* what) {
        find(what);
        return is_binary() ? load<std::int32_t>(take(4), order_) : scan_.integer(what);
    }
    double real(const char* what) {
        find(what);
        return is_binary() ? load<double>(take(8), order_) : scan_.number(what);
    }
    //! A size_t.
    std::uint64_t size(const char* what) {
        find(what);
        if (!is_binary()) return scan_.count(what);
        return size_of_count_ == 4 ? load<std::uint32_t>(take(4), order_)
                                   : load<std::uint64_t>(take(8), order_);
    }
    //! The number of a node or an element, by which others name it.
    std::uint64_t tag(const char* what) {
        if (!is_version_2()) return size(what);
        const std::int64_t tag = integer(what);
        if (tag < 0) fail(what, " is negative");
        return static_cast<std::uint64_t>(tag);
    }
    //! A number that is a text in binary files as well.
    std::int64_t text_integer(const char* what) {
        find_text(what);
        return scan_.integer(what);
    }
    //! Likewise, one that is not negative.
    std::uint64_t text_count(const char* what) {
        find_text(what);
        return scan_.count(what);
    }
    double text_real(const char* what) {
        find_text(what);
        return scan_.number(what);
    }
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
    void find_text(const char* what) {
        const bool has_word = scan_.find_word();
        start_ = scan_.offset();
        if (!has_word) fail_truncated(what);
    }
    void find(const char* what) {
        what_ = what;
        if (!is_binary()) return find_text(what);
        start_ = scan_.offset();
    }
    //! The next bytes, for the number that was looked for.
    const char* take(std::size_t count) {
        if (file_.bytes.size() - start_ < count) fail_truncated(what_);
        scan_.go_to(start_ + count);
        return file_.bytes.data() + start_;
    }
    [[noreturn]] void fail_truncated(const char* what) const {
        file_.fail_malformed(start_, "the file ends before ", what,
                             "; it is truncated: export the file again");
    }

    SourceFile& file_;
    TextScanner scan_;
    std::size_t start_ = 0;
    const char* what_ = "";
    bool is_version_2_ = false;
    std::size_t size_of_count_ = 8;
    std::endian order_ = std::endian::little;
};

}  // namespace remesh
