// [meng2023] Sec. 5.3. What a stage reads of a vertex, an edge or a face is the same as if it ran
// when all faces have come, so the diagram has the same bytes.
#include "agvd/diagram/tracer.h"

#include <algorithm>
#include <numeric>

#include "agvd/mesh/surface_points.h"

namespace agvd {

DiagramTracer::DiagramTracer(const Surface& surface, std::span<const SurfacePoint> sites,
                             const PropagationOptions& propagating, const DiagramOptions& options)
    : surface_(surface),
      options_(options),
      places_(all_places(surface, sites, sites_of_points(propagating, sites.size()),
                         propagating.shapes)),
      mainland_(surface, parts_.labels),
      state_(surface.num_faces(), FaceState::Coming),
      faces_left_(surface.num_vertices(), 0),
      is_wanted_(surface.num_vertices(), 0) {
    for (Index i = 0; i < places_.points.size(); ++i) {
        if (const auto vertex = vertex_of(surface, places_.points[i])) {
            at_vertices_.emplace_back(*vertex, i);
        } else {
            in_faces_.emplace_back(places_.points[i].face.value(), i);
        }
    }
    std::sort(at_vertices_.begin(), at_vertices_.end());
    std::sort(in_faces_.begin(), in_faces_.end());
    for (const Triangle& corners : surface.mesh.triangles) {
        for (const Index v : corners) ++faces_left_[v];
    }
    own_.num_sites = parts_.num_sites = places_.num_sites;
    EdgeLabels& labels = parts_.labels;
    labels.first_crossing_node = surface.num_vertices() + size_of(places_.points);
    labels.point_site.assign(surface.num_vertices(), no_index);
    labels.vertex_distance.assign(surface.num_vertices(), infinity);
    labels.mixed_index.assign(surface.num_faces(), no_index);
    labels.edge_rows.assign(surface.num_edges(), {});
}

void DiagramTracer::add(RetiredFaces&& retired, Poller& poller) {
    store(retired);
    const std::vector<Index> faces = std::move(retired.faces);
    retired = {};
    EdgeLabels& labels = parts_.labels;
    const auto first_own = size_of(own_.points);
    const auto first_inner = size_of(labels.inner_points);
    for (const Index face : faces) {
        if (is_mixed(face)) continue;
        state_[face] = FaceState::Done;
        add_own_places(in_faces_, face);
        mainland_.add_plain_face(face);
    }
    const std::vector<Index> vertices = finished_vertices(faces);
    for (const Index v : vertices) add_own_places(at_vertices_, v);
    const std::vector<Index> ready = ready_faces(vertices);
    for (const Index i : ready) add_own_places(in_faces_, propagation_.mixed_faces[i]);

    const SitePlacement placement(surface_, std::span(own_.points).subspan(first_own),
                                  std::span(own_.sites).subspan(first_own));
    const StageInput in = input(placement, poller);
    label(in, vertices);
    label_edges(in, edges_of_ready_faces(ready), labels);
    cut_faces(in, ready, labels);
    parts_.arcs.faces.resize(propagation_.mixed_faces.size());
    trace_faces(in, ready, parts_);
    for (const Index i : ready) {
        state(i) = FaceState::Traced;
        mainland_.add_traced_face(
            propagation_.mixed_faces[i],
            elements_of(parts_.arcs.connections, parts_.arcs.faces[i].connections));
    }
    for (Index i = first_own; i < own_.points.size(); ++i) {
        const Index node = holder_of(in, labels, i);
        if (node != no_index) mainland_.add_site(node);
    }
    for (Index i = first_inner; i < labels.inner_points.size(); ++i) {
        mainland_.add_site(surface_.num_vertices() + i);
    }
    if (!options_.chord) drop_relays();
}

// Behind the relays that are held.
void DiagramTracer::store(const RetiredFaces& retired) {
    EdgeLabels& labels = parts_.labels;
    for (const Index face : retired.faces) {
        state_[face] = FaceState::Waiting;
        for (const Index v : surface_.mesh.triangles[face]) {
            const VertexLabel label = retired.label(v);
            labels.point_site[v] = label.site.value();
            labels.vertex_distance[v] = label.distance;
        }
    }
    const auto first = size_of(propagation_.relays);
    for (std::size_t i = 0; i < retired.mixed_faces.size(); ++i) {
        const auto [begin, end] = retired.relay_ranges[i];
        const auto position = size_of(propagation_.mixed_faces);
        labels.mixed_index[retired.mixed_faces[i]] = position;
        held_.push_back(position);
        propagation_.mixed_faces.push_back(retired.mixed_faces[i]);
        propagation_.relay_ranges.push_back({first + begin, first + end});
    }
    append_to<Relay>(propagation_.relays, retired.relays);
    most_relays_ = std::max(most_relays_, propagation_.relays.size());
}

// Those all of whose faces have come, with these.
std::vector<Index> DiagramTracer::finished_vertices(std::span<const Index> faces) {
    std::vector<Index> vertices;
    for (const Index face : faces) {
        for (const Index v : surface_.mesh.triangles[face]) {
            if (--faces_left_[v] == 0) vertices.push_back(v);
        }
    }
    return vertices;
}

void DiagramTracer::add_own_places(const PlacesAt& places_at, Index element) {
    auto at = std::lower_bound(places_at.begin(), places_at.end(), std::pair(element, Index{0}));
    for (; at != places_at.end() && at->first == element; ++at) {
        const Index place = at->second;
        if (!owns_its_place(surface_, propagation_, parts_.labels, places_, place)) continue;
        own_.points.push_back(places_.points[place]);
        own_.sites.push_back(places_.sites[place]);
    }
}

void DiagramTracer::order_by_face(std::vector<Index>& positions) const {
    std::ranges::sort(positions, {}, [&](Index i) { return propagation_.mixed_faces[i]; });
}

// Labels those of these vertices that lie in mixed faces only.
void DiagramTracer::label(const StageInput& input, std::span<const Index> vertices) {
    const EdgeLabels& labels = parts_.labels;
    std::vector<Index> around;
    for (const Index v : vertices) {
        bool are_mixed = true;
        for_each_outgoing(surface_, v,
                          [&](Index h) { are_mixed = are_mixed && is_mixed(Surface::face(h)); });
        if (!are_mixed) continue;
        is_wanted_[v] = 1;
        for_each_outgoing(surface_, v,
                          [&](Index h) { around.push_back(labels.mixed_index[Surface::face(h)]); });
    }
    order_by_face(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    label_vertices(input, around, is_wanted_, parts_.labels);
    for (const Index v : vertices) is_wanted_[v] = 0;
}

// The mixed faces around these vertices all of whose corners are finished.
std::vector<Index> DiagramTracer::ready_faces(std::span<const Index> vertices) {
    std::vector<Index> positions;
    for (const Index v : vertices) {
        for_each_outgoing(surface_, v, [&](Index h) {
            const Index face = Surface::face(h);
            if (state_[face] != FaceState::Waiting) return;
            const Triangle& corners = surface_.mesh.triangles[face];
            if (std::ranges::any_of(corners, [&](Index c) { return faces_left_[c] > 0; })) return;
            state_[face] = FaceState::Ready;
            positions.push_back(parts_.labels.mixed_index[face]);
        });
    }
    order_by_face(positions);
    return positions;
}

// The lower half-edges of those that no traced face shares, and that lie between mixed faces.
std::vector<Index> DiagramTracer::edges_of_ready_faces(std::span<const Index> positions) const {
    std::vector<Index> half_edges;
    for (const Index i : positions) {
        const Index face = propagation_.mixed_faces[i];
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = surface_.twin[h];
            const FaceState across =
                twin == no_index ? FaceState::Waiting : state_[Surface::face(twin)];
            if (across == FaceState::Waiting || (across == FaceState::Ready && h < twin)) {
                half_edges.push_back(std::min(h, twin));
            }
        }
    }
    return half_edges;
}

void DiagramTracer::drop_relays() {
    for (const Index i : held_) {
        if (state(i) != FaceState::Traced) continue;
        if (mainland_.holds(propagation_.mixed_faces[i])) state(i) = FaceState::Done;
    }
    std::size_t kept = 0;
    Index end = 0;
    for (const Index i : held_) {
        RelayRange& range = propagation_.relay_ranges[i];
        if (is_done(propagation_.mixed_faces[i])) {
            range = dropped_relays;
            continue;
        }
        const auto relays = propagation_.relays.begin();
        std::move(relays + range.begin, relays + range.end, relays + end);
        range = {end, end + range.end - range.begin};
        end = range.end;
        held_[kept++] = i;
    }
    held_.resize(kept);
    propagation_.relays.resize(end);
}

// Whether neither the face nor one that reads its relays is traced again.
bool DiagramTracer::is_done(Index face) const {
    if (state_[face] != FaceState::Done) return false;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = surface_.twin[h];
        if (twin != no_index && state_[Surface::face(twin)] != FaceState::Done) return false;
    }
    return true;
}

