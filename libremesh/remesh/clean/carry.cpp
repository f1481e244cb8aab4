// Bit for bit where the face kept its corners, otherwise to the closest point, on pieces of the
// same face first. Edges are carried by their middles.
#include "remesh/clean/carry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/groups.h"
#include "agvd/core/number_text.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

// As a share of the diagonal: a site farther from the mesh lies where cleaning left no surface.
// Positions are accurate to 1e-16 of the largest coordinate.
constexpr double tolerance_share = 1e-9;

// Divides coordinates by their sum. If this is 1 up to rounding, they stay, bit for bit.
SurfacePoint normalized(SurfacePoint point) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const double sum = point.barycentric[0] + point.barycentric[1] + point.barycentric[2];
    if (std::abs(sum - 1) > rounding) {
        for (double& coordinate : point.barycentric) coordinate /= sum;
    }
    return point;
}

// The same point of `to`, if both faces have the same three corner positions. Cleaning may renumber
// and reorder corners, and may split the face.
std::optional<SurfacePoint> carry_exactly(const SurfacePoint& point,
                                          const std::array<Vec3, 3>& from,
                                          const std::array<Vec3, 3>& to, Index to_face) {
    SurfacePoint carried{FaceId(to_face), {0, 0, 0}};
    std::array<bool, 3> is_taken{};
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t k = 0;
        while (k < 3 && (is_taken[k] || from[i] != to[k])) ++k;
        if (k == 3) return std::nullopt;
        is_taken[k] = true;
        carried.barycentric[k] = point.barycentric[i];
    }
    return carried;
}

// Carries points from one mesh to the other.
class Carrier {
public:
    // \param cleaned  the one of the two meshes that was cleaned.
    Carrier(const MeshView& from, const MeshView& to, const MeshView& cleaned)
        : from_(from), to_(to) {
        const MeshBox box = box_of(cleaned);
        reach_sq_ = tolerance_share * tolerance_share * (box.high - box.low).squaredNorm();
    }

    // Tries the given faces first: another part of the mesh may lie at the same position. The point
    // is out of reach where cleaning left no surface or flipped edges.
    [[nodiscard]] ClosestPoint carry(const SurfacePoint& point, std::span<const Index> faces) {
        const std::array<Vec3, 3> corners = corners_of(from_, point.face.value());
        const Vec3 query = position(from_, point);
        ClosestPoint nearest;
        nearest.distance_sq = infinity;
        for (const Index face : faces) {
            const std::array<Vec3, 3> there = corners_of(to_, face);
            if (const auto same = carry_exactly(point, corners, there, face)) {
                return {*same, query, 0};
            }
            const ClosestPoint found = closest_point_on_triangle(there, FaceId(face), query);
            if (found.distance_sq < nearest.distance_sq) nearest = found;
        }
        if (!is_in_reach(nearest)) {
            if (!tree_) tree_.emplace(to_);
            nearest = tree_->query(query);
        }
        return nearest;
    }

    [[nodiscard]] bool is_in_reach(const ClosestPoint& point) const {
        return !(point.distance_sq > reach_sq_);
    }

private:
    MeshView from_, to_;
    double reach_sq_;
    std::optional<ClosestPointTree> tree_;  // Few meshes need it.
};

void check_site(const SurfacePoint& site, std::size_t number, Index num_faces) {
    const std::string name = "site " + std::to_string(number);
    if (!site.face.is_valid() || site.face.value() >= num_faces) {
        throw InvalidSites(name + " names a face that does not exist; use one of the " +
                           std::to_string(num_faces) + " faces, counted from 0");
    }
    const auto& [a, b, c] = site.barycentric;
    // The accuracy of decimals in a file and of sums in double.
    constexpr double tolerance = 1e-6;
    if (!(a >= 0 && b >= 0 && c >= 0 && std::abs(a + b + c - 1) <= tolerance)) {
        throw InvalidSites(name + " on face " + std::to_string(site.face.value()) +
                           " has barycentric coordinates that are negative or do not sum "
                           "to 1; correct them");
    }
}

// A face of an edge, the edge's middle as a point of this face, and its place among all middles.
struct EdgeMiddle {
    double area = -1;
    SurfacePoint middle;
    Index place = no_index;
};

}  // namespace

std::vector<SurfacePoint> to_cleaned(const std::vector<SurfacePoint>& sites, const MeshView& mesh,
                                     const CleanedView& clean) {
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    const Groups pieces(num_faces, [&](const auto& add) {
        for (Index f = 0; f < clean.face_origin.size(); ++f) add(clean.face_origin[f], f);
    });
    Carrier carrier(clean.welded(mesh), clean.mesh, clean.mesh);
    std::vector<SurfacePoint> carried;
    carried.reserve(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        check_site(sites[i], i, num_faces);
        const Index face = sites[i].face.value();
        const ClosestPoint found = carrier.carry(normalized(sites[i]), pieces.of(face));
        if (!carrier.is_in_reach(found)) {
            throw InvalidSites("site " + std::to_string(i) + " lies on face " +
                               std::to_string(face) +
                               ", which cleaning dropped as degenerate or duplicate; "
                               "place it on another face");
        }
        carried.push_back(found.point);
    }
    return carried;
}

