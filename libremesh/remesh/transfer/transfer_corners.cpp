// From a point of its side each face looks for its corners along straight lines, in steps, on the
// input cut at its seams. What the faces around a vertex find is then compared: one place counts
// for all that are connected there.
#include "remesh/transfer/transfer_corners.h"

#include <algorithm>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "remesh/transfer/nearest_on_sheet.h"

namespace remesh {
namespace {

using detail::NearestOnSheet;

constexpr Index corner_grain = 64;
constexpr int steps_to_corner = 4;  // From a face's centroid to a corner.
// As a share of an edge of the result: places of a vertex are compared within a ball that is never
// smaller than this.
constexpr double least_radius = 1e-6;
// In distances of a vertex from its place: the radius of that ball.
constexpr double radius_factor = 2;

// Sums of the same value stay that value, bit for bit; a corner of weight 0 does not count.
Vec2 interpolated(const CornerCoordinates& values, const SurfacePoint& place) {
    const auto& b = place.barycentric;
    const auto k = static_cast<std::size_t>(std::max_element(b.begin(), b.end()) - b.begin());
    Vec2 value = values[k];
    for (const std::size_t i : {(k + 1) % 3, (k + 2) % 3}) {
        if (b[i] != 0 && values[i] != values[k]) value += b[i] * (values[i] - values[k]);
    }
    return value;
}

using FacePlaces = std::array<ClosestPoint, 3>;

class CornerFinder {
public:
    CornerFinder(const MeshView& result, std::span<const SurfacePoint> places,
                 const NearestOnSheet& sheet, const NearestOnSheet& cut)
        : result_(result), places_(places), sheet_(sheet), cut_(cut) {}

    // The places of a face's corners on its side of the seams.
    FacePlaces find(Index face, NearestOnSheet::Seen& seen) const {
        const Triangle& t = result_.triangles[face];
        FacePlaces best = find_from(home(t, seen), t, seen);
        if (are_nearest(best, t)) return best;
        for (const Index v : t) {
            const FacePlaces found = find_from(at(places_[v], result_.positions[v]), t, seen);
            if (offset(found) < offset(best)) best = found;
        }
        return best;
    }

    // Whether the places of two faces at their common vertex are on the same side of the seams.
    bool is_same(Index face, Index vertex, const ClosestPoint& a, const ClosestPoint& b,
                 NearestOnSheet::Seen& seen) const {
        if (a.point.face == b.point.face) return true;
        const Triangle& t = result_.triangles[face];
        const double size = (result_.positions[t[1]] - result_.positions[t[0]]).norm();
        const double radius = std::max(
            radius_factor * std::sqrt(std::max(a.distance_sq, b.distance_sq)), least_radius * size);
        return cut_.are_connected(result_.positions[vertex], radius, a.point.face.value(),
                                  b.point.face.value(), seen);
    }

    [[nodiscard]] ClosestPoint at(const SurfacePoint& place, const Vec3& point) const {
        const Vec3 found = position(sheet_.mesh(), place);
        return {place, found, (found - point).squaredNorm()};
    }

private:
    // Where the centroid lies.
    ClosestPoint home(const Triangle& t, NearestOnSheet::Seen& seen) const {
        const Vec3 center =
            (result_.positions[t[0]] + result_.positions[t[1]] + result_.positions[t[2]]) / 3;
        std::size_t first = 0;
        for (std::size_t k = 1; k < 3; ++k) {
            if (at(places_[t[k]], center).distance_sq < at(places_[t[first]], center).distance_sq)
                first = k;
        }
        return sheet_.query(center, places_[t[first]], seen);
    }

    FacePlaces find_from(const ClosestPoint& start, const Triangle& t,
                         NearestOnSheet::Seen& seen) const {
        FacePlaces found;
        for (std::size_t k = 0; k < 3; ++k) {
            found[k] = start;
            for (int step = 1; step <= steps_to_corner; ++step) {
                const Vec3& target = result_.positions[t[k]];
                const Vec3 point =
                    step == steps_to_corner
                        ? target
                        : Vec3(start.position + (target - start.position) * step / steps_to_corner);
                found[k] = cut_.query(point, found[k].point, seen);
            }
        }
        return found;
    }

