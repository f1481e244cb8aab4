// What goes into report pages: packed meshes read back, figures by formula, texts that cannot end
// their element.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "agvd/core/random.h"
#include "page/embed.h"
#include "page/face_figures.h"
#include "page/packed_mesh.h"
#include "page/page_mesh.h"
#include "support/shapes.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using page::FaceCode;
using page::PackedMesh;

std::uint32_t take_number(const std::string& bytes, std::size_t& at) {
    std::uint32_t number = 0;
    for (int shift = 0;; shift += 7) {
        const auto byte = static_cast<std::uint8_t>(bytes.at(at++));
        number |= static_cast<std::uint32_t>(byte & 0x7F) << shift;
        if (byte < 0x80) return number;
    }
}

// Reads a packed mesh as tools/viewer/src/packed_mesh.ts does.
class Unpacker {
public:
    explicit Unpacker(const PackedMesh& packed) : packed_(packed) {
        std::size_t gate = 0;
        for (const char code : packed.codes) {
            if (static_cast<FaceCode>(code) == FaceCode::Alone) {
                place_alone();
                continue;
            }
            while (!gates_.at(gate).is_open) ++gate;
            gates_[gate].is_open = false;
            if (static_cast<FaceCode>(code) != FaceCode::None) {
                place_across(gates_[gate], static_cast<FaceCode>(code));
            }
            ++gate;
        }
        for (const auto& point : grid_) {
            mesh_.positions.push_back(packed.low +
                                      packed.step * Vec3(point[0], point[1], point[2]));
        }
    }
    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }

private:
    struct Gate {
        Index a, b, opposite;
        bool is_open = true;
    };
    using Point = std::array<double, 3>;

    Index add(const Point& guess) {
        const std::size_t v = grid_.size(), plane = 3 * packed_.vertices.size();
        Point point = guess;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto byte = [&](std::size_t i) {
                const std::size_t at = i * plane + k * packed_.vertices.size() + v;
                return static_cast<std::uint32_t>(
                    static_cast<std::uint8_t>(packed_.offsets.at(at)));
            };
            const std::uint32_t zigzag = byte(0) | byte(1) << 8 | byte(2) << 16;
            point[k] += zigzag % 2 == 0 ? zigzag / 2 : -(static_cast<double>(zigzag) + 1) / 2;
        }
        grid_.push_back(point);
        starting_.push_back(gates_.max_size());
        ending_.push_back(gates_.max_size());
        return static_cast<Index>(v);
    }
    Index named() {
        const std::uint32_t back = take_number(packed_.corners, at_);
        if (back > 0) return static_cast<Index>(grid_.size()) - back;
        return add(grid_.empty() ? Point{} : grid_.back());
    }
    void open(Index a, Index b, Index opposite) {
        starting_[a] = ending_[b] = gates_.size();
        gates_.push_back({a, b, opposite});
    }
    bool close(std::size_t gate, Index a, Index b) {
        if (gate >= gates_.size() || !gates_[gate].is_open) return false;
        if (gates_[gate].a != a || gates_[gate].b != b) return false;
        gates_[gate].is_open = false;
        return true;
    }
    void place_alone() {
        const Index a = named(), b = named(), c = named();
        mesh_.triangles.push_back({a, b, c});
        open(b, a, c);
        open(c, b, a);
        open(a, c, b);
    }
    void place_across(Gate gate, FaceCode code) {
        const auto [a, b, o, _] = gate;
        const Index x = [&, a = a, b = b, o = o] {
            if (code == FaceCode::Next) return gates_.at(starting_[b]).b;
            if (code == FaceCode::Before) return gates_.at(ending_[a]).a;
            if (code == FaceCode::Other) return named();
            Point guess;
            for (std::size_t k = 0; k < 3; ++k) guess[k] = grid_[a][k] + grid_[b][k] - grid_[o][k];
            return add(guess);
        }();
        mesh_.triangles.push_back({a, b, x});
        if (!close(starting_[b], b, x)) open(x, b, a);
        if (!close(ending_[a], x, a)) open(a, x, b);
    }

    const PackedMesh& packed_;
    std::size_t at_ = 0;  // In packed_.corners.
    std::vector<Point> grid_;
    std::vector<Gate> gates_;
    std::vector<std::size_t> starting_, ending_;
    TriangleMesh mesh_;
};

// The least of the three rotations.
agvd::Triangle rotated(const agvd::Triangle& t) {
    return std::min({t, agvd::Triangle{t[1], t[2], t[0]}, agvd::Triangle{t[2], t[0], t[1]}});
}

void expect_same(const TriangleMesh& mesh) {
    const PackedMesh packed = page::pack_mesh(mesh.view());
    const TriangleMesh read = Unpacker(packed).mesh();
    ASSERT_EQ(read.positions.size(), packed.vertices.size());
    ASSERT_EQ(read.triangles.size(), mesh.triangles.size());
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const agvd::Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            low = low.cwiseMin(mesh.positions[v]);
            high = high.cwiseMax(mesh.positions[v]);
        }
    }
    const double most = 1e-5 * (high - low).stableNorm();
    for (std::size_t v = 0; v < read.positions.size(); ++v) {
        EXPECT_LE((read.positions[v] - mesh.positions[packed.vertices[v]]).stableNorm(), most);
    }
    for (std::size_t f = 0; f < read.triangles.size(); ++f) {
        agvd::Triangle named = read.triangles[f];
        for (Index& v : named) v = packed.vertices[v];
        EXPECT_EQ(rotated(named), rotated(mesh.triangles[packed.faces[f]]));
    }
    const std::set<Index> faces(packed.faces.begin(), packed.faces.end());
    EXPECT_EQ(faces.size(), mesh.triangles.size());
}

