// Reads every #include line of the libraries and holds it against the layers: data flows down the
// rows, a file includes its own row or rows above, and each package stays where it belongs. And
// holds public headers against the tests that they name.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

// The folders in the order in which the data passes through them.
constexpr const char* folders[] = {
    "agvd/core",       "agvd/mesh",    "agvd/intrinsic",  "agvd/propagation", "agvd/diagram",
    "agvd/paths",      "remesh",       "remesh/meshfile", "remesh/clean",     "remesh/curves",
    "remesh/dual",     "remesh/sites", "remesh/tiles",    "remesh/placement", "remesh/quality",
    "remesh/transfer", "remesh/wrap",  "remesh/pipeline", "remesh/tilefiles",
};

struct Package {
    const char* prefix;  // Of its headers.
    const char* where;   // Pattern of the files that may include them.
};

constexpr Package packages[] = {
    {"Eigen/", R"(agvd/core/types\.h)"},
    {"tbb/", R"(agvd/core/helpers_tbb\.cpp)"},
    {"CGAL/",
     R"(remesh/clean/hole_triangles\.cpp|remesh/quality/.*\.cpp|remesh/wrap/(alpha_wrap\.cpp|unite_solids\.cpp|cgal_mesh\.h))"},
    {"OpenMesh/", R"(remesh/meshfile/(.*\.cpp|openmesh_exchange\.h))"},
    {"nlohmann/",
     R"(remesh/meshfile/(.*\.cpp|gltf_document\.h|materials\.h)|remesh/tilefiles/tile_file\.cpp)"},
    {"fast_float/", R"(remesh/meshfile/(.*\.cpp|text_scanner\.h))"},
    {"expat.h", R"(remesh/meshfile/xml_reader\.cpp)"},
    {"zlib.h", R"(remesh/meshfile/packed\.cpp)"},
    {"sys/", R"(remesh/meshfile/.*\.cpp|remesh/tilefiles/mapped_file_posix\.cpp)"},
};

std::string folder_of(const std::string& file) { return file.substr(0, file.rfind('/')); }

// The folders of the two engines stand in the row of propagation.
std::optional<std::size_t> row_of(const std::string& file) {
    static const std::regex engines("^agvd/propagation/(window|steiner)$");
    const std::string folder = std::regex_replace(folder_of(file), engines, "agvd/propagation");
    const auto* const found = std::find(std::begin(folders), std::end(folders), folder);
    if (found == std::end(folders)) return std::nullopt;
    return static_cast<std::size_t>(found - std::begin(folders));
}

// agvd/agvd.h and remesh/remesh.h include all that users need.
bool is_umbrella(const std::string& file) {
    return file == "agvd/agvd.h" || file == "remesh/remesh.h";
}

// Headers that are installed: those that the libraries' CMakeLists.txt name.
std::set<std::string> find_public_headers() {
    std::set<std::string> headers;
    static const std::regex header(R"((agvd|remesh)/[a-z_/]+\.h)");
    for (const char* library : {"libagvd", "libremesh"}) {
        std::ifstream stream(fs::path(AGVD_SOURCE_DIR) / library / "CMakeLists.txt");
        for (std::string line; std::getline(stream, line);) {
            std::smatch match;
            if (std::regex_search(line, match, header)) headers.insert(match[0]);
        }
    }
    return headers;
}

bool is_public(const std::string& header) {
    static const std::set<std::string> headers = find_public_headers();
    return headers.count(header) > 0;
}

