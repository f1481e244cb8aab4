// Patches (faces connected through edges of exactly two faces) get one orientation. At other edges
// the flattest pairs belong together, among equals those of a convex wedge, so that boxes that
// touch along an edge stay apart. Where bodies touch in a wall, the pairs are those with a body
// between them. Vertices are copied until indices alone give these pairs.
#include <algorithm>
#include <numbers>
#include <string>
#include <tuple>

#include "agvd/core/error.h"
#include "agvd/core/portable_math.h"
#include "remesh/clean/soup.h"

namespace remesh::detail {
namespace {

// If this share of a closed patch agrees (such as the inner wall of a hollow body), its orientation
// is kept; otherwise it is turned outward, for files without any.
constexpr double clear_majority = 0.75;

struct Patch {
    std::vector<Index> faces;  // In the order in which they were reached.
    Index turned = 0;          // Number of faces oriented against the first one.
    bool is_closed = true;
};

// Collects the patch of `seed`; `is_turned` is relative to it.
Patch spread(const Soup& soup, const std::vector<Index>& across, Index seed,
             std::vector<bool>& is_seen, std::vector<bool>& is_turned, Ticker& ticker) {
    Patch patch;
    patch.faces.push_back(seed);
    is_seen[seed] = true;
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
        ticker.tick();
        const Index face = patch.faces[i];
        if (is_turned[face]) ++patch.turned;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (across[h] == no_index) {
                patch.is_closed = false;
                continue;
            }
            const Index other = across[h] / 3;
            const bool turned = is_turned[face] != (soup.runs_up(h) == soup.runs_up(across[h]));
            if (!is_seen[other]) {
                is_seen[other] = true;
                is_turned[other] = turned;
                patch.faces.push_back(other);
            } else if (is_turned[other] != turned) {
                throw InvalidInput(
                    "the surface is not orientable (one-sided like a Moebius strip) at face " +
                    std::to_string(soup.face_origin[other]) +
                    "; cut it open along a line that crosses this face");
            }
        }
    }
    return patch;
}

// Six times the signed volume between a face and a point.
double volume_to(const Soup& soup, Index face, const Vec3& origin) {
    const auto& [a, b, c] = soup.mesh.triangles[face];
    return (soup.mesh.positions[a] - origin)
        .dot((soup.mesh.positions[b] - origin).cross(soup.mesh.positions[c] - origin));
}

// Whether the first face, and those oriented like it, are to be turned.
bool first_side_yields(const Soup& soup, const Patch& patch, const std::vector<bool>& is_turned) {
    const auto total = static_cast<double>(patch.faces.size());
    const bool is_minority = 2 * static_cast<double>(patch.turned) > total;
    const double majority = (is_minority ? patch.turned : total - patch.turned) / total;
    if (!patch.is_closed || majority >= clear_majority) return is_minority;
    const Vec3& origin = soup.mesh.positions[soup.mesh.triangles[patch.faces[0]][0]];
    double volume = 0;  // If the turned faces were turned back.
    for (const Index face : patch.faces) {
        volume += (is_turned[face] ? -1 : 1) * volume_to(soup, face, origin);
    }
    return volume < 0;
}

// All faces at an edge of more faces than this are cut apart: the number of pairs grows with the
// square.
constexpr std::size_t most_sheets = 64;

// Between equally flat pairs the one that bounds a convex wedge wins. Far above rounding, far below
// differences that flatness should decide.
constexpr double convex_bonus = 1e-3;

// Faces at a smaller angle (radians) lie on each other: coordinates in single precision give 1e-5
// where faces are a hundredth of the mesh.
constexpr double folded_angle = 1e-4;

void join(std::vector<Index>& twin, Index a, Index b) {
    twin[a] = b;
    twin[b] = a;
}

struct InsideAngle {
    double radians, cosine;
};

