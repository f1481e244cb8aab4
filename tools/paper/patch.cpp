// Gathers the faces within a radius by a search across edges, gives each run of faces around a
// vertex a vertex of its own, and inserts the points: first those on edges, which both faces of the
// edge must share, then those inside faces, one by one. Each insertion splits the part that holds
// the point into three, or the two parts at a side into two each.
#include "paper/patch.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "agvd/mesh/closest_point.h"

namespace agvd {
namespace {

// Of the coordinates in a face: nearer points become one, so that no part of a face is flat.
constexpr double least_share = 1e-6;

class PatchCutter {
public:
    PatchCutter(const Surface& surface, std::span<const SurfacePoint> points, Ticker ticker)
        : surface_(surface), points_(points), ticker_(ticker) {}

    Patch cut(const SurfacePoint& center, double radius) {
        gather_faces(center, radius);
        number_corners();
        place_points();
        for (Index i = 0; i < faces_.size(); ++i) {
            ticker_.tick(4);
            append_face(i);
        }
        return std::move(patch_);
    }

private:
    struct EdgePoint {
        double at;  // Share of the way along the edge's first half-edge.
        Index point;
    };

    void gather_faces(const SurfacePoint& center, double radius) {
        const Vec3 middle = position(surface_.mesh.view(), center);
        const auto take = [&](Index face) {
            if (local_.contains(face)) return true;
            const auto& [a, b, c] = surface_.mesh.triangles[face];
            const auto& p = surface_.mesh.positions;
            const auto nearest =
                closest_point_on_triangle({p[a], p[b], p[c]}, FaceId(face), middle);
            if (nearest.distance_sq > radius * radius) return false;
            local_[face] = static_cast<Index>(faces_.size());
            faces_.push_back(face);
            return true;
        };
        patch_.is_whole = take(center.face.value());
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            ticker_.tick(8);
            for (Index k = 0; k < 3; ++k) {
                const Index across = surface_.twin[3 * faces_[i] + k];
                if (across != no_index && !take(Surface::face(across))) patch_.is_whole = false;
            }
        }
    }

    // The half-edge of the patch that a half-edge of the surface is, or no_index.
    [[nodiscard]] Index in_patch(Index half_edge) const {
        if (half_edge == no_index) return no_index;
        const auto found = local_.find(Surface::face(half_edge));
        return found == local_.end() ? no_index : 3 * found->second + half_edge % 3;
    }
    [[nodiscard]] Index in_surface(Index local) const { return 3 * faces_[local / 3] + local % 3; }

    // A vertex for each run of faces around each vertex.
    void number_corners() {
        corner_.assign(3 * faces_.size(), no_index);
        for (Index start = 0; start < corner_.size(); ++start) {
            ticker_.tick(2);
            if (corner_[start] != no_index) continue;
            const Index vertex =
                add_vertex(surface_.mesh.positions[surface_.tail(in_surface(start))]);
            for (Index h = start; h != no_index && corner_[h] == no_index;) {
                corner_[h] = vertex;
                h = in_patch(surface_.twin[Surface::previous(in_surface(h))]);
            }
            for (Index h = start; h != no_index;) {
                const Index across = in_patch(surface_.twin[in_surface(h)]);
                h = across == no_index ? no_index : Surface::next(across);
                if (h == no_index || corner_[h] != no_index) break;
                corner_[h] = vertex;
            }
        }
    }

    void place_points() {
        patch_.vertex.assign(points_.size(), no_index);
        inside_.resize(faces_.size());
        for (Index i = 0; i < points_.size(); ++i) {
            const auto found = local_.find(points_[i].face.value());
            if (found != local_.end()) place_point(i, found->second);
        }
        for (auto& [edge, on_edge] : on_edges_) place_on_edge(edge, on_edge);
    }

