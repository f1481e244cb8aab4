#include "agvd/propagation/window/border_faces.h"

#include <limits>

#include "agvd/mesh/surface.h"

namespace agvd {
namespace {

// Windows of a second site may come to a face if its bound exceeds that of the nearest site by at
// most this share. That is as much as bounds exceed distances. With .05, 30 of 423 sites ran twice;
// with .08, six.
constexpr double slack = 0.08;

// The exact border may lie this far from the border of the bounds, as a share of the distance from
// the site. Where that is less than two rings of faces, nothing is widened.
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
    void mark(const Triangle& triangle, int bits) {
        for (const Index v : triangle) marks_[v] = static_cast<std::uint8_t>(marks_[v] | bits);
    }

    // 1: at a change of label, 2: next to one.
    void mark_two_rings() {
        for (const Triangle& t : surface_.mesh.triangles) {
            const auto &a = bounds_.site[t[0]], &b = bounds_.site[t[1]], &c = bounds_.site[t[2]];
            mark(t, ((a != b) | (b != c)) ? 1 : 0);
        }
        for (const Triangle& t : surface_.mesh.triangles) {
            mark(t, ((marks_[t[0]] | marks_[t[1]] | marks_[t[2]]) & 1) << 1);
        }
    }

    // Widens the marks where two rings are too few, in cells of many faces: as far as a path from
    // the other side of the border may be nearly as short as the bound.
    void widen() {
        const double two_rings = 2 * corners_.mean_length();
        std::vector<float> across(marks_.size(), std::numeric_limits<float>::infinity());
        std::vector<Index> front;
        const auto reach = [&](Index vertex, float distance) {
            if (!(distance < across[vertex])) return;
            across[vertex] = distance;
            if (!(distance <= (1 + slack) * bounds_.distance[vertex])) return;
            marks_[vertex] = static_cast<std::uint8_t>(marks_[vertex] | 2);
            front.push_back(vertex);
        };
        const auto for_each_neighbour = [&](Index vertex, const auto& each) {
            // The last neighbour of a boundary vertex is left out: the rings of other vertices find
            // it.
            for_each_outgoing(surface_, vertex, [&](Index h) {
                each(corners_.head(h), static_cast<float>(corners_.length(h)));
            });
        };
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if ((marks_[v] & 1) == 0 || !(shift * bounds_.distance[v] > two_rings)) continue;
            for_each_neighbour(v, [&](Index neighbour, float length) {
                if (bounds_.site[neighbour] == bounds_.site[v]) return;
                reach(neighbour, bounds_.distance[v] + length);
            });
        }
        for (std::size_t i = 0; i < front.size(); ++i) {
            const Index v = front[i];
            for_each_neighbour(v, [&](Index neighbour, float length) {
                if (bounds_.site[neighbour] != bounds_.site[v]) return;
                reach(neighbour, across[v] + length);
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