// The angle between two faces that traverse their common edge in opposite directions, through the
// body that they bound: about 2 pi where they lie on each other.
// \param is_turned  bodies lie on the side of the normals.
InsideAngle angle_inside(const Soup& soup, Index a, Index b, bool is_turned) {
    const Vec3& origin = soup.mesh.positions[soup.tail(a)];
    const Vec3 along = (soup.mesh.positions[soup.head(a)] - origin).normalized();
    const Vec3 normal = along.cross(soup.mesh.positions[soup.apex(a)] - origin).normalized();
    const Vec3 up = soup.mesh.positions[soup.apex(b)] - origin;
    const double below = (is_turned ? 1 : -1) * normal.dot(up);
    const double beside = normal.cross(along).dot(up);
    const double angle = portable::atan2(below, beside);
    const double cosine = beside / std::max(Vec2(beside, below).norm(), 1e-300);
    return {angle < folded_angle ? angle + 2 * std::numbers::pi : angle, cosine};
}

// Whether the faces enclose a negative volume. A surface where an edge has an odd number of faces
// is open, and encloses none.
bool is_inside_out(Soup& soup, std::span<const EdgeSide> sides) {
    bool is_closed = true;
    for_each_edge(sides, [&](auto edge) { is_closed &= edge.size() % 2 == 0; });
    if (!is_closed) return false;
    const Vec3& origin = soup.mesh.positions[soup.mesh.triangles[0][0]];
    double volume = 0;
    for (Index f = 0; f < soup.mesh.triangles.size(); ++f) {
        soup.ticker.tick();
        volume += volume_to(soup, f, origin);
    }
    return volume < 0;
}

// Whether the faces have the same corners. They are the walls of two bodies, and stay apart.
bool are_opposite(const Soup& soup, const EdgeSide& a, const EdgeSide& b) {
    return soup.apex(a.half_edge) == soup.apex(b.half_edge);
}

// How well two faces go together. Flat pairs do best; where faces lie on each other, those with
// the least of a body between them.
double fitness(const InsideAngle& angle, bool has_walls) {
    if (has_walls) return -angle.radians;
    return -angle.cosine + (angle.radians < std::numbers::pi ? convex_bonus : 0);
}

void pair_faces(const Soup& soup, std::span<const EdgeSide> edge, bool is_turned,
                std::vector<Index>& twin) {
    if (edge.size() > most_sheets) return;
    struct Pair {
        InsideAngle angle;
        double fitness;
        Index a, b;
    };
    std::vector<Pair> pairs;
    bool has_walls = false;
    for (const EdgeSide& up : edge) {
        if (!soup.runs_up(up.half_edge)) continue;
        for (const EdgeSide& down : edge) {
            if (soup.runs_up(down.half_edge)) continue;
            if (are_opposite(soup, up, down)) {
                has_walls = true;
                continue;
            }
            const InsideAngle angle = angle_inside(soup, up.half_edge, down.half_edge, is_turned);
            has_walls = has_walls || angle.radians >= 2 * std::numbers::pi - folded_angle;
            pairs.push_back({angle, 0, up.half_edge, down.half_edge});
        }
    }
    for (Pair& pair : pairs) pair.fitness = fitness(pair.angle, has_walls);
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
        return std::tie(q.fitness, p.a, p.b) < std::tie(p.fitness, q.a, q.b);
    });
    for (const Pair& pair : pairs) {
        if (twin[pair.a] == no_index && twin[pair.b] == no_index) join(twin, pair.a, pair.b);
    }
}

// Gives each fan of faces its own vertex; the first fan keeps the old one.
void separate_fans(Soup& soup, const std::vector<Index>& twin) {
    std::vector<bool> is_taken(soup.mesh.positions.size(), false);
    std::vector<bool> is_done(soup.num_half_edges(), false);
    for (Index start = 0; start < soup.num_half_edges(); ++start) {
        soup.ticker.tick();
        if (is_done[start]) continue;
        Index vertex = soup.tail(start);
        if (is_taken[vertex]) {
            soup.mesh.positions.push_back(Vec3(soup.mesh.positions[vertex]));
            soup.vertex_origin.push_back(soup.vertex_origin[vertex]);
            vertex = static_cast<Index>(soup.mesh.positions.size() - 1);
            ++soup.counts.split_vertices;
        } else {
            is_taken[vertex] = true;
        }
        const auto take = [&](Index h) {
            is_done[h] = true;
            soup.mesh.triangles[h / 3][h % 3] = vertex;
        };
        Index h = start;
        do {
            take(h);
            h = twin[Surface::previous(h)];
        } while (h != no_index && h != start);
        if (h == start) continue;
        for (h = twin[start]; h != no_index; h = twin[h]) {  // An open fan: the other way too.
            h = Surface::next(h);
            take(h);
        }
    }
}

