// Medit's .sol, ascii: SolAtVertices, their number, the number of fields and their types (1: one
// number, 2: a vector, 3: a symmetric matrix), the values (format: Frey, "MEDIT: an interactive
// mesh visualization software", INRIA RT-0253, 2001).

#include <cmath>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/solution_file.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

class SolReader {
public:
    explicit SolReader(const SourceFile& file)
        : file_(file), scan_(file, 0, {.comment = '#'}), ticker_(file.ticker) {}

    std::vector<double> read(std::size_t num_vertices) {
        read_head();
        expect("SolAtVertices");
        next("the number of values");
        const std::uint64_t count = scan_.count("the number of values");
        if (count != num_vertices) {
            file_.fail_unusable(start_, "the file has ", count, " values, but the mesh has ",
                                num_vertices,
                                " vertices; give one for each vertex, in their order");
        }
        require_one_number();
        std::vector<double> lengths;
        for (std::uint64_t i = 0; i < count; ++i) {
            ticker_.tick();
            next("a value");
            lengths.push_back(scan_.number("a value"));
            if (lengths.back() > 0 && std::isfinite(lengths.back())) continue;
            file_.fail_unusable(start_, "the length at vertex ", i,
                                " (from 0) is not above 0; correct it");
        }
        expect("End");
        return lengths;
    }

private:
    void next(const char* what) {
        const bool has_word = scan_.find_word();
        start_ = scan_.offset();
        if (has_word) return;
        file_.fail_malformed(start_, "the file ends before ", what,
                             "; it is truncated: export the file again");
    }

    void expect(const char* keyword) {
        next(keyword);
        const std::string_view word = scan_.word();
        if (word == keyword) return;
        file_.fail_malformed(start_, "expected '", keyword, "', found ", in_quotes(word),
                             "; use a .sol file (not .solb) with one number for each vertex");
    }

    void read_head() {
        expect("MeshVersionFormatted");
        next("a version");
        scan_.integer("a version");
        expect("Dimension");
        next("the dimension");
        scan_.integer("the dimension");
    }

    void require_one_number() {
        for (const char* what : {"the number of fields", "the type of the field"}) {
            next(what);
            if (scan_.integer(what) == 1) continue;
            file_.fail_malformed(start_, what,
                                 " is not 1: vectors, metrics and several fields are not read; "
                                 "write one number for each vertex, the length of edges there");
        }
    }

    const SourceFile& file_;
    TextScanner scan_;
    Ticker ticker_;
    std::size_t start_ = 0;  // Of the word that is being read.
};

}  // namespace

bool is_solution_file(const std::filesystem::path& path) {
    return lower_extension(is_compressed({path}) ? path.stem() : path) == ".sol";
}

std::vector<double> read_lengths(const std::filesystem::path& path, std::size_t num_vertices,
                                 const Progress& progress) {
    Poller poller(progress);
    SourceFile file = load_file(path, poller);
    if (is_gzip(file.bytes)) unpack_gzip(file);
    return SolReader(file).read(num_vertices);
}

}  // namespace remesh
