// Describes each face of the base by pieces with a point and an area vector in space. The pieces
// of a changed face are the parts of the input's faces in it, mapped back through the record; if
// these are too many, evenly spread points are mapped instead. Faces that are planar in space need
// one piece. Chunks of faces are processed in parallel and joined in order.
#include "agvd/intrinsic/face_pieces.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "agvd/core/parallel.h"
#include "agvd/mesh/face_area.h"

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
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    return (p[b] - p[a]).cross(p[c] - p[a]) / 2;
}

// Whether the sides of a face are straight in space. Then they lie on the surface, and the face is
// flat: no other surface between them is as small.
bool is_planar(const Surface& surface, Index face) {
    constexpr double rounding = 1e-9;  // Of a side.
    const auto& p = surface.mesh.positions;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double length = surface.length_of(h);
        const double in_space = (p[surface.head(h)] - p[surface.tail(h)]).norm();
        if (!(in_space > (1 - rounding) * length)) return false;
    }
    return true;
}

// The pieces of one chunk of faces.
struct Pieces {
    std::vector<Index> end;  // By changed face.
    std::vector<SurfacePiece> pieces;
};

SurfacePiece whole_face(const Surface& surface, Index face) {
    const auto& [a, b, c] = surface.mesh.triangles[face];
    const auto& p = surface.mesh.positions;
    return {(p[a] + p[b] + p[c]) / 3, area_vector(surface, face)};
}

void add_parts(const Surface& input, std::span<const InputPart> parts,
               std::vector<SurfacePiece>& pieces) {
    for (const InputPart& part : parts) {
        pieces.push_back({agvd::position(input.mesh.view(), part.centroid),
                          part.share * area_vector(input, part.centroid.face.value())});
    }
}

void add_samples(const IntrinsicTriangulation& base, Index face, double piece_area,
                 std::vector<SurfacePiece>& pieces) {
    const Surface& input = base.input();
    const double area = face_area(base.surface(), face);
    const auto count = static_cast<Index>(
        std::clamp(std::ceil(area / piece_area), 1.0, static_cast<double>(most_pieces)));
    for (Index i = 0; i < count; ++i) {
        const SurfacePoint place = base.to_input({FaceId(face), spread_point(i)});
        const Vec3 normal = area_vector(input, place.face.value()).normalized();
        pieces.push_back({agvd::position(input.mesh.view(), place), area / count * normal});
    }
}

// \param parts  serves again for the next face.
void add_pieces(const IntrinsicTriangulation& base, Index face, double piece_area,
                std::vector<InputPart>& parts, std::vector<SurfacePiece>& pieces) {
    parts.clear();
    if (is_planar(base.surface(), face)) {
        pieces.push_back(whole_face(base.surface(), face));
    } else if (base.parts_of(face, parts) && !parts.empty()) {
        add_parts(base.input(), parts, pieces);
    } else {
        add_samples(base, face, piece_area, pieces);
    }
}

}  // namespace

FacePieces::FacePieces(const IntrinsicTriangulation& base, double piece_area, int num_threads,
                       const Progress& progress)
    : input_(base.input()), num_faces_(base.surface().num_faces()) {
    assert(piece_area > 0);
    constexpr Index grain = 1 << 12;        // Faces.
    constexpr std::size_t piece_work = 16;  // Ticks of a piece.
    Poller poller(progress);
    const Index num_faces = base.surface().num_faces();
    std::vector<Pieces> chunks(num_chunks(num_faces, grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        Ticker ticker(poller);
        auto& [ends, pieces] = chunks[chunk];
        std::vector<InputPart> parts;
        for (Index f = begin; f < end; ++f) {
            if (!base.is_changed(f)) continue;
            const std::size_t before = pieces.size();
            add_pieces(base, f, piece_area, parts, pieces);
            ends.push_back(static_cast<Index>(pieces.size()));
            ticker.tick(piece_work * (pieces.size() - before));
        }
    };
    parallel_chunks(num_faces, grain, num_threads, find, poller);
    std::size_t num_pieces = 0;
    for (const Pieces& chunk : chunks) num_pieces += chunk.pieces.size();
    if (num_pieces == 0) return;
    begin_.assign(num_faces, no_index);
    pieces_.reserve(num_pieces);
    is_last_.assign(num_pieces, 0);
    for (Index chunk = 0; chunk < chunks.size(); ++chunk) {
        poller.poll();
        const auto first = static_cast<Index>(pieces_.size());
        Index face = chunk * grain, begin = first;
        for (const Index end : chunks[chunk].end) {
            while (!base.is_changed(face)) ++face;
            begin_[face++] = begin;
            begin = first + end;
            is_last_[begin - 1] = 1;
        }
        pieces_.insert(pieces_.end(), chunks[chunk].pieces.begin(), chunks[chunk].pieces.end());
        chunks[chunk] = {};
    }
}

SurfacePiece FacePieces::whole(const Surface& surface, Index face) {
    return whole_face(surface, face);
}

}  // namespace agvd