    void place_point(Index point, Index local_face) {
        const auto& b = points_[point].barycentric;
        for (Index k = 0; k < 3; ++k) {
            if (b[k] >= 1 - least_share) {
                patch_.vertex[point] = corner_[3 * local_face + k];
                return;
            }
        }
        for (Index k = 0; k < 3; ++k) {
            if (b[k] >= least_share) continue;
            const Index h = 3 * points_[point].face.value() + (k + 1) % 3;
            const double at = b[(k + 2) % 3] / (b[(k + 1) % 3] + b[(k + 2) % 3]);
            const Index edge = surface_.edge[h];
            on_edges_[edge].push_back({surface_.edge_half[edge] == h ? at : 1 - at, point});
            return;
        }
        inside_[local_face].push_back(point);
    }

    void place_on_edge(Index edge, std::vector<EdgePoint>& on_edge) {
        std::sort(on_edge.begin(), on_edge.end(), [](const EdgePoint& a, const EdgePoint& b) {
            return a.at < b.at || (a.at == b.at && a.point < b.point);
        });
        const Index h = surface_.edge_half[edge];
        const Vec3& a = surface_.mesh.positions[surface_.tail(h)];
        const Vec3& b = surface_.mesh.positions[surface_.head(h)];
        // Only one of the edge's two faces may be in the patch.
        const Index own = in_patch(h);
        const Index across = own == no_index ? in_patch(surface_.twin[h]) : no_index;
        const Index tail = own != no_index ? corner_[own] : corner_[Surface::next(across)];
        const Index head = own != no_index ? corner_[Surface::next(own)] : corner_[across];
        double last = 0;
        Index vertex = tail;
        std::vector<EdgePoint> distinct;
        for (const EdgePoint& point : on_edge) {
            if (point.at > 1 - least_share) {
                vertex = head;
            } else if (point.at - last > least_share) {
                vertex = add_vertex(a + point.at * (b - a));
                last = point.at;
                distinct.push_back(point);
            }
            patch_.vertex[point.point] = vertex;
        }
        on_edge = std::move(distinct);
    }

    // A vertex of the parts of one face.
    struct Corner {
        Index vertex;
        Vec3 barycentric;  // In the face.
    };
    using Part = std::array<Index, 3>;  // Into corners_of_face_.

    void append_face(Index local_face) {
        corners_of_face_.clear();
        for (Index k = 0; k < 3; ++k) {
            corners_of_face_.push_back({corner_[3 * local_face + k], Vec3::Unit(k)});
        }
        parts_.assign(1, {0, 1, 2});
        for (Index k = 0; k < 3; ++k) split_edge(3 * faces_[local_face] + k);
        for (const Index point : inside_[local_face]) place_inside(point);
        for (const Part& part : parts_) {
            patch_.mesh.triangles.push_back({corners_of_face_[part[0]].vertex,
                                             corners_of_face_[part[1]].vertex,
                                             corners_of_face_[part[2]].vertex});
        }
    }

    // Cuts off the points of one side, from its tail on.
    void split_edge(Index half_edge) {
        const Index edge = surface_.edge[half_edge];
        const auto found = on_edges_.find(edge);
        if (found == on_edges_.end()) return;
        const auto& on_edge = found->second;
        const bool is_first = surface_.edge_half[edge] == half_edge;
        const Index tail = half_edge % 3;
        const Index head = (tail + 1) % 3;
        Index last = tail;
        for (std::size_t i = 0; i < on_edge.size(); ++i) {
            const EdgePoint& point = on_edge[is_first ? i : on_edge.size() - 1 - i];
            const double at = is_first ? point.at : 1 - point.at;
            const auto added = static_cast<Index>(corners_of_face_.size());
            corners_of_face_.push_back(
                {patch_.vertex[point.point], (1 - at) * Vec3::Unit(tail) + at * Vec3::Unit(head)});
            split_side(part_with(last, head), last, head, added);
            last = added;
        }
    }

