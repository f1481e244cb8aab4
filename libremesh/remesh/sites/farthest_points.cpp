// Each component becomes a surface of its own, with long edges split. Upper bounds of the distance
// from the points are kept at its vertices (BoundsSearch). Each step takes the farthest
// vertex, draws a random point next to it and updates the bounds ([eldar1997], [moenning2003]).
#include "remesh/sites/farthest_points.h"

#include <algorithm>
#include <functional>
#include <unordered_set>

#include "agvd/core/random.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/surface_layout.h"
#include "remesh/sites/farthest_vertex.h"
#include "remesh/sites/scatter.h"

namespace remesh::detail {
namespace {

// Longest edge, in spacings: distances are known at vertices only. With .4 the points are less even
// than random ones where faces differ in size.
constexpr double longest_edge = 0.25;
// Most splits for each point; one for each face is added. Without a limit thin surfaces would get
// splits in proportion to their length.
constexpr Index splits_per_point = 128;
// Least and most distance of a point from its vertex, in heights of the face.
constexpr double least_offset = 0.02, most_offset = 0.1;

Surface component_surface(const Surface& whole, const Component& component, int num_threads,
                          const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> vertices;
    for (const Index f : component.faces) {
        const Triangle& t = whole.mesh.triangles[f];
        vertices.insert(vertices.end(), t.begin(), t.end());
    }
    sort_ticked(vertices, ticker, std::less<>());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    TriangleMesh mesh;
    mesh.positions.reserve(vertices.size());
    for (const Index v : vertices) mesh.positions.push_back(whole.mesh.positions[v]);
    mesh.triangles.reserve(component.faces.size());
    for (const Index f : component.faces) {
        ticker.tick(4);
        Triangle& t = mesh.triangles.emplace_back(whole.mesh.triangles[f]);
        for (Index& v : t) {
            const auto found = std::lower_bound(vertices.begin(), vertices.end(), v);
            v = static_cast<Index>(found - vertices.begin());
        }
    }
    return build_surface(mesh.view(), num_threads, progress);
}

// A component as a surface of its own.
struct RefinedComponent {
    RefinedComponent(const Surface& whole, const Component& component, double max_length,
                     Index most_splits, const SizeField* sizes, int num_threads,
                     const Progress& progress)
        : faces(component.faces),
          input(component_surface(whole, component, num_threads, progress)),
          base(input, {.max_length = max_length,
                       .most_splits = most_splits,
                       .unit_at = unit_of(sizes),
                       .num_threads = num_threads,
                       .progress = progress}) {
        if (sizes == nullptr) return;
        const IntrinsicOptions options{.unit_at = unit_of(sizes)};
        for (Index v = 0; v < surface().num_vertices(); ++v) {
            unit.push_back(options.unit_at(v < input.num_vertices() ? point_at(input, v)
                                                                    : base.place_of_added(v)));
        }
    }
    RefinedComponent(const RefinedComponent&) = delete;

    std::span<const Index> faces;  // Ascending: faces of the whole surface, by face of `input`.
    Surface input;
    IntrinsicTriangulation base;

    std::vector<double> unit;  // #V of the base: local lengths, or empty.

    [[nodiscard]] const Surface& surface() const { return base.surface(); }

private:
    // The local length at a point of `input`.
    [[nodiscard]] std::function<double(const SurfacePoint&)> unit_of(const SizeField* sizes) const {
        if (sizes == nullptr) return {};
        return [this, sizes](const SurfacePoint& point) {
            return sizes->at({FaceId(faces[point.face.value()]), point.barycentric});
        };
    }
};

class FarthestPoints {
public:
    FarthestPoints(const Surface& whole, const RefinedComponent& component, std::uint64_t seed,
                   std::uint64_t stream, int num_threads, const Progress& progress)
        : whole_(whole),
          component_(component),
          progress_(progress),
          layout_(component_.surface(), num_threads, progress),
          search_(component_.surface(), layout_, num_threads),
          seed_(seed),
          stream_(stream) {}

    // Adds a given point of the whole surface.
    void add(const SurfacePoint& point) { take(to_component(point), point); }

