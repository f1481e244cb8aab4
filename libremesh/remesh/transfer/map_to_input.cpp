#include "remesh/transfer/transfer.h"

#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"
#include "remesh/transfer/nearest_on_sheet.h"

namespace remesh {
namespace {

using detail::NearestOnSheet;

constexpr Index vertex_grain = 256, face_grain = 64;

// Barycentric coordinates of the centres of the parts that a triangle falls into when its sides are
// cut in four, row by row, to and fro: each is next to the one before.
std::array<std::array<double, 3>, 16> part_centers() {
    constexpr int n = 4;
    std::array<std::array<double, 3>, 16> centers{};
    std::size_t count = 0;
    for (int row = 0; row < n; ++row) {
        const int parts = 2 * (n - row) - 1;
        for (int i = 0; i < parts; ++i) {
            const int part = row % 2 == 0 ? i : parts - 1 - i;
            const double third = part % 2 == 0 ? 1.0 / 3 : 2.0 / 3;  // Upright, upside down.
            const int column = part / 2;
            const double v = (row + third) / n, u = (column + third) / n;
            centers[count++] = {1 - u - v, u, v};
        }
    }
    return centers;
}

using Centers = std::array<std::array<double, 3>, 16>;

// Starts each search at the nearest of the three corners and the place of the sample before.
FaceSamples sample_face(const MeshView& result, const Triangle& t,
                        std::span<const SurfacePoint> places, const Centers& centers,
                        const NearestOnSheet& nearest, NearestOnSheet::Seen& seen) {
    std::array<SurfacePoint, 4> starts{places[t[0]], places[t[1]], places[t[2]], places[t[0]]};
    std::array<Vec3, 4> at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = position(nearest.mesh(), starts[k]);
    FaceSamples faces{};
    for (std::size_t i = 0; i < faces.size(); ++i) {
        Vec3 point = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k) point += centers[i][k] * result.positions[t[k]];
        std::size_t first = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            if ((at[k] - point).squaredNorm() < (at[first] - point).squaredNorm()) first = k;
        }
        const ClosestPoint found = nearest.query(point, starts[first], seen);
        starts[3] = found.point;
        at[3] = found.position;
        faces[i] = found.point.face.value();
    }
    return faces;
}

}  // namespace

InputMap map_to_input(const MeshView& input, const MeshView& result,
                      std::span<const SurfacePoint> sites, const MapOptions& options) {
    check_num_threads(options.num_threads);
    if (sites.size() != result.positions.size()) {
        throw InvalidOption("there are " + std::to_string(sites.size()) + " sites for " +
                            std::to_string(result.positions.size()) +
                            " vertices; give one for each");
    }
    Poller poller(options.progress);
    const NearestOnSheet nearest(input, Ticker(poller));
    InputMap map;
    map.vertices.resize(sites.size());
    parallel_chunks(
        static_cast<Index>(sites.size()), vertex_grain, options.num_threads,
        [&](Index, Index begin, Index end) {
            NearestOnSheet::Seen seen;
            for (Index v = begin; v < end; ++v) {
                map.vertices[v] = nearest.query(result.positions[v], sites[v], seen).point;
            }
        },
        poller);
    if (!options.with_faces) return map;
    const Centers centers = part_centers();
    map.faces.resize(result.triangles.size());
    parallel_chunks(
        static_cast<Index>(map.faces.size()), face_grain, options.num_threads,
        [&](Index, Index begin, Index end) {
            NearestOnSheet::Seen seen;
            for (Index f = begin; f < end; ++f) {
                map.faces[f] =
                    sample_face(result, result.triangles[f], map.vertices, centers, nearest, seen);
            }
        },
        poller);
    return map;
}

}  // namespace remesh
