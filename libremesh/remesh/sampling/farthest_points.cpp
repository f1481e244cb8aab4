#include "remesh/sampling/farthest_points.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <unordered_set>
#include <utility>

#include "agvd/core/position_hash.h"
#include "agvd/core/random.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/refine.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/surface_layout.h"
#include "remesh/sampling/farthest_vertex.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

// Longest edge, in spacings: no point is then farther than a quarter of one from a vertex.
constexpr double longest_edge = 0.4;
// Slivers are longer than any spacing of points on them: all edges together are split into no more
// than so many pieces for each half-edge, and for each point.
constexpr double pieces_per_half_edge = 1, pieces_per_point = 16;
// How far a point lies from its vertex, in heights of the face: least and most.
constexpr double least_offset = 0.02, most_offset = 0.1;
// Steps of a search for the ground of one more point.
constexpr std::size_t search_work = 256;
// Least barycentric coordinate of a point in its face.
constexpr double interior_margin = 1e-6;

// A component on its own, around the origin, its long edges split.
struct Ground {
    Surface surface;
    Vec3 origin;                     // Where its (0, 0, 0) lies.
    std::vector<Index> face_origin;  // #F: the face of the whole surface. Ascending.
};

bool has_area(const agvd::TriangleMesh& mesh) {
    const auto& p = mesh.positions;
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
        return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() > 0;
    });
}

double longest_piece(const Surface& surface, const Component& component, Index count,
                     double spacing) {
    double length = 0;
    for (const Index f : component.faces) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) length += surface.length_of(h);
    }
    const double most_pieces =
        3 * pieces_per_half_edge * static_cast<double>(component.faces.size()) +
        pieces_per_point * count;
    return std::max(longest_edge * spacing, length / most_pieces);
}

Ground make_ground(const Surface& surface, const Component& component, double max_length,
                   const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    std::vector<Index> vertices;
    for (const Index f : component.faces) {
        const agvd::Triangle& t = surface.mesh.triangles[f];
        vertices.insert(vertices.end(), t.begin(), t.end());
    }
    agvd::sort_ticked(vertices, ticker, std::less<>());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    agvd::TriangleMesh mesh;
    const Vec3 origin = surface.mesh.positions[vertices.front()];
    mesh.positions.reserve(vertices.size());
    for (const Index v : vertices) mesh.positions.push_back(surface.mesh.positions[v] - origin);
    mesh.triangles.reserve(component.faces.size());
    for (const Index f : component.faces) {
        ticker.tick(4);
        agvd::Triangle& t = mesh.triangles.emplace_back(surface.mesh.triangles[f]);
        for (Index& v : t) {
            const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
            v = static_cast<Index>(found - vertices.begin());
        }
    }
    // Halves of slivers may vanish in rounding; then wholes must do.
    agvd::RefinedMesh refined = agvd::split_long_edges(mesh.view(), max_length, progress);
    if (!has_area(refined.mesh)) {
        return {agvd::build_surface(mesh.view(), progress), origin, component.faces};
    }
    for (Index& face : refined.face_origin) face = component.faces[face];
    return {agvd::build_surface(refined.mesh.view(), progress), origin,
            std::move(refined.face_origin)};
}

class FarthestPoints {
public:
    FarthestPoints(const Surface& whole, Ground ground, std::uint64_t seed, std::uint64_t stream,
                   int num_threads, const agvd::Progress& progress)
        : whole_(whole),
          ground_(std::move(ground)),
          progress_(progress),
          layout_(ground_.surface, num_threads, progress),
          search_(ground_.surface, layout_.arcs(), layout_.corners().mean_length(), num_threads),
          seed_(seed),
          stream_(stream) {}

    // A point of the whole surface that is given.
    void add(const SurfacePoint& point) { take(to_ground(point), point); }

    std::vector<SurfacePoint> run(Index count) {
        std::vector<SurfacePoint> result;
        result.reserve(count);
        search_.run(progress_);
        agvd::Poller poller(progress_);
        agvd::Ticker ticker(poller);
        FarthestVertex farthest(ground_.surface, search_);
        for (std::uint64_t i = 0; result.size() < count && !farthest.is_empty(); ++i) {
            const Index v = farthest.pop();
            const SurfacePoint near = draw(v, i);
            const SurfacePoint point = to_whole(near);
            if (!take(near, point)) continue;  // So near a point that there is no room for another.
            search_.run(progress_);
            ticker.tick(search_work);
            result.push_back(point);
            farthest.push(v);
        }
        return result;
    }

private:
    // False if there is a point at that position.
    bool take(const SurfacePoint& on_ground, const SurfacePoint& point) {
        if (!taken_.insert(agvd::position(whole_.mesh.view(), point)).second) return false;
        search_.add(on_ground, num_taken_++);
        return true;
    }

