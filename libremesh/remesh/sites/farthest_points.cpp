// Each component becomes a surface with long edges split, at whose vertices bounds of the distance
// are kept ([eldar1997], [moenning2003]).
#include <algorithm>
#include <functional>
#include <unordered_set>

#include "agvd/core/random.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/propagate.h"
#include "remesh/curves/walk.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/size_field.h"

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

Surface component_surface(const Surface& whole, const Component& component,
                          const Progress& progress) {
    Poller poller(progress);
    return surface_of_part(whole, component.faces, Ticker(poller));
}

// The local length at a point of the component's own surface.
std::function<double(const SurfacePoint&)> unit_on(std::span<const Index> faces,
                                                   const SizeField* sizes) {
    if (sizes == nullptr) return {};
    return [=](const SurfacePoint& point) {
        return sizes->at({FaceId(faces[point.face.value()]), point.barycentric});
    };
}

class FarthestPoints {
public:
    FarthestPoints(const Surface& whole, const Component& component, double max_length,
                   Index most_splits, std::uint64_t stream, const SamplingOptions& options)
        : whole_(whole),
          faces_(component.faces),
          options_(options),
          stream_(stream),
          input_(component_surface(whole, component, options.progress)),
          base_(input_, {.max_length = max_length,
                         .most_splits = most_splits,
                         .unit_at = unit_on(faces_, options.sizes),
                         .num_threads = options.num_threads,
                         .progress = options.progress}),
          layout_(base_.surface(), options.num_threads, options.progress),
          search_(base_.surface(), layout_, options.num_threads) {
        const auto unit_at = unit_on(faces_, options.sizes);
        for (Index v = 0; unit_at && v < base_.surface().num_vertices(); ++v) {
            unit_.push_back(
                unit_at(v < input_.num_vertices() ? point_at(input_, v) : base_.added_point(v)));
        }
    }

    // Adds a given point of the whole surface.
    void add(const SurfacePoint& point) { take(to_component(point), point); }

    std::vector<SurfacePoint> run(Index count) {
        std::vector<SurfacePoint> result;
        result.reserve(count);
        search_.run(options_.progress);
        Poller poller(options_.progress);
        Ticker ticker(poller);
        auto farthest = farthest_vertices(base_.surface(), {search_, unit_});
        for (std::uint64_t i = 0; result.size() < count && !farthest.is_empty(); ++i) {
            const Index v = farthest.pop();
            const SurfacePoint near = draw(v, i);
            const SurfacePoint point = to_whole(near);
            if (!take(near, point)) continue;  // No room beside another point.
            search_.run(options_.progress);
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
        const Surface& surface = base_.surface();
        const auto reach = [&](Index h) {
            return search_.distance(surface.head(h)) +
                   search_.distance(surface.tail(Surface::previous(h)));
        };
        Index best = surface.outgoing[vertex];
        for_each_outgoing(surface, vertex, [&](Index h) {
            if (reach(h) > reach(best)) best = h;
        });
        const auto offset = [&](std::uint64_t k) {
            return least_offset + (most_offset - least_offset) *
                                      random_unit(options_.seed, stream_, 2 * number + k);
        };
        const double ahead = offset(0), aside = offset(1);
        SurfacePoint point{FaceId(Surface::face(best)), {}};
        point.barycentric[best % 3] = 1 - ahead - aside;
        point.barycentric[Surface::next(best) % 3] = ahead;
        point.barycentric[Surface::previous(best) % 3] = aside;
        return point;
    }

    [[nodiscard]] SurfacePoint to_whole(const SurfacePoint& point) const {
        SurfacePoint found = base_.to_input(point);
        found.face = FaceId(faces_[found.face.value()]);
        keep_inside(found.barycentric);
        return found;
    }
    [[nodiscard]] SurfacePoint to_component(const SurfacePoint& point) const {
        const Index face = rank_of(faces_, point.face.value());
        return base_.to_intrinsic(SurfacePoint{FaceId(face), point.barycentric});
    }

    const Surface& whole_;
    std::span<const Index> faces_;  // Of the whole surface, ascending: by face of `input_`.
    const SamplingOptions& options_;
    std::uint64_t stream_;
    Surface input_;  // The component as a surface of its own.
    IntrinsicTriangulation base_;
    std::vector<double> unit_;  // #V of the base: local lengths, or empty.
    const SurfaceLayout layout_;
    BoundsSearch search_;
    std::unordered_set<Vec3, PositionHash> taken_;
    Index num_taken_ = 0;
};

}  // namespace

std::vector<SurfacePoint> farthest_points(const Surface& surface, const Component& component,
                                          std::span<const SurfacePoint> fixed, Index count,
                                          double spacing, std::uint64_t stream,
                                          const SamplingOptions& options) {
    if (count == 0) return {};
    const Index most_splits =
        splits_per_point * (count + 1) + static_cast<Index>(component.faces.size());
    FarthestPoints points(surface, component, longest_edge * spacing, most_splits, stream, options);
    for (const SurfacePoint& point : fixed) points.add(point);
    if (!fixed.empty()) return points.run(count);
    SamplingOptions quiet = options;
    quiet.progress = {};
    const SurfacePoint first = scatter(surface, component, 1, stream, quiet).front();
    points.add(first);
    std::vector<SurfacePoint> result = points.run(count - 1);
    result.insert(result.begin(), first);
    return result;
}

}  // namespace remesh::detail