// What is wrong with `line` in `file` (a path such as agvd/mesh/surface.h); empty: nothing.
std::string complaint(const std::string& file, const std::string& line) {
    static const std::regex include(R"re(\s*#\s*include\s*(["<])([^">]*)[">].*)re");
    std::smatch match;
    if (!std::regex_match(line, match, include)) return "";
    const std::string header = match[2];
    if (match[1] == "\"") {
        if (is_public(file) && !is_public(header)) return "is not installed";
        if (is_umbrella(file)) return "";
        const auto row = row_of(header);
        if (!row) return "is not a path from the root of a library";
        if (!row_of(file)) return "stands in a folder that has no row";
        if (*row > row_of(file)) return "points to a lower row";
        // Both libraries are built on core, mesh and intrinsic; of other folders only the other
        // library's installed headers may be seen, and the bounds of distances.
        if (file.rfind("remesh/", 0) == 0 && header.rfind("agvd/", 0) == 0 &&
            *row > *row_of("agvd/intrinsic/simplify.h") && !is_public(header) &&
            header != "agvd/propagation/distance_bounds.h") {
            return "is private to the other library";
        }
        // What propagation runs on is a surface, whatever made it.
        if (file.rfind("agvd/propagation/", 0) == 0 && header.rfind("agvd/intrinsic/", 0) == 0) {
            return "points to the intrinsic base";
        }
        // Remeshing takes meshes from memory; attributes and tiles pass from file to file.
        if (folder_of(header) == "remesh/meshfile" && folder_of(file) != "remesh/meshfile" &&
            folder_of(file) != "remesh/transfer" && folder_of(file) != "remesh/tilefiles") {
            return "makes remeshing know of files";
        }
        // Creases are found before there are sites, on the input as it is.
        if (folder_of(file) == "remesh/curves" && folder_of(header) != "remesh/curves" &&
            folder_of(header) != "remesh" && *row > 1) {
            return "is more than features are found on";
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

TEST(Layering, TheSearchOfBoundsIsNotInstalled) {
    EXPECT_TRUE(is_public("agvd/propagation/propagate.h"));
    EXPECT_FALSE(is_public("agvd/propagation/distance_bounds.h"));
}

// A comment says what it is about by itself.
TEST(Comments, DoNotReferToTheOneBefore) {
    static const std::regex vague(R"(//!?<? *(Likewise\b|Those found\.|Any value works\.).*)");
    for (const std::string& path : source_files(AGVD_SOURCE_DIR)) {
        std::ifstream stream(path);
        for (std::string line; std::getline(stream, line);) {
            EXPECT_FALSE(std::regex_search(line, vague)) << path << ": " << line;
        }
    }
}

TEST(Layering, ExamplesIncludeInstalledHeadersOnly) {
    static const std::regex include(R"re(\s*#\s*include\s*"([^"]*)".*)re");
    int num_includes = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(AGVD_SOURCE_DIR) / "tools/examples")) {
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);) {
            std::smatch match;
            if (!std::regex_match(line, match, include)) continue;
            ++num_includes;
            EXPECT_TRUE(is_public(match[1]) || match[1] == "examples/example.h")
                << entry.path() << ": " << line;
        }
    }
    EXPECT_GT(num_includes, 15);
}

namespace {

// Of files without their extension: a header and its source file are one module.
using Includes = std::map<std::string, std::set<std::string>>;

Includes read_includes(const fs::path& root) {
    static const std::regex include(R"re(\s*#\s*include\s*"([^"]*)\.h".*)re");
    Includes includes;
    for (const std::string& path : source_files(root)) {
        const fs::path relative = fs::relative(path, root);
        const fs::path file = fs::relative(relative, *relative.begin());
        const std::string module = (file.parent_path() / file.stem()).string();
        std::ifstream stream(path);
        for (std::string line; std::getline(stream, line);) {
            std::smatch match;
            if (std::regex_match(line, match, include) && match[1] != module) {
                includes[module].insert(match[1]);
            }
        }
    }
    return includes;
}

// A module, those that it includes in turn, and the module again; empty: there is no circle.
std::string find_circle(const Includes& includes) {
    enum class State { New, Open, Done };
    std::map<std::string, State> states;
    std::string circle;
    const std::function<bool(const std::string&)> visit = [&](const std::string& module) {
        State& state = states[module];
        if (state == State::Done) return false;
        if (state == State::Open) {
            circle = module;
            return true;
        }
        state = State::Open;
        if (const auto found = includes.find(module); found != includes.end()) {
            for (const std::string& next : found->second) {
                if (!visit(next)) continue;
                circle = module + " -> " + circle;
                return true;
            }
        }
        states[module] = State::Done;
        return false;
    };
    for (const auto& [module, headers] : includes) {
        if (visit(module)) return circle;
    }
    return "";
}

std::string read_text(const fs::path& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// The suites of all tests, and their tests as Suite.Name.
std::set<std::string> find_tests() {
    static const std::regex test(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+))");
    std::set<std::string> names;
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(AGVD_SOURCE_DIR) / "tests")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = read_text(entry.path());
        for (std::sregex_iterator i(text.begin(), text.end(), test), end; i != end; ++i) {
            names.insert((*i)[1]);
            names.insert((*i)[1].str() + '.' + (*i)[2].str());
        }
    }
    return names;
}

// The tests that the comment at the top of a header names: "Held by A.B and C in tests/...".
std::vector<std::string> tests_named_by(const std::string& header) {
    static const std::regex held(R"(Held by (.*?)\s+in tests/)"), name(R"([A-Z]\w+(\.[A-Z]\w+)?)");
    std::string top = header.substr(0, header.find("#pragma once"));
    top = std::regex_replace(top, std::regex(R"(\s*//!\s*)"), " ");
    std::smatch match;
    if (!std::regex_search(top, match, held)) return {};
    const std::string list = match[1];
    std::vector<std::string> names;
    for (std::sregex_iterator i(list.begin(), list.end(), name), end; i != end; ++i) {
        names.push_back(i->str());
    }
    return names;
}

}  // namespace

