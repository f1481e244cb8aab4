#include "agvd/diagram/build_parts.h"

#include "agvd/diagram/cuts.h"
#include "agvd/diagram/join.h"
#include "agvd/diagram/label_edges.h"
#include "agvd/diagram/label_vertices.h"
#include "agvd/diagram/trace.h"

namespace agvd {
namespace {

// Vertices, and the faces that lie in one cell.
void count_unlisted(const StageInput& input, DiagramParts& parts) {
    parts.tally.count_vertices(parts.labels.point_site);
    Ticker ticker(input.poller);
    for (Index f = 0; f < input.surface.num_faces(); ++f) {
        ticker.tick();
        if (parts.labels.mixed_index[f] != no_index) continue;
        const Index corner = input.surface.mesh.triangles[f][0];
        parts.tally.count_face(f, parts.labels.point_site[corner], 1);
    }
}

}  // namespace

DiagramParts build_parts(const StageInput& input) {
    DiagramParts parts(input.surface, static_cast<Index>(input.sites.size()));
    const std::vector<Index> mixed = all_mixed(input.propagation);
    list_mixed_faces(input.propagation, input.surface.num_faces(), parts.labels);
    label_vertices(input, parts.labels);
    count_unlisted(input, parts);
    label_edges(input, parts);
    cut_faces(input, mixed, parts);
    input.poller.tell(0.5);
    trace_faces(input, mixed, parts);
    input.poller.tell(0.9);
    join_arcs(parts.labels, parts.arcs, input.propagation.mixed_faces, Ticker(input.poller),
              parts.joined);
    return parts;
}

}  // namespace agvd
