// The surface part of [labelle2007]: finds the lattice cells that the surface crosses, pulls close
// lattice points onto the surface, cuts the tetrahedra, and smooths the mesh. The search follows
// the surface from the first crossed cell, so that its cost goes with the number of faces. Only
// exactly rounded operations are used: the same bytes on every machine.
#include "make_data/contour.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "agvd/core/random.h"

namespace make_data {

using agvd::Index;
using agvd::no_index;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

using Cell = Eigen::Vector3i;

// Kuhn's six tetrahedra of a cube: the paths from corner 0 to corner 7 (bit k: axis k). Under the
// lattice's skew basis they become the congruent tetrahedra of the body-centred cubic lattice.
constexpr std::array<std::array<int, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

// Permutations of a tetrahedron's corners that keep its orientation.
constexpr std::array<std::array<std::size_t, 4>, 12> even_permutations{{{0, 1, 2, 3},
                                                                        {0, 2, 3, 1},
                                                                        {0, 3, 1, 2},
                                                                        {1, 0, 3, 2},
                                                                        {1, 2, 0, 3},
                                                                        {1, 3, 2, 0},
                                                                        {2, 0, 1, 3},
                                                                        {2, 1, 3, 0},
                                                                        {2, 3, 0, 1},
                                                                        {3, 0, 2, 1},
                                                                        {3, 1, 0, 2},
                                                                        {3, 2, 1, 0}}};

Cell corner_of(const Cell& cell, int corner) {
    return cell + Cell(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
}

std::uint64_t key_of(const Cell& cell) {
    std::uint64_t key = 0;
    for (const int i : cell) key = (key << 21) | static_cast<std::uint64_t>(i + (1 << 20));
    return key;
}

// Newton's step onto the surface, with differences for the gradient.
Vec3 pull(const Field& field, const Vec3& p, double step) {
    const double value = field(p);
    Vec3 gradient;
    for (int k = 0; k < 3; ++k) gradient[k] = (field(p + step * Vec3::Unit(k)) - value) / step;
    return p - gradient * (value / gradient.squaredNorm());
}

class Marcher {
public:
    Marcher(const Field& field, const ContourOptions& options) : field_(field), options_(options) {}

    TriangleMesh run() {
        find_cells();
        snap_nodes();
        for (const Cell& cell : cells_) {
            for (const auto& t : tetrahedra) cut(cell, t);
        }
        return std::move(mesh_);
    }

private:
    struct Node {
        Vec3 position;
        double value;
        Index vertex = no_index;  // of the mesh, once snapped
    };
    struct Cut {
        double share;  // of the edge, from `node` to the surface
        Index node, other;
    };

    Index node(const Cell& cell) {
        const auto [it, is_new] =
            node_of_.try_emplace(key_of(cell), static_cast<Index>(nodes_.size()));
        if (is_new) {
            Vec3 lattice = Vec3(cell.y() + cell.z() - cell.x(), cell.z() + cell.x() - cell.y(),
                                cell.x() + cell.y() - cell.z()) /
                           2;
            for (int k = 0; k < 3; ++k) {
                const double unit = agvd::random_unit(7, static_cast<std::uint64_t>(k), it->first);
                lattice[k] += options_.jitter * (2 * unit - 1);
            }
            const Vec3 p = options_.place(options_.spacing * lattice);
            nodes_.push_back({.position = p, .value = field_(p)});
        }
        return it->second;
    }

    // From the first cell that the surface crosses, through every face that it crosses.
    void find_cells() {
        const Vec3 p = options_.inside / options_.spacing;
        Cell cell = Vec3(p.y() + p.z(), p.z() + p.x(), p.x() + p.y()).cast<int>();
        while (is_inside(node(cell))) ++cell.x();
        --cell.x();
        std::unordered_set<std::uint64_t> known{key_of(cell)};
        cells_.push_back(cell);
        for (std::size_t next = 0; next < cells_.size(); ++next) {
            const Cell here = cells_[next];
            std::array<bool, 8> inside{};
            for (std::size_t k = 0; k < 8; ++k) {
                inside[k] = is_inside(node(corner_of(here, static_cast<int>(k))));
            }
            for (int axis = 0; axis < 3; ++axis) {
                for (const int side : {0, 1}) {
                    int count = 0;
                    for (std::size_t k = 0; k < 8; ++k) {
                        if (static_cast<int>(k >> axis & 1) == side && inside[k]) ++count;
                    }
                    Cell across = here;
                    across[axis] += 2 * side - 1;
                    if (count % 4 != 0 && known.insert(key_of(across)).second) {
                        cells_.push_back(across);
                    }
                }
            }
        }
    }

    std::array<Index, 4> nodes_of(const Cell& cell, const std::array<int, 4>& t) {
        return {node(corner_of(cell, t[0])), node(corner_of(cell, t[1])),
                node(corner_of(cell, t[2])), node(corner_of(cell, t[3]))};
    }
    [[nodiscard]] bool is_inside(Index n) const { return nodes_[n].value < 0; }
    [[nodiscard]] double share(Index from, Index to) const {
        return nodes_[from].value / (nodes_[from].value - nodes_[to].value);
    }
    [[nodiscard]] Vec3 cut_point(Index from, Index to) const {
        return nodes_[from].position +
               share(from, to) * (nodes_[to].position - nodes_[from].position);
    }

    // Pulls nodes onto the surface where a cut is close, closest first; never both ends of a
    // crossed edge, so that what merges at a node is always one disc of cuts.
    void snap_nodes() {
        constexpr double close = 0.3;
        std::vector<std::pair<Index, Index>> crossed;  // both ways
        for (const Cell& cell : cells_) {
            for (const auto& corners : tetrahedra) {
                const auto t = nodes_of(cell, corners);
                for (const Index a : t) {
                    for (const Index b : t) {
                        if (is_inside(a) != is_inside(b)) crossed.emplace_back(a, b);
                    }
                }
            }
        }
        std::sort(crossed.begin(), crossed.end());
        crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
        std::vector<Cut> cuts;
        for (const auto& [a, b] : crossed) {
            if (share(a, b) < close) cuts.push_back({share(a, b), a, b});
        }
        std::stable_sort(cuts.begin(), cuts.end(),
                         [](const Cut& a, const Cut& b) { return a.share < b.share; });
        for (const Cut& c : cuts) {
            bool is_free = nodes_[c.node].vertex == no_index;
            auto it = std::lower_bound(crossed.begin(), crossed.end(), std::pair(c.node, Index{0}));
            for (; it != crossed.end() && it->first == c.node; ++it) {
                is_free = is_free && nodes_[it->second].vertex == no_index;
            }
            if (!is_free) continue;
            nodes_[c.node].vertex = static_cast<Index>(mesh_.positions.size());
            mesh_.positions.push_back(cut_point(c.node, c.other));
        }
    }

    // The vertex on the crossed edge from inside to outside; edges that share a snapped node share
    // its vertex.
    Index vertex(Index a, Index b) {
        if (nodes_[a].vertex != no_index) return nodes_[a].vertex;
        if (nodes_[b].vertex != no_index) return nodes_[b].vertex;
        const auto [it, is_new] = cut_of_.try_emplace((std::uint64_t{a} << 32) | b,
                                                      static_cast<Index>(mesh_.positions.size()));
        if (is_new) mesh_.positions.push_back(cut_point(a, b));
        return it->second;
    }
    // Takes an array: elements in braces are evaluated in order, arguments in any order. So the
    // vertices' numbers are always the same.
    void add(const agvd::Triangle& t) {
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
    }

    // One triangle, or two, where the surface passes through a tetrahedron.
    void cut(const Cell& cell, const std::array<int, 4>& corners) {
        const auto t = nodes_of(cell, corners);
        const auto count = std::count_if(t.begin(), t.end(), [&](Index n) { return is_inside(n); });
        if (count == 0 || count == 4) return;
        for (const auto& [i, j, k, l] : even_permutations) {
            const Index a = t[i], b = t[j], c = t[k], d = t[l];
            if (!is_inside(a) || is_inside(d) || is_inside(b) != (count > 1) ||
                is_inside(c) != (count > 2)) {
                continue;
            }
            if (count == 1) {
                add({vertex(a, b), vertex(a, c), vertex(a, d)});
            } else if (count == 3) {
                add({vertex(a, d), vertex(b, d), vertex(c, d)});
            } else {
                add_quad({vertex(a, c), vertex(a, d), vertex(b, d), vertex(b, c)});
            }
            return;
        }
    }
    void add_quad(const std::array<Index, 4>& q) {
        const auto diagonal = [&](std::size_t i, std::size_t j) {
            return (mesh_.positions[q[i]] - mesh_.positions[q[j]]).squaredNorm();
        };
        const std::size_t first = diagonal(0, 2) <= diagonal(1, 3) ? 0 : 1;
        add({q[first], q[first + 1], q[first + 2]});
        add({q[first], q[first + 2], q[(first + 3) % 4]});
    }

    const Field& field_;
    const ContourOptions& options_;
    std::vector<Node> nodes_;
    std::unordered_map<std::uint64_t, Index> node_of_;  // lattice point -> node
    std::unordered_map<std::uint64_t, Index> cut_of_;   // crossed edge -> vertex
    std::vector<Cell> cells_;                           // crossed by the surface
    TriangleMesh mesh_;
};

// Moves every vertex half way to the mean of its neighbours, then back onto the surface.
void smooth(const Field& field, TriangleMesh& mesh) {
    const std::size_t n = mesh.positions.size();
    std::vector<Vec3> sum(n, Vec3::Zero());
    std::vector<double> reach(n, 0), count(n, 0);
    for (const agvd::Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {  // closed: each neighbour comes exactly once
            const Index from = t[k], to = t[(k + 1) % 3];
            sum[from] += mesh.positions[to];
            reach[from] += (mesh.positions[to] - mesh.positions[from]).norm();
            ++count[from];
        }
    }
    for (std::size_t v = 0; v < n; ++v) {
        Vec3& p = mesh.positions[v];
        p = (p + sum[v] / count[v]) / 2;
        p = pull(field, p, 1e-4 * reach[v] / count[v]);
    }
}

double signed_volume(const TriangleMesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        volume += mesh.positions[a].dot(mesh.positions[b].cross(mesh.positions[c])) / 6;
    }
    return volume;
}

}  // namespace

TriangleMesh contour(const Field& field, const ContourOptions& options) {
    TriangleMesh mesh = Marcher(field, options).run();
    // A placement may mirror space, as an inversion does.
    if (signed_volume(mesh) < 0) {
        for (agvd::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    for (int i = 0; i < options.smoothing; ++i) smooth(field, mesh);
    return mesh;
}

}  // namespace make_data
