// A planar face is one piece. Those of other changed faces are the parts of the input's faces in
// it, mapped back through the record; if these are too many, evenly spread points.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "agvd/core/parallel.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd {
namespace {

constexpr Index most_pieces = 16;

// Evenly spread points of a triangle, the first at its centroid: a lattice whose steps are powers
// of the plastic number, folded into the triangle.
std::array<double, 3> spread_point(Index i) {
    constexpr double step_x = 0.7548776662466927, step_y = 0.5698402909980532;
    double x = 1.0 / 3 + i * step_x, y = 1.0 / 3 + i * step_y;
    x -= std::floor(x);
    y -= std::floor(y);
    if (x + y > 1) {
        x = 1 - x;
        y = 1 - y;
    }
    return {1 - x - y, x, y};
}

Vec3 area_vector(const Surface& surface, Index face) {
    return doubled_normal(surface.mesh.positions, surface.mesh.triangles[face]) / 2;
}

// Whether the sides of a face are straight in space. Then they lie on the surface, and the face is
// flat: no other surface between them is as small.
bool is_planar(const Surface& surface, Index face) {
    constexpr double rounding = 1e-9;  // Of a side.
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double length = surface.length_of(h);
        if (!(surface.length_in_space(h) > (1 - rounding) * length)) return false;
    }
    return true;
}

void add_samples(const IntrinsicTriangulation& base, Index face, double piece_area,
                 std::vector<SurfacePiece>& pieces) {
    const Surface& input = base.input();
    const double area = face_area(base.surface(), face);
    const auto count = static_cast<Index>(
        std::clamp(std::ceil(area / piece_area), 1.0, static_cast<double>(most_pieces)));
    for (Index i = 0; i < count; ++i) {
        const SurfacePoint point = base.to_input({FaceId(face), spread_point(i)});
        const Vec3 normal = area_vector(input, point.face.value()).normalized();
        pieces.push_back({position(input.mesh, point), area / count * normal});
    }
}

}  // namespace

SurfacePiece FacePieces::whole(const Surface& surface, Index face) {
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    return {(p[a] + p[b] + p[c]) / 3, area_vector(surface, face)};
}

FacePieces::FacePieces(const IntrinsicTriangulation& base, double piece_area, int num_threads,
                       const Progress& progress)
    : input_(base.input()), num_faces_(base.surface().num_faces()) {
    assert(piece_area > 0);
    constexpr Index grain = 1 << 12;        // Faces.
    constexpr std::size_t piece_work = 16;  // Ticks of a piece.
    Poller poller(progress);
    const Index num_faces = base.surface().num_faces();
    end_.assign(std::size_t{num_faces} + 1, 0);
    std::vector<std::vector<SurfacePiece>> chunks(num_chunks(num_faces, grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        Ticker ticker(poller);
        std::vector<SurfacePiece>& pieces = chunks[chunk];
        for (Index f = begin; f < end; ++f) {
            if (!base.is_changed(f)) continue;
            const std::size_t before = pieces.size();
            if (is_planar(base.surface(), f)) {
                pieces.push_back(whole(base.surface(), f));
            } else {
                for (const auto& [centroid, share] : base.parts_of(f)) {
                    pieces.push_back({position(input_.mesh, centroid),
                                      share * area_vector(input_, centroid.face.value())});
                }
                if (pieces.size() == before) add_samples(base, f, piece_area, pieces);
            }
            end_[f + 1] = static_cast<Index>(pieces.size() - before);
            ticker.tick(piece_work * (pieces.size() - before));
        }
    };
    parallel_chunks(num_faces, grain, num_threads, find, poller);
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    pieces_.reserve(end_.back());
    for (std::vector<SurfacePiece>& chunk : chunks) {
        poller.poll();
        pieces_.insert(pieces_.end(), chunk.begin(), chunk.end());
        chunk = {};
    }
    if (pieces_.empty()) end_ = {};
}

}  // namespace agvd