// Whether vertex indices alone give the twins at `edge`.
bool is_told_by_indices(const Soup& soup, std::span<const EdgeSide> edge) {
    if (edge.size() == 1) return true;
    return edge.size() == 2 && soup.runs_up(edge[0].half_edge) != soup.runs_up(edge[1].half_edge);
}

}  // namespace

bool orient_faces(Soup& soup, std::span<const EdgeSide> sides) {
    std::vector<Index> across(soup.num_half_edges(), no_index);
    bool is_consistent = true;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick();
        if (edge.size() != 2) return;
        const Index a = edge[0].half_edge, b = edge[1].half_edge;
        join(across, a, b);
        if (soup.runs_up(a) == soup.runs_up(b)) is_consistent = false;
    });
    if (is_consistent) return false;

    const auto num_faces = static_cast<Index>(soup.mesh.triangles.size());
    std::vector<bool> is_seen(num_faces, false), is_turned(num_faces, false);
    std::vector<Index> to_turn;
    for (Index seed = 0; seed < num_faces; ++seed) {
        if (is_seen[seed]) continue;
        const Patch patch = spread(soup, across, seed, is_seen, is_turned, soup.ticker);
        if (patch.turned == 0) continue;
        const bool first_yields = first_side_yields(soup, patch, is_turned);
        for (const Index face : patch.faces) {
            if (is_turned[face] != first_yields) to_turn.push_back(face);
        }
    }
    for (const Index face : to_turn)
        std::swap(soup.mesh.triangles[face][1], soup.mesh.triangles[face][2]);
    soup.counts.flipped_faces += static_cast<Index>(to_turn.size());
    return true;
}

std::vector<Index> pair_sheets(Soup& soup, std::span<const EdgeSide> sides) {
    std::vector<Index> twin(soup.num_half_edges(), no_index);
    const bool is_turned = is_inside_out(soup, sides);
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        soup.ticker.tick(edge.size());
        if (edge.size() == 2 && !are_opposite(soup, edge[0], edge[1])) {
            join(twin, edge[0].half_edge, edge[1].half_edge);
        }
        if (edge.size() <= 2) return;
        ++soup.counts.split_edges;
        pair_faces(soup, edge, is_turned, twin);
    });
    return twin;
}

// A sheet may meet itself along an edge while its faces are connected around both ends: the edge
// stays double. The first round cuts such edges open; later rounds cut all edges of faces still in
// conflict.
void split_vertices(Soup& soup, std::vector<Index>& twin) {
    separate_fans(soup, twin);
    const CleanCounts& counts = soup.counts;  // Without these no edge is double.
    if (counts.split_edges + counts.absorbed_faces + counts.degenerate_faces == 0) return;
    for (bool is_first_round = true;; is_first_round = false) {
        bool is_clear = true;
        for_each_edge(
            sorted_edge_sides(soup.mesh.triangles, soup.ticker),
            [&](std::span<const EdgeSide> edge) {
                soup.ticker.tick();
                if (is_told_by_indices(soup, edge)) return;
                is_clear = false;
                for (const EdgeSide& side : edge) {
                    const Index first = 3 * (side.half_edge / 3);
                    for (Index h = first; h < first + 3; ++h) {
                        if ((is_first_round && h != side.half_edge) || twin[h] == no_index)
                            continue;
                        twin[twin[h]] = no_index;
                        twin[h] = no_index;
                    }
                }
            });
        if (is_clear) return;
        separate_fans(soup, twin);
    }
}

}  // namespace remesh::detail
