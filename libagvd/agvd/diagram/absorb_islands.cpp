#include "agvd/diagram/absorb_islands.h"

#include <algorithm>

#include "agvd/diagram/join.h"
#include "agvd/diagram/loops.h"
#include "agvd/diagram/trace.h"
#include "agvd/mesh/surface.h"

namespace agvd {
namespace {

void trace_again(const StageInput& input, std::span<const Index> faces, DiagramParts& parts) {
    for (const Index face : faces) remove_arcs(face, parts);
    trace_faces(input, positions_of(parts.labels, faces), parts);
    join_arcs(parts.labels, parts.arcs, faces, Ticker(input.poller), parts.joined);
}

}  // namespace

AbsorbedIslands absorb_islands(const StageInput& input, const CellSet& displaced,
                               const CellSet& in_doubt, DiagramParts& parts) {
    AbsorbedIslands absorbed{{}, {}, in_doubt};
    while (true) {
        input.poller.poll();
        CellSet asked = parts.tally.take_changed();
        asked.insert(absorbed.in_doubt);
        absorbed.in_doubt = cells_in_doubt(displaced, count_loops(input.surface, parts, asked));
        if (absorbed.in_doubt.is_empty()) return absorbed;
        const RelabelledIslands relabelled = relabel_islands(input, absorbed.in_doubt, parts);
        if (relabelled.faces.empty()) return absorbed;
        for (const OldLabel& old : relabelled.points) {
            recount_vertex(input.surface, old.point, old.site, parts);
        }
        trace_again(input, relabelled.faces, parts);
        absorbed.points.insert(absorbed.points.end(), relabelled.points.begin(),
                               relabelled.points.end());
        absorbed.faces.insert(absorbed.faces.end(), relabelled.faces.begin(),
                              relabelled.faces.end());
    }
}

void recount_vertex(const Surface& surface, Index vertex, Index old_site, DiagramParts& parts) {
    const Index site = parts.labels.point_site[vertex];
    parts.tally.count_vertex(vertex, old_site, -1);
    parts.tally.count_vertex(vertex, site, 1);
    for_each_outgoing(surface, vertex, [&](Index h) {
        const Index face = Surface::face(h);
        // An unlisted face has the label of its first corner.
        if (parts.labels.mixed_index[face] != no_index || h % 3 != 0) return;
        parts.tally.count_face(face, old_site, -1);
        parts.tally.count_face(face, site, 1);
    });
}

}  // namespace agvd
