// Each part of a face keeps the points that wait in it. Orientations in the barycentric coordinates
// of the old face, which are exact, decide which part gets each, so that rounding does not add up.
#include <algorithm>
#include <unordered_map>
#include <utility>

#include "agvd/intrinsic/simplify_steps.h"

namespace agvd::detail {
namespace {

// A share of a face: a point nearer to an edge than this lies on the edge.
constexpr double snapping = 1e-9;

// The orientation in the plane of barycentric coordinates 1 and 2; above 0: counter-clockwise.
double orientation(const Shares& a, const Shares& b, const Shares& c) {
    return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
}

// A face that is part of an old face, and the points to be inserted in it.
struct FacePart {
    std::array<Shares, 3> corner;  // Barycentric coordinates of the old face.
    std::vector<Index> waiting;    // Points.
};

class Inserter {
public:
    Inserter(Surface& surface, FaceCharts& charts, std::span<const SurfacePoint> points)
        : surface_(surface),
          charts_(charts),
          points_(points),
          vertex_(points.size(), no_index),
          is_claimed_(surface.num_vertices(), 0) {}

    std::vector<Index> run() {
        for (Index i = 0; i < points_.size(); ++i) {
            face_of_.push_back(points_[i].face.value());
            part_of(face_of_[i]).waiting.push_back(i);
        }
        for (Index i = 0; i < points_.size(); ++i) insert(i);
        return std::move(vertex_);
    }

private:
    FacePart& part_of(Index face) {
        const auto [it, is_new] = parts_.try_emplace(face);
        if (is_new) it->second.corner = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        return it->second;
    }

    void insert(Index point) {
        const Index face = face_of_[point];
        std::erase(part_of(face).waiting, point);
        Shares where = shares_in(part_of(face), points_[point].barycentric);
        const auto near = std::count_if(where.begin(), where.end(),
                                        [](double share) { return share < snapping; });
        const auto k =
            static_cast<Index>(std::max_element(where.begin(), where.end()) - where.begin());
        if (near == 2) {
            const Index corner = surface_.mesh.triangles[face][k];
            if (is_claimed_[corner] == 0) {
                is_claimed_[corner] = 1;
                vertex_[point] = corner;
                return;
            }
        }
        const Index vertex = vertex_[point] = add_vertex(surface_);
        is_claimed_.push_back(1);
        if (near == 1) {
            const auto least =
                static_cast<Index>(std::min_element(where.begin(), where.end()) - where.begin());
            const Index tail = (least + 1) % 3, head = (least + 2) % 3;
            cut_edge(3 * face + tail, where[head] / (where[tail] + where[head]), vertex);
            return;
        }
        double sum = 0;
        for (double& share : where) sum += share = std::max(share, snapping);
        for (double& share : where) share /= sum;
        cut_face(face, where, vertex);
    }

    [[nodiscard]] static Shares shares_in(const FacePart& part, const Shares& point) {
        const auto& [a, b, c] = part.corner;
        Shares shares{orientation(b, c, point), orientation(c, a, point), orientation(a, b, point)};
        double sum = 0;
        for (double& share : shares) sum += share = std::max(share, 0.0);
        if (!(sum > 0)) return {1, 0, 0};
        for (double& share : shares) share /= sum;
        return shares;
    }

    void cut_face(Index face, const Shares& where, Index vertex) {
        FacePart whole = std::move(part_of(face));
        const Index added = surface_.num_faces();
        insert_in_face(surface_, charts_, face, where, vertex);
        const Shares split = mixed(whole, where);
        const std::array<Index, 3> faces{face, added, added + 1};
        const auto& corner = whole.corner;
        for (std::size_t k = 0; k < 3; ++k) {
            parts_[faces[k]] = {{corner[k], corner[(k + 1) % 3], split}, {}};
        }
        for (const Index point : whole.waiting) {
            const Shares& at = points_[point].barycentric;
            // Find the edges from the new vertex to the corners between which the point lies.
            std::array<bool, 3> is_left;
            for (std::size_t k = 0; k < 3; ++k) {
                is_left[k] = orientation(split, corner[k], at) >= 0;
            }
            std::size_t part = 0;
            while (part < 2 && !(is_left[part] && !is_left[(part + 1) % 3])) ++part;
            move_to(point, faces[part]);
        }
    }

    void cut_edge(Index half_edge, double at, Index vertex) {
        const Index twin = surface_.twin[half_edge];
        struct Half {
            FacePart whole;
            std::size_t tail;
            double at;
        };
        std::array<Half, 2> halves;
        halves[0] = {std::move(part_of(Surface::face(half_edge))), half_edge % 3, at};
        if (twin != no_index) {
            halves[1] = {std::move(part_of(Surface::face(twin))), twin % 3, 1 - at};
        }
        const EdgeSplit made = split_edge(surface_, charts_, half_edge, at, vertex);
        for (std::size_t i = 0; i < 2; ++i) {
            if (made.side[i].half_edge == no_index) continue;
            const auto& [whole, tail, share] = halves[i];
            Shares where{0, 0, 0};
            where[tail] = 1 - share;
            where[(tail + 1) % 3] = share;
            const Shares split = mixed(whole, where);
            const Shares& a = whole.corner[tail];
            const Shares& b = whole.corner[(tail + 1) % 3];
            const Shares& c = whole.corner[(tail + 2) % 3];
            const Index face = Surface::face(made.side[i].half_edge);
            parts_[face] = {{a, split, c}, {}};
            parts_[made.side[i].new_face] = {{split, b, c}, {}};
            for (const Index point : whole.waiting) {
                const bool is_near = orientation(split, c, points_[point].barycentric) >= 0;
                move_to(point, is_near ? face : made.side[i].new_face);
            }
        }
    }

    [[nodiscard]] static Shares mixed(const FacePart& part, const Shares& where) {
        Shares sum{0, 0, 0};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) sum[k] += where[i] * part.corner[i][k];
        }
        return sum;
    }

    void move_to(Index point, Index face) {
        parts_[face].waiting.push_back(point);
        face_of_[point] = face;
    }

    Surface& surface_;
    FaceCharts& charts_;
    std::span<const SurfacePoint> points_;
    std::vector<Index> vertex_;   // By point.
    std::vector<Index> face_of_;  // By point: where it waits.
    std::vector<std::uint8_t> is_claimed_;
    std::unordered_map<Index, FacePart> parts_;  // By face.
};

}  // namespace

std::vector<Index> insert_points(Surface& surface, FaceCharts& charts,
                                 std::span<const SurfacePoint> points) {
    return Inserter(surface, charts, points).run();
}

}  // namespace agvd::detail
