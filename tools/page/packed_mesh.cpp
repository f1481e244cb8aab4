// Faces grow over their open edges in the order in which these were opened, so that the edge of
// the part that was reached stays one short loop and most corners lie next to their gate on it.
// Related to the cut-border machine (Gumhold, Strasser 1998), but any triangles are allowed.
#include "page/packed_mesh.h"

#include <array>
#include <cmath>

#include "agvd/core/groups.h"
#include "agvd/mesh/scale.h"

namespace page {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Vec3;

using GridPoint = std::array<std::int64_t, 3>;

// An edge that the next face runs along.
struct Gate {
    Index a, b;  // In the new order.
    Index opposite;
    bool is_open = true;
};

class Packer {
public:
    explicit Packer(const agvd::MeshView& mesh)
        : mesh_(mesh),
          half_edges_(static_cast<Index>(mesh.positions.size()),
                      [&](const auto& add) {
                          for (Index f = 0; f < mesh.triangles.size(); ++f) {
                              for (Index k = 0; k < 3; ++k) add(mesh.triangles[f][k], 3 * f + k);
                          }
                      }),
          is_placed_(mesh.triangles.size(), false),
          number_(mesh.positions.size(), no_index) {
        const agvd::MeshBox box = agvd::box_of(mesh);
        if (!box.is_empty()) {
            packed_.low = box.low;
            packed_.step = (box.high - box.low).stableNorm() / grid_steps;  // Any size.
        }
    }

    PackedMesh pack() && {
        for (Index f = 0; f < mesh_.triangles.size(); ++f) {
            if (is_placed_[f]) continue;
            place_alone(f);
            while (next_gate_ < gates_.size()) pass(next_gate_++);
        }
        split_offsets();
        return std::move(packed_);
    }

private:
    // The grid point of a vertex of the caller.
    [[nodiscard]] GridPoint grid_point(Index v) const {
        GridPoint point{};
        if (packed_.step == 0) return point;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            point[k] = std::llround((mesh_.positions[v][at] - packed_.low[at]) / packed_.step);
        }
        return point;
    }

    void code(FaceCode code) { packed_.codes += static_cast<char>(code); }

    // A new vertex of the caller. \return its new number.
    Index add_vertex(Index v, const GridPoint& guess) {
        const auto number = static_cast<Index>(points_.size());
        number_[v] = number;
        packed_.vertices.push_back(v);
        points_.push_back(grid_point(v));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t offset = points_.back()[k] - guess[k];
            zigzag_.push_back(
                static_cast<std::uint32_t>(offset < 0 ? -2 * offset - 1 : 2 * offset));
        }
        next_.push_back(no_index);
        before_.push_back(no_index);
        return number;
    }

    // A corner in `corners`: 0 is a new vertex, others count back from the newest.
    Index name_corner(Index v) {
        if (number_[v] == no_index) {
            append_number(0, packed_.corners);
            return add_vertex(v, points_.empty() ? GridPoint{} : points_.back());
        }
        append_number(static_cast<std::uint32_t>(points_.size()) - number_[v], packed_.corners);
        return number_[v];
    }

    void open(Index a, Index b, Index opposite) {
        const auto gate = static_cast<Index>(gates_.size());
        gates_.push_back({a, b, opposite});
        next_[a] = gate;
        before_[b] = gate;
    }

    void place_alone(Index f) {
        code(FaceCode::Alone);
        is_placed_[f] = true;
        packed_.faces.push_back(f);
        std::array<Index, 3> corner{};
        for (std::size_t k = 0; k < 3; ++k) corner[k] = name_corner(mesh_.triangles[f][k]);
        for (std::size_t k = 0; k < 3; ++k) {
            open(corner[(k + 1) % 3], corner[k], corner[(k + 2) % 3]);
        }
    }

    // The half-edge of a face that is not placed; no_index: there is none.
    [[nodiscard]] Index half_edge_from(Index a, Index b) const {
        for (const Index h : half_edges_.of(a)) {
            if (!is_placed_[h / 3] && mesh_.triangles[h / 3][(h + 1) % 3] == b) return h;
        }
        return no_index;
    }

    // Whether the gate is open and runs so; closes it.
    bool close(Index gate, Index a, Index b) {
        if (gate == no_index || !gates_[gate].is_open) return false;
        if (gates_[gate].a != a || gates_[gate].b != b) return false;
        gates_[gate].is_open = false;
        return true;
    }

    void pass(std::size_t at) {
        if (!gates_[at].is_open) return;
        gates_[at].is_open = false;
        const auto [a, b, opposite, _] = gates_[at];
        const Index h = half_edge_from(packed_.vertices[a], packed_.vertices[b]);
        if (h == no_index) return code(FaceCode::None);
        is_placed_[h / 3] = true;
        packed_.faces.push_back(h / 3);
        const Index x = third_corner(a, b, opposite, mesh_.triangles[h / 3][(h + 2) % 3]);
        if (!close(next_[b], b, x)) open(x, b, a);
        if (!close(before_[a], x, a)) open(a, x, b);
    }

    Index third_corner(Index a, Index b, Index opposite, Index v) {
        if (number_[v] == no_index) {
            code(FaceCode::New);
            GridPoint guess;
            for (std::size_t k = 0; k < 3; ++k) {
                guess[k] = points_[a][k] + points_[b][k] - points_[opposite][k];
            }
            return add_vertex(v, guess);
        }
        const Index x = number_[v];
        if (next_[b] != no_index && gates_[next_[b]].b == x) {
            code(FaceCode::Next);
        } else if (before_[a] != no_index && gates_[before_[a]].a == x) {
            code(FaceCode::Before);
        } else {
            code(FaceCode::Other);
            name_corner(v);
        }
        return x;
    }

    void split_offsets() {
        for (int shift = 0; shift < 24; shift += 8) {
            for (std::size_t k = 0; k < 3; ++k) {
                for (std::size_t i = k; i < zigzag_.size(); i += 3) {
                    packed_.offsets += static_cast<char>((zigzag_[i] >> shift) & 0xFF);
                }
            }
        }
    }

    agvd::MeshView mesh_;
    agvd::Groups half_edges_;  // By the vertex where they start.
    std::vector<bool> is_placed_;
    std::vector<Index> number_;         // By vertex of the caller: in the new order.
    std::vector<GridPoint> points_;     // By new vertex.
    std::vector<Gate> gates_;           // All that were opened.
    std::vector<Index> next_, before_;  // By new vertex: last gate that starts, that ends there.
    std::size_t next_gate_ = 0;
    std::vector<std::uint32_t> zigzag_;  // Three for each new vertex.
    PackedMesh packed_;
};

}  // namespace

void append_number(std::uint32_t number, std::string& bytes) {
    for (; number >= 0x80; number >>= 7) bytes += static_cast<char>((number & 0x7F) | 0x80);
    bytes += static_cast<char>(number);
}

PackedMesh pack_mesh(const agvd::MeshView& mesh) { return Packer(mesh).pack(); }

}  // namespace page