TEST(Layering, NoModulesIncludeEachOtherInACircle) {
    const Includes includes = read_includes(AGVD_SOURCE_DIR);
    EXPECT_GT(includes.size(), 150u);
    EXPECT_EQ(find_circle(includes), "");
}

TEST(Layering, CirclesAreSeen) {
    EXPECT_EQ(find_circle({{"a", {"b"}}, {"b", {"c", "d"}}}), "");
    EXPECT_EQ(find_circle({{"a", {"b"}}, {"b", {"c", "d"}}, {"d", {"b"}}}), "a -> b -> d -> b");
}

TEST(Layering, BreachesAreSeen) {
    EXPECT_NE(complaint("agvd/core/types.h", "#include \"agvd/mesh/surface.h\""), "");
    EXPECT_NE(complaint("agvd/diagram/cells.cpp", "#include \"remesh/dual/build_dual.h\""), "");
    EXPECT_NE(complaint("remesh/pipeline/remesh.h", "#include \"remesh/pipeline/run.h\""), "");
    EXPECT_NE(complaint("agvd/diagram/join.h", "#include \"paper/compare.h\""), "");
    EXPECT_NE(complaint("remesh/meshfile/ply.cpp", "#include \"remesh/pipeline/remesh.h\""), "");
    EXPECT_EQ(complaint("agvd/propagation/steiner/steiner_refinement.cpp",
                        "#include \"agvd/propagation/engines.h\""),
              "");
    EXPECT_NE(complaint("remesh/pipeline/remesh.cpp", "#include \"remesh/meshfile/mesh_file.h\""),
              "");
    EXPECT_NE(complaint("agvd/mesh/surface.cpp", "#include \"surface.h\""), "");
    EXPECT_NE(complaint("agvd/mesh/surface.cpp", "#include \"../core/types.h\""), "");
    EXPECT_NE(complaint("agvd/misc/a.cpp", "#include \"agvd/core/types.h\""), "");
    EXPECT_NE(complaint("agvd/diagram/cells.cpp", "  #  include <CGAL/Surface_mesh.h>"), "");
    EXPECT_NE(complaint("remesh/dual/build_dual.h", "#include <CGAL/Surface_mesh.h>"), "");
    EXPECT_NE(complaint("agvd/propagation/propagate.cpp", "#include <tbb/parallel_for.h>"), "");
    EXPECT_NE(complaint("agvd/mesh/topology.cpp", "#include <OpenMesh/Core/IO/MeshIO.hh>"), "");
    EXPECT_NE(complaint("agvd/mesh/surface.cpp", "#include <boost/version.hpp>"), "");
    EXPECT_NE(complaint("agvd/intrinsic/face_charts.h", "#include \"agvd/propagation/layout.h\""),
              "");
    EXPECT_NE(complaint("agvd/propagation/propagate.cpp",
                        "#include \"agvd/intrinsic/intrinsic_triangulation.h\""),
              "");
    EXPECT_NE(complaint("remesh/curves/find_creases.cpp",
                        "#include \"agvd/intrinsic/intrinsic_triangulation.h\""),
              "");
    EXPECT_EQ(complaint("remesh/curves/find_creases.cpp", "#include \"agvd/mesh/surface.h\""), "");
    EXPECT_EQ(complaint("agvd/mesh/surface.cpp", "#include <vector>"), "");
}

TEST(PublicHeaders, EachNamesTestsThatExist) {
    const std::set<std::string> tests = find_tests();
    EXPECT_GT(tests.size(), 1000u);
    int num_headers = 0;
    for (const std::string& header : find_public_headers()) {
        if (is_umbrella(header) || header == "remesh/names.h") continue;  // Promise nothing.
        ++num_headers;
        const fs::path library = header.rfind("agvd/", 0) == 0 ? "libagvd" : "libremesh";
        const auto named = tests_named_by(read_text(fs::path(AGVD_SOURCE_DIR) / library / header));
        EXPECT_FALSE(named.empty()) << header;
        for (const std::string& test : named)
            EXPECT_EQ(tests.count(test), 1u) << header << ": " << test;
    }
    EXPECT_GT(num_headers, 20);
}

TEST(PublicHeaders, AreFew) { EXPECT_LE(find_public_headers().size(), 35u); }

TEST(PublicHeaders, NamesAreFoundInComments) {
    const std::vector<std::string> found =
        tests_named_by("//! Text. Held by Ab.Bc\n//! and Cd.* in tests/x.\n#pragma once\n");
    EXPECT_EQ(found, (std::vector<std::string>{"Ab.Bc", "Cd"}));
    EXPECT_TRUE(tests_named_by("//! Text.\n#pragma once\n//! Held by A in tests/x\n").empty());
}