    std::vector<SurfacePoint> run(Index count) {
        std::vector<SurfacePoint> result;
        result.reserve(count);
        search_.run(progress_);
        Poller poller(progress_);
        Ticker ticker(poller);
        FarthestVertex farthest(component_.surface(), search_, component_.unit);
        for (std::uint64_t i = 0; result.size() < count && !farthest.is_empty(); ++i) {
            const Index v = farthest.pop();
            const SurfacePoint near = draw(v, i);
            const SurfacePoint point = to_whole(near);
            if (!take(near, point)) continue;  // No room beside another point.
            search_.run(progress_);
            ticker.tick(search_work);
            result.push_back(point);
            farthest.push(v);
        }
        return result;
    }

private:
    // Returns false if there is a point at that position.
    bool take(const SurfacePoint& on_ground, const SurfacePoint& point) {
        if (!taken_.insert(position(whole_.mesh.view(), point)).second) return false;
        search_.add(on_ground, num_taken_++);
        return true;
    }

    // A random point next to a vertex, in the face around it whose other corners are farthest.
    [[nodiscard]] SurfacePoint draw(Index vertex, std::uint64_t number) const {
        const Surface& surface = component_.surface();
        const auto reach = [&](Index h) {
            return search_.distance(surface.head(h)) +
                   search_.distance(surface.tail(Surface::previous(h)));
        };
        const Index first = surface.outgoing[vertex];
        Index best = first;
        for (Index h = surface.twin[Surface::previous(first)]; h != no_index && h != first;
             h = surface.twin[Surface::previous(h)]) {
            if (reach(h) > reach(best)) best = h;
        }
        const auto offset = [&](std::uint64_t k) {
            return least_offset +
                   (most_offset - least_offset) * random_unit(seed_, stream_, 2 * number + k);
        };
        const double ahead = offset(0), aside = offset(1);
        SurfacePoint point{FaceId(Surface::face(best)), {}};
        point.barycentric[best % 3] = 1 - ahead - aside;
        point.barycentric[Surface::next(best) % 3] = ahead;
        point.barycentric[Surface::previous(best) % 3] = aside;
        return point;
    }

    [[nodiscard]] SurfacePoint to_whole(const SurfacePoint& point) const {
        SurfacePoint found = component_.base.to_input(point);
        found.face = FaceId(component_.faces[found.face.value()]);
        keep_inside(found.barycentric);
        return found;
    }
    [[nodiscard]] SurfacePoint to_component(const SurfacePoint& point) const {
        const auto found =
            std::lower_bound(component_.faces.begin(), component_.faces.end(), point.face.value());
        const auto face = static_cast<Index>(found - component_.faces.begin());
        return component_.base.to_intrinsic(SurfacePoint{FaceId(face), point.barycentric});
    }

    const Surface& whole_;
    const RefinedComponent& component_;
    const Progress& progress_;
    const SurfaceLayout layout_;
    BoundsSearch search_;
    std::uint64_t seed_, stream_;
    std::unordered_set<Vec3, PositionHash> taken_;
    Index num_taken_ = 0;
};

}  // namespace

std::vector<SurfacePoint> farthest_points(const Surface& surface, const Component& component,
                                          std::span<const SurfacePoint> fixed, Index count,
                                          double spacing, std::uint64_t seed, std::uint64_t stream,
                                          int num_threads, const Progress& progress,
                                          const SizeField* sizes) {
    if (count == 0) return {};
    const Index most_splits =
        splits_per_point * (count + 1) + static_cast<Index>(component.faces.size());
    const RefinedComponent refined(surface, component, longest_edge * spacing, most_splits, sizes,
                                   num_threads, progress);
    FarthestPoints points(surface, refined, seed, stream, num_threads, progress);
    for (const SurfacePoint& point : fixed) points.add(point);
    if (!fixed.empty()) return points.run(count);
    const SurfacePoint first =
        scatter(surface, component, 1, seed, stream, {}, sizes).front().point;
    points.add(first);
    std::vector<SurfacePoint> result = points.run(count - 1);
    result.insert(result.begin(), first);
    return result;
}

}  // namespace remesh::detail