    // A random point next to a vertex, in the face around it that reaches farthest.
    [[nodiscard]] SurfacePoint draw(Index vertex, std::uint64_t number) const {
        const Surface& surface = ground_.surface;
        const auto reach = [&](Index h) {
            return search_.distance(surface.head(h)) +
                   search_.distance(surface.tail(Surface::previous(h)));
        };
        const Index first = surface.outgoing[vertex];
        Index best = first;
        for (Index h = surface.twin[Surface::previous(first)]; h != agvd::no_index && h != first;
             h = surface.twin[Surface::previous(h)]) {
            if (reach(h) > reach(best)) best = h;
        }
        const auto offset = [&](std::uint64_t k) {
            return least_offset +
                   (most_offset - least_offset) * agvd::random_unit(seed_, stream_, 2 * number + k);
        };
        const double ahead = offset(0), aside = offset(1);
        SurfacePoint point{agvd::FaceId(Surface::face(best)), {}};
        point.barycentric[best % 3] = 1 - ahead - aside;
        point.barycentric[Surface::next(best) % 3] = ahead;
        point.barycentric[Surface::previous(best) % 3] = aside;
        return point;
    }

    [[nodiscard]] SurfacePoint to_whole(const SurfacePoint& point) const {
        const agvd::FaceId face(ground_.face_origin[point.face.value()]);
        const Vec3 at = agvd::position(ground_.surface.mesh.view(), point) + ground_.origin;
        SurfacePoint found =
            agvd::closest_point_on_triangle(corners_of(whole_, face.value()), face, at).point;
        double sum = 0;
        for (double& b : found.barycentric) sum += b = std::max(b, interior_margin);
        for (double& b : found.barycentric) b /= sum;
        return found;
    }
    [[nodiscard]] SurfacePoint to_ground(const SurfacePoint& point) const {
        const Vec3 at = agvd::position(whole_.mesh.view(), point) - ground_.origin;
        const auto [first, last] = std::equal_range(ground_.face_origin.begin(),
                                                    ground_.face_origin.end(), point.face.value());
        agvd::ClosestPoint nearest;
        nearest.distance_sq = std::numeric_limits<double>::infinity();
        for (auto piece = first; piece != last; ++piece) {
            const agvd::FaceId face(static_cast<Index>(piece - ground_.face_origin.begin()));
            const agvd::ClosestPoint found = agvd::closest_point_on_triangle(
                corners_of(ground_.surface, face.value()), face, at);
            if (found.distance_sq < nearest.distance_sq) nearest = found;
        }
        return nearest.point;
    }
    static std::array<Vec3, 3> corners_of(const Surface& surface, Index face) {
        const agvd::Triangle& t = surface.mesh.triangles[face];
        const auto& p = surface.mesh.positions;
        return {p[t[0]], p[t[1]], p[t[2]]};
    }

    const Surface& whole_;
    const Ground ground_;
    const agvd::Progress& progress_;
    const agvd::SurfaceLayout layout_;
    agvd::BoundsSearch search_;
    std::uint64_t seed_, stream_;
    std::unordered_set<Vec3, agvd::PositionHash> taken_;
    Index num_taken_ = 0;
};

}  // namespace

std::vector<SurfacePoint> farthest_points(const Surface& surface, const Component& component,
                                          std::span<const SurfacePoint> fixed, Index count,
                                          double spacing, std::uint64_t seed, std::uint64_t stream,
                                          int num_threads, const agvd::Progress& progress) {
    if (count == 0) return {};
    const double max_length = longest_piece(surface, component, count, spacing);
    FarthestPoints points(surface, make_ground(surface, component, max_length, progress), seed,
                          stream, num_threads, progress);
    for (const SurfacePoint& point : fixed) points.add(point);
    if (!fixed.empty()) return points.run(count);
    const SurfacePoint first = scatter(surface, component, 1, seed, stream).front().point;
    points.add(first);
    std::vector<SurfacePoint> result = points.run(count - 1);
    result.insert(result.begin(), first);
    return result;
}

}  // namespace remesh::detail