void DiagramTracer::sort_by_face() {
    std::vector<Index> order(propagation_.mixed_faces.size());
    std::iota(order.begin(), order.end(), Index{0});
    order_by_face(order);
    propagation_.mixed_faces = take(propagation_.mixed_faces, order);
    propagation_.relay_ranges = take(propagation_.relay_ranges, order);
    parts_.arcs.faces = take(parts_.arcs.faces, order);
    for (Index i = 0; i < order.size(); ++i) {
        parts_.labels.mixed_index[propagation_.mixed_faces[i]] = i;
    }
}

std::optional<Diagram> DiagramTracer::finish() && {
    sort_by_face();
    Poller poller(options_.progress);
    const SitePlacement none;
    return draw(input(none, poller), std::move(parts_), [&] { propagation_.relays = {}; });
}

std::optional<TracedDiagram> trace_behind_front(const Surface& surface,
                                                std::span<const SurfacePoint> sites,
                                                const PropagationOptions& propagating,
                                                const DiagramOptions& options) {
    DiagramTracer tracer(surface, sites, propagating, options);
    propagate_retiring(surface, sites, propagating, [&](RetiredFaces&& retired, Poller& poller) {
        tracer.add(std::move(retired), poller);
    });
    const std::size_t most_relays = tracer.most_relays();
    std::optional<Diagram> diagram = std::move(tracer).finish();
    if (!diagram) return {};
    return TracedDiagram{std::move(*diagram), infinity, most_relays};
}

}  // namespace agvd