    // Whether no corner is nearer to another side.
    [[nodiscard]] bool are_nearest(const FacePlaces& found, const Triangle& t) const {
        const double tolerance =
            least_radius * (result_.positions[t[1]] - result_.positions[t[0]]).norm();
        for (std::size_t k = 0; k < 3; ++k) {
            const double least = at(places_[t[k]], result_.positions[t[k]]).distance_sq;
            if (std::sqrt(found[k].distance_sq) > std::sqrt(least) + tolerance) return false;
        }
        return true;
    }
    static double offset(const FacePlaces& found) {
        return found[0].distance_sq + found[1].distance_sq + found[2].distance_sq;
    }

    const MeshView& result_;
    std::span<const SurfacePoint> places_;
    const NearestOnSheet &sheet_, &cut_;
};

void check(std::span<const SurfacePoint> places, const MeshView& result) {
    if (places.size() == result.positions.size()) return;
    throw InvalidOption("there are " + std::to_string(places.size()) + " places for " +
                        std::to_string(result.positions.size()) + " vertices; give one for each");
}

// A corner of the result: number 3 f + k.
std::vector<std::vector<Index>> corners_by_vertex(const MeshView& mesh) {
    std::vector<std::vector<Index>> corners(mesh.positions.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        for (Index k = 0; k < 3; ++k) corners[mesh.triangles[f][k]].push_back(3 * f + k);
    }
    return corners;
}

}  // namespace

std::vector<CornerCoordinates> transfer_corner_values(std::span<const CornerCoordinates> values,
                                                      const MeshView& input, const MeshView& result,
                                                      std::span<const SurfacePoint> places,
                                                      const CornerOptions& options) {
    check_num_threads(options.num_threads);
    check(places, result);
    Poller poller(options.progress);
    const auto num_faces = static_cast<Index>(result.triangles.size());
    std::vector<CornerCoordinates> carried(num_faces, no_coordinates());
    const auto value_at = [&](const SurfacePoint& place) {
        return interpolated(values[place.face.value()], place);
    };
    if (find_texture_seams(input, values, Ticker(poller)).empty()) {
        for (Index f = 0; f < num_faces; ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                carried[f][k] = value_at(places[result.triangles[f][k]]);
            }
        }
        return carried;
    }
    const CornerAgreement agree(values);
    const NearestOnSheet sheet(input, Ticker(poller)), cut = sheet.cut_at_seams(agree);
    const CornerFinder finder(result, places, sheet, cut);
    std::vector<FacePlaces> found(num_faces);
    parallel_chunks(
        num_faces, corner_grain, options.num_threads,
        [&](Index, Index begin, Index end) {
            NearestOnSheet::Seen seen;
            for (Index f = begin; f < end; ++f) found[f] = finder.find(f, seen);
        },
        poller);
    const std::vector<std::vector<Index>> corners = corners_by_vertex(result);
    parallel_chunks(
        static_cast<Index>(corners.size()), corner_grain, options.num_threads,
        [&](Index, Index begin, Index end) {
            NearestOnSheet::Seen seen;
            for (Index v = begin; v < end; ++v) {
                std::vector<ClosestPoint> sides{finder.at(places[v], result.positions[v])};
                for (const Index corner : corners[v]) {
                    const Index f = corner / 3;
                    const ClosestPoint& place = found[f][corner % 3];
                    const auto side = std::find_if(sides.begin(), sides.end(), [&](const auto& s) {
                        return finder.is_same(f, v, s, place, seen);
                    });
                    const ClosestPoint counted = side == sides.end() ? place : *side;
                    if (side == sides.end()) sides.push_back(place);
                    carried[f][corner % 3] = value_at(counted.point);
                }
            }
        },
        poller);
    return carried;
}

}  // namespace remesh
