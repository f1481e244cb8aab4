#include "remesh/pipeline/promises.h"

#include <algorithm>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/mesh/scale.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {
namespace {

struct Extremes {
    double min_angle, max_angle;  // Degrees.
    double longest_edge;          // Mesh units.
};

Extremes extremes_of(const std::array<Vec3, 3>& corners) {
    const FaceShape shape = measure_face(corners);
    const auto [least, most] = std::ranges::minmax(shape.angle);
    return {least / degree, most / degree, longest_edge_of(corners)};
}

bool exceeds_angles(const Extremes& face, const ShapeBounds& bounds) {
    return face.min_angle < bounds.min_angle || face.max_angle > bounds.max_angle;
}

// A bound and the triangle that exceeds it most.
struct Breach {
    Index face = no_index;
    double value = 0;

    void take(Index f, double exceeding, bool is_worse) {
        if (face != no_index && !is_worse) return;
        face = f;
        value = exceeding;
    }
};

[[noreturn]] void refuse(const std::string& asked, const Breach& breach, const TriangleMesh& mesh,
                         const std::string& remedy) {
    const auto [a, b, c] = corners_of(mesh.view(), breach.face);
    throw ConstraintUnmet(asked + ", and " + number_text(breach.value, 6) + " was reached with " +
                          std::to_string(mesh.positions.size()) + " vertices, near " +
                          place_text((a + b + c) / 3, box_of(mesh.view()).longest_side()) + "; " +
                          remedy);
}

}  // namespace

std::vector<ForcedFace> find_forced_faces(const CurvedSurface& curved, const PlacedMesh& mesh,
                                          const ShapeBounds& bounds) {
    std::vector<ForcedFace> forced;
    if (!bounds.has_angles()) return forced;
    const MeshCurves curves = curved.curves();
    const std::vector<Mobility> mobility = find_mobility(curved, curves, mesh);
    const TriangleMesh whole = whole_mesh(*curved.whole, mesh);
    std::vector<DirectedEdge> hard = mesh.hard;
    std::ranges::sort(hard);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        const std::array<Vec3, 3> corners = corners_of(whole.view(), f);
        const Extremes extremes = extremes_of(corners);
        if (!exceeds_angles(extremes, bounds)) continue;
        const auto is_free = [&](Index v) { return mobility[v] == Mobility::Free; };
        if (std::ranges::any_of(t, is_free)) continue;
        const auto length = [&](Index k) { return (corners[(k + 1) % 3] - corners[k]).norm(); };
        const Index k = std::ranges::min(std::array<Index, 3>{0, 1, 2}, {}, length);
        const Index a = t[k], b = t[(k + 1) % 3];
        // Vertices along a curve could be farther apart.
        const bool may_slide =
            mobility[a] == Mobility::Boundary || mobility[b] == Mobility::Boundary;
        if (may_slide && has_edge(hard, a, b)) continue;
        forced.push_back({f, extremes.min_angle, extremes.max_angle});
    }
    return forced;
}

void require_bounds(const RemeshResult& result, const ShapeBounds& bounds) {
    if (!bounds.has_any()) return;
    Breach narrow, wide, is_long;
    for (Index f = 0, next = 0; f < result.mesh.triangles.size(); ++f) {
        const Extremes face = extremes_of(corners_of(result.mesh.view(), f));
        if (face.longest_edge > bounds.longest_edge) {
            is_long.take(f, face.longest_edge, face.longest_edge > is_long.value);
        }
        if (next < result.forced.size() && result.forced[next].face == f) {
            ++next;
            continue;
        }
        if (face.min_angle < bounds.min_angle) {
            narrow.take(f, face.min_angle, face.min_angle < narrow.value);
        }
        if (face.max_angle > bounds.max_angle) {
            wide.take(f, face.max_angle, face.max_angle > wide.value);
        }
    }
    const std::string remedy = "use more samples, another seed, or fewer features";
    if (narrow.face != no_index) {
        refuse("the smallest angle asked for is " + number_text(bounds.min_angle), narrow,
               result.mesh, remedy + ", or allow a smaller angle");
    }
    if (wide.face != no_index) {
        refuse("the largest angle asked for is " + number_text(bounds.max_angle), wide, result.mesh,
               remedy + ", or allow a larger angle");
    }
    if (is_long.face != no_index) {
        refuse("the longest edge asked for is " + number_text(bounds.longest_edge), is_long,
               result.mesh, "lock no longer edges, or allow longer ones");
    }
}

}  // namespace remesh::detail