std::vector<SurfacePoint> to_original(const std::vector<SurfacePoint>& sites, const MeshView& mesh,
                                      const CleanedView& clean) {
    std::vector<SurfacePoint> carried;
    carried.reserve(sites.size());
    if (clean.face_origin.empty() || mesh.triangles.empty()) {
        for (const SurfacePoint& site : sites) {
            carried.push_back(normalized(site));
            if (clean.face_origin.empty()) continue;
            carried.back().face = FaceId(clean.face_origin[site.face.value()]);
        }
        return carried;
    }
    Carrier carrier(clean.mesh, clean.welded(mesh), clean.mesh);
    for (const SurfacePoint& site : sites) {
        const Index origin = clean.face_origin[site.face.value()];
        carried.push_back(carrier.carry(normalized(site), std::span(&origin, 1)).point);
    }
    return carried;
}

namespace {

// The edge of the surface that each given one has become; no_index for those whose faces were split
// elsewhere or dropped.
std::vector<Index> carried_edges(std::span<const std::array<Index, 2>> edges, const MeshView& mesh,
                                 const CleanedView& clean, const Surface& surface) {
    std::map<std::pair<Index, Index>, EdgeMiddle> middle_of;
    for (const auto& [u, v] : edges) middle_of[std::minmax(u, v)];
    // Of the faces at an edge the largest counts, and of equal ones the first: cleaning removes
    // faces without area, and of duplicate faces all but the first.
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        for (Index k = 0; k < 3; ++k) {
            const auto found = middle_of.find(std::minmax(t[k], t[(k + 1) % 3]));
            if (found == middle_of.end()) continue;
            const double area = doubled_normal(mesh.positions, t).norm();
            if (!(area > found->second.area)) continue;
            found->second.area = area;
            found->second.middle = point_on(3 * f + k, 0.5);
        }
    }
    std::vector<SurfacePoint> middles;
    for (auto& [ends, face] : middle_of) {
        if (face.area < 0) {
            throw InvalidInput("the edge between vertices " + index_text(ends.first) + " and " +
                               index_text(ends.second) +
                               " is not an edge of the mesh; name the two ends of an edge, "
                               "counted from 0");
        }
        if (!(face.area > 0)) continue;
        face.place = static_cast<Index>(middles.size());
        middles.push_back(face.middle);
    }
    if (!clean.face_origin.empty()) middles = to_cleaned(middles, mesh, clean);
    std::vector<Index> carried;
    carried.reserve(edges.size());
    for (const auto& [u, v] : edges) {
        const Index place = middle_of.at(std::minmax(u, v)).place;
        const auto half_edge =
            place != no_index ? half_edge_of(middles[place]) : std::optional<Index>();
        carried.push_back(half_edge ? surface.edge[*half_edge] : no_index);
    }
    return carried;
}

}  // namespace

std::vector<std::uint8_t> carry_edges(std::span<const std::array<Index, 2>> edges,
                                      const MeshView& mesh, const CleanedView& clean,
                                      const Surface& surface) {
    std::vector<std::uint8_t> is_carried(surface.num_edges(), 0);
    for (const Index edge : carried_edges(edges, mesh, clean, surface)) {
        if (edge != no_index) is_carried[edge] = 1;
    }
    return is_carried;
}

std::vector<SiteShape> carry_shapes(std::span<const ShapeView> shapes, const MeshView& mesh,
                                    const CleanedView& clean, const Surface& surface) {
    std::vector<std::array<Index, 2>> edges;
    bool has_faces = false;
    for (const ShapeView& shape : shapes) {
        edges.insert(edges.end(), shape.edges.begin(), shape.edges.end());
        has_faces = has_faces || !shape.faces.empty();
    }
    std::vector<Index> carried;
    if (!edges.empty()) carried = carried_edges(edges, mesh, clean, surface);
    if (std::find(carried.begin(), carried.end(), no_index) != carried.end()) {
        throw InvalidSites(
            "cleaning split or dropped an edge of a line of the sites; draw the line on the "
            "cleaned mesh");
    }
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    const Groups pieces(has_faces ? num_faces : 0, [&](const auto& add) {
        for (Index f = 0; has_faces && f < surface.num_faces(); ++f) {
            add(clean.face_origin.empty() ? f : clean.face_origin[f], f);
        }
    });
    std::vector<SiteShape> result;
    auto next = carried.begin();
    for (const ShapeView& shape : shapes) {
        SiteShape& on_surface = result.emplace_back();
        const auto end = next + static_cast<std::ptrdiff_t>(shape.edges.size());
        on_surface.edges = distinct(std::vector<Index>(next, end));
        next = end;
        for (const Index face : shape.faces) {
            if (face >= num_faces) {
                throw InvalidSites("a region of the sites names face " + index_text(face) +
                                   ", but the mesh has only " + std::to_string(num_faces) +
                                   " faces, counted from 0; correct it");
            }
            const auto own = pieces.of(face);
            on_surface.faces.insert(on_surface.faces.end(), own.begin(), own.end());
        }
        on_surface.faces = distinct(std::move(on_surface.faces));
        if (on_surface.faces.empty() && !shape.faces.empty()) {
            throw InvalidSites("cleaning dropped all faces of the region with face " +
                               std::to_string(shape.faces[0]) + "; use others");
        }
    }
    return result;
}

std::vector<std::uint8_t> find_label_borders(std::span<const Index> face_labels,
                                             std::span<const Index> face_origin,
                                             const Surface& surface) {
    const auto label = [&](Index h) { return face_labels[face_origin[Surface::face(h)]]; };
    std::vector<std::uint8_t> is_border(surface.num_edges(), 0);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        if (twin != no_index && label(h) != label(twin)) is_border[e] = 1;
    }
    return is_border;
}

}  // namespace remesh
