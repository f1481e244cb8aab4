// Medit's .sol: lengths of edges at vertices.
#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/solution_file.h"
#include "support/scratch.h"

using agvd::InvalidInput;
using agvd::IoError;

namespace {

const std::string sol_head = "MeshVersionFormatted 2\nDimension\n3\n";

class Sol : public Scratch {
protected:
    [[nodiscard]] std::vector<double> lengths(const std::string& text) const {
        return remesh::read_lengths(put("h.sol", text), 3);
    }
    template <typename E>
    void expect_refused(const std::string& text, const std::vector<std::string>& words) const {
        try {
            static_cast<void>(lengths(text));
            ADD_FAILURE() << "read without complaint:\n" << text;
        } catch (const E& error) {
            const std::string told = error.what();
            EXPECT_NE(told.find("h.sol: line "), std::string::npos) << told;
            EXPECT_NE(told.find(';'), std::string::npos) << "no remedy: " << told;
            for (const std::string& word : words) {
                EXPECT_NE(told.find(word), std::string::npos) << word << " is not in: " << told;
            }
        }
    }
};

}  // namespace

TEST_F(Sol, OneNumberForEachVertexIsRead) {
    const std::vector<double> expected{0.5, 1e-3, 2};
    EXPECT_EQ(lengths(sol_head + "# sizes\nSolAtVertices\n3\n1 1\n.5\n1e-3\n2\n\nEnd\n"), expected);
    EXPECT_EQ(lengths("MeshVersionFormatted\n1 Dimension 2 SolAtVertices 3 1 1 .5 1e-3 2 End"),
              expected);
    if (!remesh::knows_gzip()) return;
    const std::string packed =
        remesh::pack_gzip(sol_head + "SolAtVertices\n3\n1 1\n.5\n1e-3\n2\nEnd\n", {});
    EXPECT_EQ(remesh::read_lengths(put("h.sol.gz", packed), 3), expected);
}

TEST_F(Sol, ItsNameTells) {
    EXPECT_TRUE(remesh::is_solution_file("a/b.SOL"));
    EXPECT_EQ(remesh::is_solution_file("b.sol.gz"), remesh::knows_gzip());
    EXPECT_FALSE(remesh::is_solution_file("sol"));
    EXPECT_FALSE(remesh::is_solution_file(""));
}

TEST_F(Sol, TruncatedFilesAreRefused) {
    const std::string text = sol_head + "SolAtVertices\n3\n1 1\n.5\n1.5\n2\nEnd";
    for (std::size_t size = 1; size < text.size(); ++size) {
        EXPECT_ANY_THROW(static_cast<void>(lengths(text.substr(0, size)))) << size;
    }
}

TEST_F(Sol, OtherFilesAreRefused) {
    expect_refused<IoError>("OFF\n", {"line 1", "'MeshVersionFormatted'", "'OFF'"});
    expect_refused<IoError>(sol_head + "SolAtTriangles\n", {"line 4", "'SolAtVertices'"});
    const std::string begin = sol_head + "SolAtVertices\n3\n";
    expect_refused<IoError>(begin + "2 1 1\n", {"line 6", "number of fields is not 1"});
    expect_refused<IoError>(begin + "1 3\n", {"line 6", "type of the field is not 1", "metrics"});
    expect_refused<IoError>(begin + "1 1\n1\n2\nx\nEnd", {"line 9", "a value", "'x'"});
    expect_refused<IoError>(begin + "1 1\n1\n2\nEnd", {"line 9", "'End'"});
    expect_refused<IoError>(begin + "1 1\n1\n2\n3\n4\nEnd", {"line 10", "'End'", "'4'"});
    expect_refused<IoError>(begin + "1 1\n1\n2\n3\n", {"before End", "truncated"});
}

TEST_F(Sol, WrongValuesAreRefused) {
    expect_refused<InvalidInput>(sol_head + "SolAtVertices\n4\n1 1\n1 1 1 1\nEnd",
                                 {"line 5", "4 values", "3 vertices"});
    for (const char* value : {"0", "-1", "nan", "inf"}) {
        expect_refused<InvalidInput>(sol_head + "SolAtVertices\n3\n1 1\n1\n2\n" + value + "\nEnd",
                                     {"line 9", "vertex 2 (from 0) is not above 0"});
    }
}