TEST(PackedMesh, ReadsBackWithinAHundredThousandthOfTheDiagonal) {
    for (const TriangleMesh& mesh : {shapes::sphere(3), shapes::cube(), shapes::torus(20, 11)}) {
        expect_same(mesh);
    }
}

TEST(PackedMesh, TakesAnyTriangles) {
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                      {0, 0, 1}, {1, 1, 1}, {9, 9, 9}};
    // Three faces at an edge, two that run it the same way, twice the same face, repeated corners;
    // the last point is in no face.
    expect_same(
        {points, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 1, 4}, {0, 1, 2}, {3, 3, 4}, {4, 4, 4}}});
    expect_same({points, {}});
    expect_same({{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}, {{0, 1, 2}}});
    expect_same({{{1e200, 0, 0}, {-1e200, 1, 0}, {0, 1e200, 0}}, {{0, 1, 2}}});
}

TEST(PackedMesh, TakesSoups) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        TriangleMesh mesh;
        for (Index v = 0; v < 12; ++v) {
            mesh.positions.emplace_back(agvd::random_unit(seed, 0, v),
                                        agvd::random_unit(seed, 1, v),
                                        agvd::random_unit(seed, 2, v));
        }
        for (Index f = 0; f < 30; ++f) {
            agvd::Triangle t;
            for (Index k = 0; k < 3; ++k) {
                t[k] = static_cast<Index>(12 * agvd::random_unit(seed, 3, 3 * f + k));
            }
            mesh.triangles.push_back(t);
        }
        expect_same(mesh);
    }
}

// In the file: compressed where zlib is there, and as base64.
TEST(PageMesh, TakesAtMostTwelveBytesForAVertexAndItsTwoTriangles) {
    const TriangleMesh mesh = shapes::sphere(6);
    const page::MeshBlock block = page::to_block({.mesh = mesh.view()});
    if (!block.description["gzip"].get<bool>()) GTEST_SKIP() << "built without zlib";
    EXPECT_LE(block.base64.size(), 12 * mesh.positions.size());
}

TEST(PageMesh, SameBytesAgain) {
    const TriangleMesh mesh = shapes::sphere(3);
    const page::PageMesh of_page{.name = "a", .mesh = mesh.view()};
    EXPECT_EQ(page::to_block(of_page).base64, page::to_block(of_page).base64);
}

TEST(FaceFigures, EquilateralTrianglesFillOneBin) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}}, {{0, 1, 2}}};
    const page::Histograms figures = page::histograms_of(mesh.view(), {});
    EXPECT_EQ(figures.quality.counts.back(), 1U);
    const page::Histogram& angle = figures.angle;
    std::uint64_t near_60 = 0;
    for (std::size_t i = 0; i < angle.counts.size(); ++i) {
        const double low = angle.low + angle.width * static_cast<double>(i);
        if (low + angle.width >= 60 && low <= 60) near_60 += angle.counts[i];
    }
    EXPECT_EQ(near_60, 3U);
    EXPECT_EQ(figures.valence.counts.at(2), 3U);
    // Twice the target.
    const std::vector<double> targets(3, 0.49);
    EXPECT_EQ(page::histograms_of(mesh.view(), targets).edge.counts.at(40), 3U);
}

TEST(FaceFigures, WorstFacesComeFirst) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0.01, 0}, {0.5, -0.1, 0}},
                            {{0, 1, 2}, {0, 1, 3}, {0, 4, 1}, {1, 0, 3}}};
    EXPECT_EQ(page::worst_faces(mesh.view(), 3), (std::vector<Index>{1, 3, 2}));
    EXPECT_EQ(page::worst_faces(mesh.view(), 9).size(), 4U);
}

TEST(Embed, NothingInATextEndsItsElement) {
    const page::Json json = {{"</script><script>alert(1)</script>", "<!-- & \xff"}};
    const std::string text = page::to_script(json);
    EXPECT_EQ(text.find_first_of("<>&"), std::string::npos) << text;
    EXPECT_EQ(page::Json::parse(text).begin().key(), json.begin().key());
}

TEST(Embed, Base64OfTheStandard) {
    EXPECT_EQ(page::to_base64(""), "");
    EXPECT_EQ(page::to_base64("f"), "Zg==");
    EXPECT_EQ(page::to_base64("fo"), "Zm8=");
    EXPECT_EQ(page::to_base64("foo"), "Zm9v");
    EXPECT_EQ(page::to_base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(page::to_base64("\xff\xfe"), "//4=");
}

TEST(Embed, ShellWordsAreQuoted) {
    const std::array<const char*, 5> words{"/x/remesh", "a b.ply", "it's", "", "2%"};
    EXPECT_EQ(page::to_shell(5, words.data(), "remesh"), "remesh 'a b.ply' 'it'\\''s' '' 2%");
}

}  // namespace
