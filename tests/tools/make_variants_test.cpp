// The program `make_variants` as a process: scripts/corpus depends on its files.
#include <map>
#include <set>

#include "remesh/meshfile/mesh_file.h"
#include "support/damages.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace fs = std::filesystem;

namespace {

class MakeVariants : public Scratch {
protected:
    // The files' bytes by name.
    [[nodiscard]] std::map<std::string, std::string> make(const std::string& folder,
                                                          std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), at(folder));
        const auto outcome = run(MAKE_VARIANTS_PROGRAM, arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::directory_iterator(at(folder))) {
            const std::string name = entry.path().filename().string();
            files[name] = bytes(fs::path(folder) / name);
        }
        return files;
    }
};

// The words of a name between underscores, without the extension.
std::set<std::string> words_of(const std::string& name) {
    std::istringstream text(fs::path(name).stem().string());
    std::set<std::string> words;
    for (std::string word; std::getline(text, word, '_');) words.insert(word);
    return words;
}

TEST_F(MakeVariants, SameSeedGivesTheSameBytesAndTwelveHaveEveryKindOfDamage) {
    const auto files = make("a", {"12", "7"});
    EXPECT_EQ(files.size(), 12U);
    EXPECT_TRUE(files == make("b", {"12", "7"}));
    EXPECT_FALSE(files == make("c", {"12", "8"}));
    std::set<std::string> used;
    for (const auto& [name, content] : files) {
        EXPECT_GE(remesh::read_mesh(at("a/" + name)).mesh.triangles.size(), 1U) << name;
        used.merge(words_of(name));
    }
    for (const char* const kind : damages::kinds()) EXPECT_TRUE(used.contains(kind)) << kind;
}

TEST_F(MakeVariants, GivenMeshesAreDamagedToo) {
    int given = 0;
    for (const auto& [name, content] :
         make("a", {"12", "7", put("my_ball.off", shapes::sphere(2))})) {
        if (name.substr(3).starts_with("_my-ball_")) ++given;
    }
    EXPECT_GT(given, 0);
    EXPECT_LT(given, 12);
}

TEST(Damages, EveryKindChangesTheMeshAndLeavesItFinite) {
    const agvd::TriangleMesh ball = shapes::sphere(2);
    for (const char* const kind : damages::kinds()) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            SCOPED_TRACE(std::string(kind) + " with seed " + std::to_string(seed));
            Dice dice(seed);
            const agvd::TriangleMesh mesh = damages::apply(kind, ball, dice);
            EXPECT_GE(mesh.triangles.size(), 1U);
            EXPECT_FALSE(mesh.positions == ball.positions && mesh.triangles == ball.triangles);
            for (const agvd::Vec3& p : mesh.positions) EXPECT_TRUE(p.allFinite());
        }
    }
    Dice dice(0);
    EXPECT_THROW(static_cast<void>(damages::apply("rust", ball, dice)), std::invalid_argument);
}

}  // namespace
