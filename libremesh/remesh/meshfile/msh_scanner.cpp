#include "remesh/meshfile/msh_scanner.h"

namespace remesh {

MshScanner::MshScanner(SourceFile& file) : file_(file), scan_(file, 0, {}) {
    if (next_section() != "MeshFormat") {
        file_.fail_malformed(start_,
                             "this is no Gmsh mesh of version 2 or 4.1, as it does not begin with "
                             "'$MeshFormat'; check its extension, or write it anew by Gmsh");
    }
    read_version();
    end_section("MeshFormat");
}

void MshScanner::read_version() {
    find_text("a version");
    const double version = scan_.number("a version");
    is_version_2_ = version >= 2 && version < 3;
    if (!is_version_2_ && version != 4.1) {
        file_.fail_malformed(start_, "version ", number_text(version, 4),
                             " of Gmsh's format is not supported, only 2 and 4.1; write the file "
                             "anew (gmsh IN -save -format msh41 -o OUT)");
    }
    const std::int64_t kind = text_integer("0 for text or 1 for binary");
    if (kind != 0 && kind != 1) fail("the kind of the file is ", kind, ", not 0 or 1");
    const std::int64_t size = text_integer("the size of numbers");
    const bool is_known_size = size == 8 || (size == 4 && !is_version_2_);
    if (!is_known_size) fail("numbers of ", size, " bytes are not supported");
    size_of_count_ = static_cast<std::size_t>(size);
    file_.is_binary = kind == 1;
    if (!is_binary()) return;
    begin_numbers();
    const std::int64_t one = integer("the number that tells the order of bytes");
    if (one == 1) return;
    if (one != 1 << 24) fail("the order of bytes is unknown");
    order_ = std::endian::big;
}

std::optional<std::string> MshScanner::next_section() {
    const bool has_word = scan_.find_word();
    start_ = scan_.offset();
    if (!has_word) return {};
    const std::string word(scan_.word());
    if (word.size() > 1 && word[0] == '$' && !word.starts_with("$End")) return word.substr(1);
    fail("expected a section such as '$Nodes', found ", in_quotes(word));
}

void MshScanner::end_section(const std::string& name) {
    const std::string end = "$End" + name;
    find_text(end.c_str());
    const std::string_view word = scan_.word();
    if (word == end) return;
    fail("expected '", end, "' behind what the section announces, found ", in_quotes(word));
}

void MshScanner::skip_section(const std::string& name) {
    const std::string end = "$End" + name;
    const std::size_t found = file_.bytes.find(end, scan_.offset());
    if (found == std::string::npos) {
        file_.fail_malformed(start_, "the section has no '", end,
                             "'; the file is truncated: export the file again");
    }
    scan_.go_to(found);
    end_section(name);
}

void MshScanner::begin_numbers() {
    if (!is_binary()) return;
    scan_.skip_line();
    const std::size_t at = scan_.offset();
    if (file_.bytes[at - 1] == '\r' && file_.bytes[at] == '\n') scan_.go_to(at + 1);
}

std::int64_t MshScanner::integer(const char* what) {
    return is_binary() ? load<std::int32_t>(take(4, what), order_) : text_integer(what);
}

double MshScanner::real(const char* what) {
    return is_binary() ? load<double>(take(8, what), order_) : text_real(what);
}

std::uint64_t MshScanner::size(const char* what) {
    if (!is_binary()) return text_count(what);
    return size_of_count_ == 4 ? load<std::uint32_t>(take(4, what), order_)
                               : load<std::uint64_t>(take(8, what), order_);
}

std::uint64_t MshScanner::tag(const char* what) {
    if (!is_version_2()) return size(what);
    const std::int64_t tag = integer(what);
    if (tag < 0) fail(what, " is negative");
    return static_cast<std::uint64_t>(tag);
}

std::int64_t MshScanner::text_integer(const char* what) {
    find_text(what);
    return scan_.integer(what);
}

double MshScanner::text_real(const char* what) {
    find_text(what);
    return scan_.number(what);
}

std::uint64_t MshScanner::text_count(const char* what) {
    const std::int64_t count = text_integer(what);
    if (count < 0) fail(what, " is negative");
    return static_cast<std::uint64_t>(count);
}

std::string MshScanner::quoted_name() {
    find_text("a name in quotes");
    const std::string text = scan_.words();
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
        return text.substr(1, text.size() - 2);
    }
    fail("expected a name in quotes, found ", in_quotes(text));
}

void MshScanner::find_text(const char* what) {
    const bool has_word = scan_.find_word();
    start_ = scan_.offset();
    if (!has_word) fail_truncated(what);
}

const char* MshScanner::take(std::size_t count, const char* what) {
    start_ = scan_.offset();
    if (file_.bytes.size() - start_ < count) fail_truncated(what);
    scan_.go_to(start_ + count);
    return file_.bytes.data() + start_;
}

void MshScanner::fail_truncated(const char* what) const {
    file_.fail_malformed(start_, "the file ends before ", what,
                         "; it is truncated: export the file again");
}

}  // namespace remesh
