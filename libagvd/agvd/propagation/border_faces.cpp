#include "agvd/propagation/border_faces.h"

#include "agvd/mesh/one_ring.h"

namespace agvd {
namespace {

// By which share of its distance from the sites a border of bounds may lie off the exact one: in
// cells of 5000 faces .08 is too little on one face or another of most cells, .16 in a tenth of
// them, .2 in a twentieth. A site runs twice where it is too little.
constexpr double shift = 0.2;

// Marks vertices around changes of label, and from them the faces.
class BorderMarks {
public:
    BorderMarks(const Surface& surface, const Corners& corners, const DistanceBounds& bounds)
        : surface_(surface),
          corners_(corners),
          bounds_(bounds),
          marks_(surface.num_vertices(), 0) {}

    std::vector<std::uint8_t> faces() {
        mark_two_rings();
        widen();
        std::vector<std::uint8_t> faces;
        faces.reserve(surface_.num_faces());
        for (const auto& [a, b, c] : surface_.mesh.triangles) {
            faces.push_back((marks_[a] | marks_[b] | marks_[c]) != 0 ? 1 : 0);
        }
        return faces;
    }

private:
    struct Marked {
        Index vertex;
        double gap;  // To the border, along edges.
    };

    void mark(const Triangle& triangle, int bits) {
        for (const Index v : triangle) marks_[v] = static_cast<std::uint8_t>(marks_[v] | bits);
    }

    // 1: at a change of label, 2: next to one.
    void mark_two_rings() {
        for (const Triangle& t : surface_.mesh.triangles) {
            const auto &a = bounds_.site[t[0]], &b = bounds_.site[t[1]], &c = bounds_.site[t[2]];
            mark(t, (a != b) | (b != c) ? 1 : 0);
        }
        for (const Triangle& t : surface_.mesh.triangles) {
            mark(t, ((marks_[t[0]] | marks_[t[1]] | marks_[t[2]]) & 1) << 1);
        }
    }

    // Goes on from the second ring where two rings are too few: in cells of many faces.
    void widen() {
        const double two_rings = 2 * corners_.mean_length();
        std::vector<Marked> front;
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (marks_[v] == 2 && shift * bounds_.distance[v] > two_rings) {
                front.push_back({v, two_rings});
            }
        }
        for (std::size_t i = 0; i < front.size(); ++i) {
            const auto [vertex, gap] = front[i];
            // Not the last neighbour of a boundary vertex, which the rings of others find.
            for_each_outgoing(surface_, vertex, [&](Index h) {
                const Index neighbour = corners_.head(h);
                const double there = gap + corners_.length(h);
                if (marks_[neighbour] != 0) return;
                if (!(there <= shift * bounds_.distance[neighbour])) return;
                marks_[neighbour] = 2;
                front.push_back({neighbour, there});
            });
        }
    }

    const Surface& surface_;
    const Corners& corners_;
    const DistanceBounds& bounds_;
    std::vector<std::uint8_t> marks_;  // #V
};

}  // namespace

std::vector<std::uint8_t> faces_near_borders(const Surface& surface, const Corners& corners,
                                             const DistanceBounds& bounds) {
    return BorderMarks(surface, corners, bounds).faces();
}

}  // namespace agvd