    // The part that holds the point falls into three, or on an edge both parts there into two.
    void place_inside(Index point) {
        const auto& b = points_[point].barycentric;
        const Vec3 at(b[0], b[1], b[2]);
        std::size_t best = 0;
        Vec3 share = Vec3::Constant(-1);
        for (std::size_t j = 0; j < parts_.size(); ++j) {
            const Vec3 here = share_of(parts_[j], at);
            if (here.minCoeff() <= share.minCoeff()) continue;
            best = j;
            share = here;
        }
        const Part part = parts_[best];
        for (std::size_t k = 0; k < 3; ++k) {
            if (share[static_cast<int>(k)] < 1 - least_share) continue;
            patch_.vertex[point] = corners_of_face_[part[k]].vertex;
            return;
        }
        Eigen::Index k = 0;
        share.minCoeff(&k);
        const auto apex = static_cast<std::size_t>(k);
        const Index from = part[(apex + 1) % 3], to = part[(apex + 2) % 3];
        const std::size_t beyond = share[k] < least_share ? part_with(to, from) : parts_.size();
        share[k] = beyond < parts_.size() ? 0 : std::max(share[k], least_share);
        const Index added = add_corner(part, share / share.sum());
        patch_.vertex[point] = corners_of_face_[added].vertex;
        if (beyond < parts_.size()) {
            split_side(best, from, to, added);
            split_side(beyond, to, from, added);
        } else {
            parts_[best][0] = added;
            parts_.push_back({part[0], added, part[2]});
            parts_.push_back({part[0], part[1], added});
        }
    }

    // The part that has this directed side; parts_.size() if there is none.
    [[nodiscard]] std::size_t part_with(Index from, Index to) const {
        std::size_t j = 0;
        while (j < parts_.size() && opposite(parts_[j], from, to) == no_index) ++j;
        return j;
    }

    // The third corner of a part that has this directed side, or no_index.
    [[nodiscard]] static Index opposite(const Part& part, Index from, Index to) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (part[k] == from && part[(k + 1) % 3] == to) return part[(k + 2) % 3];
        }
        return no_index;
    }

    void split_side(std::size_t j, Index from, Index to, Index added) {
        const Index apex = opposite(parts_[j], from, to);
        parts_[j] = {from, added, apex};
        parts_.push_back({added, to, apex});
    }

    // A new corner inside a part or on its side.
    Index add_corner(const Part& part, const Vec3& share) {
        Corner corner{no_index, Vec3::Zero()};
        Vec3 at = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            const Corner& from = corners_of_face_[part[k]];
            corner.barycentric += share[static_cast<int>(k)] * from.barycentric;
            at += share[static_cast<int>(k)] * patch_.mesh.positions[from.vertex];
        }
        corner.vertex = add_vertex(at);
        corners_of_face_.push_back(corner);
        return static_cast<Index>(corners_of_face_.size() - 1);
    }

    // Barycentric coordinates in a part of the face.
    [[nodiscard]] Vec3 share_of(const Part& part, const Vec3& at) const {
        const Vec3& a = corners_of_face_[part[0]].barycentric;
        const Vec3& b = corners_of_face_[part[1]].barycentric;
        const Vec3& c = corners_of_face_[part[2]].barycentric;
        const Vec3 shares(b.cross(c).dot(at), c.cross(a).dot(at), a.cross(b).dot(at));
        return shares / shares.sum();
    }

    Index add_vertex(const Vec3& p) {
        patch_.mesh.positions.push_back(p);
        return static_cast<Index>(patch_.mesh.positions.size() - 1);
    }

    const Surface& surface_;
    std::span<const SurfacePoint> points_;
    Ticker ticker_;
    Patch patch_;
    std::vector<Index> faces_;                // Of the patch, in the order they were found.
    std::unordered_map<Index, Index> local_;  // Place of a face in faces_.
    std::vector<Index> corner_;               // #faces_ x 3: vertex of the patch.
    std::vector<std::vector<Index>> inside_;  // Points inside each face.
    std::map<Index, std::vector<EdgePoint>> on_edges_;  // Points of each edge of the surface.
    std::vector<Corner> corners_of_face_;               // Of the face being cut up,
    std::vector<Part> parts_;                           // and what it falls into.
};

}  // namespace

Patch cut_patch(const Surface& surface, const SurfacePoint& center, double radius,
                std::span<const SurfacePoint> points, Ticker ticker) {
    return PatchCutter(surface, points, ticker).cut(center, radius);
}

}  // namespace agvd
