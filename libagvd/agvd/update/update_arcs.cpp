#include "agvd/update/update_arcs.h"

#include <algorithm>

#include "agvd/diagram/cuts.h"
#include "agvd/diagram/join.h"
#include "agvd/diagram/trace.h"

namespace agvd {
namespace {

bool holds_in_face(const TouchedParts& touched, const ArcStore& arcs, Index face) {
    return touched.holds_in_face(face, arcs.of_face(face).is_local);
}

void remove_stale_arcs(std::span<const Index> faces, DiagramParts& parts) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
        constexpr std::size_t ahead = 4;
        for (int step = 0; step < 3; ++step) {
            const std::size_t later = i + ahead * static_cast<std::size_t>(3 - step);
            if (later < faces.size()) parts.arcs.prefetch(faces[later], step);
        }
        remove_arcs(faces[i], parts);
    }
}

}  // namespace

std::vector<Index> update_arcs(const StageInput& input, const TouchedParts& touched,
                               DiagramParts& parts) {
    std::vector<Index> stale;
    for (const Index face : touched.faces()) {
        if (!holds_in_face(touched, parts.arcs, face)) stale.push_back(face);
    }
    remove_stale_arcs(stale, parts);
    std::erase_if(parts.labels.cut_faces, [&](const CutFace& cut) {
        if (!std::binary_search(stale.begin(), stale.end(), cut.face)) return false;
        remove_cut(cut, parts);
        return true;
    });
    const std::vector<Index> mixed = positions_of(parts.labels, stale);
    cut_faces(input, mixed, parts);
    input.poller.tell(0.5);
    trace_faces(input, mixed, parts);
    input.poller.tell(0.9);
    join_arcs(parts.labels, parts.arcs, faces_at(input.propagation, mixed), Ticker(input.poller),
              parts.joined);
    return stale;
}

void update_voronoi_vertices(const ArcStore& arcs, std::vector<Index> faces,
                             std::vector<FaceVoronoiVertices>& voronoi_vertices) {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    auto face = faces.begin();
    std::erase_if(voronoi_vertices, [&](const FaceVoronoiVertices& old) {
        face = std::lower_bound(face, faces.end(), old.face);
        return face != faces.end() && *face == old.face;
    });
    const auto num_old = static_cast<std::ptrdiff_t>(voronoi_vertices.size());
    const std::vector<FaceVoronoiVertices> added = list_voronoi_vertices(arcs, faces);
    voronoi_vertices.insert(voronoi_vertices.end(), added.begin(), added.end());
    std::inplace_merge(
        voronoi_vertices.begin(), voronoi_vertices.begin() + num_old, voronoi_vertices.end(),
        [](const FaceVoronoiVertices& a, const FaceVoronoiVertices& b) { return a.face < b.face; });
}

}  // namespace agvd
