#include "agvd/propagation/window/reach_vertex.h"

#include "agvd/propagation/window/window_rays.h"

namespace agvd {
namespace {

// Arrivals within each other's error may each make a vertex a pseudo-source, and send each other
// back and forth between vertices that lie closer than the error. After so many pseudo-sources the
// whole fan of the vertex is emitted, which holds what any further one would emit.
constexpr Index max_pseudo_sources = 32;

}  // namespace

void reach_vertex(FrontState& front, Index record, const Arrival& arrival) {
    const double distance = arrival.distance;
    front.vertices.lower_bound(record, distance + arrival.error);
    VertexRecord& v = front.vertices.records[record];
    const bool is_nearest = distance < v.low;
    if (is_nearest) v.low = distance;
    if (front.input.surface.can_be_pseudo_source[v.vertex] == 0) return;
    if (!(distance <= v.bound * (1 + grazing))) return;
    // Of exact arrivals the nearest tells where the shadow lies; of others any may.
    if (!is_nearest && (front.input.max_error == 0 || distance == v.last_arrival)) return;
    v.last_arrival = distance;
    Index half_edge = arrival.half_edge;
    if (++v.num_pseudo_sources > max_pseudo_sources) {
        if (v.num_pseudo_sources > max_pseudo_sources + 1 && !is_nearest) return;
        half_edge = no_index;
    }
    const Index source = front.pseudo_sources.add(
        {record, half_edge, arrival.direction.x(), arrival.direction.y(), distance});
    Index bucket = no_index;
    front.queue.push(FrontItem::pseudo_source(source), distance, bucket);
}

}  // namespace agvd
