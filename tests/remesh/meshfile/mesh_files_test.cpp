// Damaged files: whatever happens to the bytes of a good one, reading it either throws one of our
// errors or gives a mesh that is safe to use.

#include <gtest/gtest.h>

#include <sstream>

#include "agvd/core/random.h"
#include "support/read_text.h"
#include "support/shapes.h"

namespace {

// Random whole numbers below a bound, reproducible.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    std::size_t below(std::size_t bound) {
        return static_cast<std::size_t>(agvd::random_unit(seed_, 0, count_++) *
                                        static_cast<double>(bound));
    }

private:
    std::uint64_t seed_;
    std::uint64_t count_ = 0;
};

// Changes a byte, cuts the end off, deletes, repeats or exchanges a piece, or puts in what parsers
// trip over.
std::string damaged(std::string bytes, Dice& dice) {
    static const std::vector<std::string> traps = {"-1",
                                                   "0",
                                                   "4294967295",
                                                   "99999999999999999999",
                                                   "nan",
                                                   "inf",
                                                   "1e999",
                                                   "\n",
                                                   "\r",
                                                   " ",
                                                   "#",
                                                   "\\",
                                                   "/",
                                                   "-",
                                                   "",
                                                   "f",
                                                   "v",
                                                   ".",
                                                   std::string(1, '\0'),
                                                   "\xff\xff\xff\xff"};
    for (std::size_t rounds = 1 + dice.below(3); rounds > 0 && !bytes.empty(); --rounds) {
        const std::size_t at = dice.below(bytes.size());
        const std::size_t size = std::min(bytes.size() - at, 1 + dice.below(20));
        switch (dice.below(6)) {
            case 0:
                bytes[at] = static_cast<char>(dice.below(256));
                break;
            case 1:
                bytes.resize(at);
                break;
            case 2:
                bytes.erase(at, size);
                break;
            case 3:
                bytes.insert(at, bytes.substr(at, size));
                break;
            case 4:
                bytes.insert(dice.below(bytes.size()), bytes.substr(at, size));
                break;
            default:
                bytes.replace(at, size, traps[dice.below(traps.size())]);
                break;
        }
    }
    return bytes;
}

std::string ascii_ply(const agvd::TriangleMesh& mesh) {
    std::ostringstream out;
    out << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
        << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const auto& p : mesh.positions) out << p.transpose() << '\n';
    for (const auto& [a, b, c] : mesh.triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
    return out.str();
}

std::string ascii_stl(const agvd::TriangleMesh& mesh) {
    std::ostringstream out;
    out << "solid sphere\n";
    for (const auto& triangle : mesh.triangles) {
        out << "facet normal 0 0 1\nouter loop\n";
        for (const auto v : triangle) out << "vertex " << mesh.positions[v].transpose() << '\n';
        out << "endloop\nendfacet\n";
    }
    out << "endsolid sphere\n";
    return out.str();
}

void expect_safe(const std::string& name, const std::string& good, std::uint64_t seed, int rounds) {
    Dice dice(seed);
    int read = 0;
    for (int i = 0; i < rounds; ++i) {
        try {
            const remesh::MeshFile file = texts::read_bytes(name, damaged(good, dice));
            ++read;
            ASSERT_FALSE(file.mesh.triangles.empty());
            ASSERT_EQ(file.face_polygon.size(), file.mesh.triangles.size());
            for (const auto& p : file.mesh.positions) ASSERT_TRUE(p.allFinite());
            for (const auto& triangle : file.mesh.triangles) {
                for (const auto v : triangle) ASSERT_LT(v, file.mesh.positions.size());
            }
        } catch (const agvd::Error& error) {
            ASSERT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(read, 0) << "no damaged file was read: the damage tests nothing but the header";
    EXPECT_LT(read, rounds) << "no damage was noticed";
}

}  // namespace

TEST(MeshFiles, DamagedOnesAreRefusedOrSafe) {
    const agvd::TriangleMesh mesh = shapes::jitter(shapes::icosahedron(), 0.01, 3);
    std::uint64_t seed = 0;
    for (const char* name :
         {"a.ply", "a.obj", "a.off", "a.stl", "a.vtk", "a.vtp", "a.mesh", "a.glb", "a.gltf"}) {
        expect_safe(name, remesh::require_format({name}).format(mesh.view(), {}, {}), ++seed, 2000);
    }
    expect_safe("b.ply", ascii_ply(mesh), ++seed, 2000);
    expect_safe("b.stl", ascii_stl(mesh), ++seed, 2000);
    expect_safe(
        "b.off",
        "COFF # all kinds of polygons\n8 4 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n1 1 0 9 9 9\n0 1 0\n"
        "0 0 1\n1 0 1\n1 1 1\n0 1 1 # last\n4 0 1 2 3 255 0 0\n8 0 1 2 3 4 5 6 7\n3 4 5 6\n5 0 1 "
        "2 6 7\n",
        ++seed, 2000);
    expect_safe(
        "b.obj",
        "v 0 0 0\nv 1 0 0 \\\n 1\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nv 0 0 1\nf 1/1/1 2/1/1 "
        "3/1/1 4/1/1\nf -1//1 -2//1 -3//1\nf 1/1 2/1 3/1 4/1 5/1\n",
        ++seed, 2000);
}
