// Reads every #include line of the libraries and holds it against the layers: data flows down the
// rows, a file includes its own row or rows above, and each package stays where it belongs.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Layer {
    const char* folder;
    int row;
};

constexpr Layer layers[] = {
    {"agvd/core", 0},      {"agvd/mesh", 1},       {"agvd/intrinsic", 2},   {"agvd/propagation", 3},
    {"agvd/diagram", 4},   {"agvd/metrics", 4},    {"remesh/features", 5},  {"remesh/sampling", 5},
    {"remesh/relax", 6},   {"remesh/dual", 6},     {"remesh/placement", 6}, {"remesh/repair", 6},
    {"remesh/quality", 6}, {"remesh/pipeline", 7}, {"remesh/io", 8},
};

struct Package {
    const char* prefix;  // Of its headers.
    const char* where;   // Pattern of the files that may include them.
};

constexpr Package packages[] = {
    {"Eigen/", R"(agvd/(core|diagram)/.*|remesh/(dual|placement|repair|quality)/.*)"},
    {"tbb/", R"(agvd/core/parallel\.cpp)"},
    {"CGAL/", R"(agvd/metrics/oracle\.cpp|remesh/(repair|quality)/.*\.cpp)"},
    {"OpenMesh/", R"(remesh/io/(.*\.cpp|openmesh_exchange\.h))"},
    {"nlohmann/", R"(remesh/io/.*\.cpp)"},
    {"fast_float/", R"(remesh/io/(.*\.cpp|text_scanner\.h))"},
    {"sys/", R"(remesh/io/.*\.cpp)"},
};

std::optional<int> row_of(const std::string& file) {
    for (const Layer& layer : layers) {
        if (file.rfind(std::string(layer.folder) + "/", 0) == 0) return layer.row;
    }
    return std::nullopt;
}

// What is wrong with `line` in `file` (a path such as agvd/mesh/surface.h); empty: nothing.
std::string complaint(const std::string& file, const std::string& line) {
    static const std::regex include(R"re(\s*#\s*include\s*(["<])([^">]*)[">].*)re");
    std::smatch match;
    if (!std::regex_match(line, match, include)) return "";
    const std::string header = match[2];
    if (match[1] == "\"") {
        const std::optional<int> row = row_of(header);
        if (!row) return "is not a path from the root of a library";
        if (!row_of(file)) return "stands in a folder that has no row";
        if (*row > row_of(file)) return "points to a lower row";
        // What propagation runs on is a surface, whatever made it.
        if (file.rfind("agvd/propagation/", 0) == 0 && header.rfind("agvd/intrinsic/", 0) == 0) {
            return "points to the intrinsic base";
        }
        // Creases are found before there are sites, on the input as it is.
        if (file.rfind("remesh/features/", 0) == 0 && *row > 1 &&
            header.rfind("remesh/features/", 0) != 0) {
            return "points to what comes after features";
        }
        return "";
    }
    for (const Package& package : packages) {
        if (header.rfind(package.prefix, 0) != 0) continue;
        return std::regex_match(file, std::regex(package.where)) ? "" : "is not allowed here";
    }
    return header.find('/') == std::string::npos ? "" : "is of a package that has no row";
}

std::vector<std::string> source_files(const fs::path& root) {
    std::vector<std::string> files;
    for (const char* library : {"libagvd", "libremesh"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / library)) {
            const std::string extension = entry.path().extension();
            if (extension == ".h" || extension == ".cpp") files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

TEST(Layering, EveryIncludeKeepsToTheRows) {
    const fs::path root = AGVD_SOURCE_DIR;
    const auto files = source_files(root);
    EXPECT_GT(files.size(), 20u);
    for (const std::string& path : files) {
        // From the root of its library: libagvd/agvd/... and libremesh/remesh/...
        const fs::path relative = fs::relative(path, root);
        const std::string file = fs::relative(relative, *relative.begin());
        std::ifstream stream(path);
        int number = 0;
        for (std::string line; std::getline(stream, line);) {
            ++number;
            const std::string text = complaint(file, line);
            EXPECT_EQ(text, "") << relative << ":" << number << ": " << line;
        }
    }
}

TEST(Layering, BreachesAreSeen) {
    EXPECT_NE(complaint("agvd/core/types.h", "#include \"agvd/mesh/surface.h\""), "");
    EXPECT_NE(complaint("agvd/diagram/cells.cpp", "#include \"remesh/dual/build_dual.h\""), "");
    EXPECT_NE(complaint("remesh/pipeline/remesh.cpp", "#include \"remesh/io/read_mesh.h\""), "");
    EXPECT_NE(complaint("agvd/mesh/surface.cpp", "#include \"surface.h\""), "");
    EXPECT_NE(complaint("agvd/mesh/surface.cpp", "#include \"../core/types.h\""), "");
    EXPECT_NE(complaint("agvd/misc/a.cpp", "#include \"agvd/core/types.h\""), "");
    EXPECT_NE(complaint("agvd/diagram/cells.cpp", "  #  include <CGAL/Surface_mesh.h>"), "");
    EXPECT_NE(complaint("remesh/repair/closed_ball.h", "#include <CGAL/Surface_mesh.h>"), "");
    EXPECT_NE(complaint("agvd/propagation/propagate.cpp", "#include <tbb/parallel_for.h>"), "");
    EXPECT_NE(complaint("remesh/quality/topology.cpp", "#include <OpenMesh/Core/IO/MeshIO.hh>"),
              "");
    EXPECT_NE(complaint("agvd/mesh/surface.cpp", "#include <boost/version.hpp>"), "");
    EXPECT_NE(complaint("agvd/intrinsic/face_charts.h", "#include \"agvd/propagation/corners.h\""),
              "");
    EXPECT_NE(complaint("agvd/propagation/propagate.cpp",
                        "#include \"agvd/intrinsic/intrinsic_triangulation.h\""),
              "");
    EXPECT_NE(complaint("remesh/features/find_creases.cpp",
                        "#include \"agvd/intrinsic/intrinsic_triangulation.h\""),
              "");
    EXPECT_EQ(complaint("remesh/features/find_creases.cpp", "#include \"agvd/mesh/surface.h\""),
              "");
    EXPECT_EQ(complaint("agvd/metrics/compare.h", "#include \"agvd/diagram/diagram.h\""), "");
    EXPECT_EQ(complaint("remesh/io/report.h", "#include \"remesh/pipeline/remesh.h\""), "");
    EXPECT_EQ(complaint("agvd/mesh/surface.cpp", "#include <vector>"), "");
}
