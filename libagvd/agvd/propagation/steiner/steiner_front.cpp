// Sources: [meng2023] Algorithm 1, Sec. 4.3 and 5.2.
//
// A Steiner point stands for a window around it, seen from its parent: it serves only the targets
// across its edge in the fan through both windows. Vertices serve their whole one-ring, so a path
// of the graph reaches every target, and d(x) <= (d(a) + d(b) + |e|) / 2 holds on every edge.
//
// Nodes are settled by distance + height (Sweep), and of equal paths from a site that counts whose
// last node comes first by (distance, node): as if they were settled by distance.
//
// Faces behind the front retire: their relays are made, and their points are given back. In a face
// a node whose parent lies on it is dominated by the parent, and one that came through a neighbour
// by the parent's image across the shared edge: so a face's relays are the parents' images
// ([meng2023] Sec. 5.3). The order of retirement depends on lambda; the result does not.
#include "agvd/propagation/steiner/steiner_front.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/shape_source.h"

namespace agvd {
namespace {

constexpr std::size_t poll_interval = 1 << 16;

// The width is a share of the mean spacing of the nodes, so that most improvements stay within a
// bucket. No path is longer than all edges together and a start, which bounds the number of
// buckets.
// \param range  of the heights.
double bucket_width(const Surface& surface, std::span<const double> starts,
                    const SteinerCounts& counts, double range) {
    constexpr double share = 0.15;
    double sum = 0;
    for (const double length : surface.length) sum += length;
    const Index num_edges = surface.num_edges();
    const double intervals = counts.total() + num_edges;
    const double last = starts.empty() ? 0 : *std::max_element(starts.begin(), starts.end());
    return std::max({share * sum / intervals, (sum + last + range) * 0x1p-30,
                     std::numeric_limits<double>::min()});
}

bool settle(SteinerNode& node, const FrontEntry& entry) {
    if (node.is_settled() || node.distance != entry.distance || node.site != entry.site) {
        return false;
    }
    node.queued_in = SteinerNode::settled;
    return true;
}

}  // namespace

SteinerFront::SteinerFront(const Surface& surface, std::span<const SurfacePoint> sites,
                           std::span<const Index> site_of_point, std::span<const double> starts,
                           const SteinerCounts& counts)
    : surface_(surface),
      sites_(sites),
      site_of_point_(site_of_point),
      starts_(starts),
      counts_(counts),
      placement_(surface, sites, site_of_point),
      numbers_(surface, counts.most()),
      sweep_(surface),
      vertices_(surface.num_vertices()),
      pool_(surface.num_edges(), counts),
      queue_(bucket_width(surface, starts, counts, sweep_.range())),
      face_state_(surface.num_faces(), FaceState::Untouched) {
    for (Index s = 0; s < sites_.size(); ++s) {
        if (number_of(s) == first_of_site_.size()) first_of_site_.push_back(s);
    }
    first_of_site_.push_back(static_cast<Index>(sites_.size()));
}

void SteinerFront::run(double retirement_interval, const RetirementSink& sink, Poller& poller) {
    poller.tell(0);
    ticker_ = Ticker(poller);
    await_sites();
    double next_retirement = retirement_interval;
    const double all_nodes = static_cast<double>(surface_.num_vertices()) + counts_.total();
    while (refill()) {
        const FrontEntry entry = queue_.pop();
        if (numbers_.is_vertex(entry.node)) {
            if (!settle(vertices_[entry.node], entry)) continue;
            serve_one_ring(entry.node);
        } else {
            const Index edge = numbers_.edge(entry.node);
            if (pool_.is_retired(edge)) continue;
            const Index point = numbers_.point(entry.node);
            if (!settle(pool_.nodes(edge)[point], entry)) continue;
            serve_onward(edge, point);
        }
        if (++num_pops_ % poll_interval == 0) {
            poller.tell(static_cast<double>(num_pops_) / all_nodes);
        }
        if (static_cast<double>(num_pops_) >= next_retirement && refill()) {
            next_retirement += retirement_interval;
            retire_behind(queue_.least_key(), sink, poller);
        }
    }
    poller.tell(1);
    ticker_ = {};
}

void SteinerFront::retire_all(const RetirementSink& sink, Poller& poller) {
    peak_bytes_of_points_ = pool_.peak_bytes();
    retire_behind(infinity, sink, poller);
    pool_.clear();
}

const SteinerNode& SteinerFront::node(Index half_edge, Index j) const {
    if (j == 0) return vertices_[surface_.tail(half_edge)];
    const Index edge = surface_.edge[half_edge];
    const bool forward = surface_.edge_half[edge] == half_edge;
    return pool_.nodes(edge)[forward ? j - 1 : counts_[edge] - j];
}

bool SteinerFront::refill() {
    return queue_.refill([this](Index id, Index bucket) -> std::optional<FrontEntry> {
        const SteinerNode* node = nullptr;
        if (numbers_.is_site(id)) {
            const Index site = numbers_.site(id);
            for (Index s = first_of_site_[site]; s < first_of_site_[site + 1]; ++s) {
                start(sites_[s], site);
            }
            return std::nullopt;
        }
        if (numbers_.is_vertex(id)) {
            node = &vertices_[id];
        } else {
            const Index edge = numbers_.edge(id);
            if (pool_.is_retired(edge)) return std::nullopt;
            node = pool_.nodes(edge) + numbers_.point(id);
        }
        if (node->queued_in != bucket) return std::nullopt;
        return FrontEntry{node->distance, node->site, id};
    });
}

// \param height  of the node: a function, as most paths are not shorter.
template <typename Height>
inline void SteinerFront::relax(SteinerNode& node, Index id, double distance, const Height& height,
                                Index site, Index from, Index slot) {
    if (distance > node.distance || node.is_settled()) return;
    if (distance == node.distance && site >= node.site) {
        if (site > node.site || !comes_first(from, slot, node)) return;
    }
    node.distance = distance;
    node.site = site;
    node.from = from;
    node.parent_slot = static_cast<std::uint16_t>(slot);
    queue_.push({distance, site, id}, distance + height(), node.queued_in);
}

// Whether the last node of another path of the same length, from the same site, comes before that
// of the node's path.
bool SteinerFront::comes_first(Index from, Index slot, const SteinerNode& node) const {
    if (slot == FaceRing::site_slot || node.parent_slot == FaceRing::site_slot) return false;
    const auto order_of = [&](Index face_half, Index parent) {
        const Index h = FaceRing::half_edge(face_half, parent);
        const Index j = FaceRing::number_of(parent);
        if (j == 0) return std::pair(vertices_[surface_.tail(h)].distance, surface_.tail(h));
        const Index edge = surface_.edge[h];
        const Index k = surface_.edge_half[edge] == h ? j - 1 : counts_[edge] - j;
        return std::pair(pool_.nodes(edge)[k].distance, numbers_.of_point(edge, k));
    };
    return order_of(from, slot) < order_of(node.from, node.parent_slot);
}

void SteinerFront::relax_vertex(Index from, double distance, Index site, Index slot) {
    const Index v = surface_.tail(from);
    relax(
        vertices_[v], v, distance, [&] { return sweep_.height(v); }, site, from, slot);
}

// Serves the points [begin, end) of half-edge `from`, which are numbered 1 to m from its tail. They
// lie on the line tail + t * along, in the frame of `source`.
void SteinerFront::relax_points(Index from, Index begin, Index end, const Vec2& tail,
                                const Vec2& along, const Vec2& source, double base, Index site,
                                Index slot) {
    if (begin >= end) return;
    ticker_.tick(end - begin);
    open(Surface::face(from));
    const Index edge = surface_.edge[from];
    if (pool_.is_retired(edge)) return;
    SteinerNode* const nodes = pool_.nodes(edge);
    const bool forward = surface_.edge_half[edge] == from;
    const Index m = counts_[edge];
    const double step = counts_.step(edge);
    const Index first_id = numbers_.of_point(edge, 0);
    const Vec2 offset = tail - source;
    const double height = sweep_.height(surface_.tail(from));
    const double rise = sweep_.height(surface_.head(from)) - height;
    for (Index j = begin; j < end; ++j) {
        const double t = j * step;
        const double distance = base + (offset + t * along).norm();
        const Index k = forward ? j - 1 : m - j;
        relax(
            nodes[k], first_id + k, distance, [&] { return height + t * rise; }, site, from, slot);
    }
}

// Serves all points of a half-edge, in whose frame `source` lies.
void SteinerFront::relax_side(Index from, const Vec2& source, double base, Index site, Index slot) {
    relax_points(from, 1, counts_[surface_.edge[from]] + 1, {0, 0}, {surface_.length_of(from), 0},
                 source, base, site, slot);
}

// Sites start when the front comes to them: until then they take no nodes.
void SteinerFront::await_sites() {
    for (Index site = 0; site + 1 < first_of_site_.size(); ++site) {
        double height = infinity;
        for (Index s = first_of_site_[site]; s < first_of_site_[site + 1]; ++s) {
            height = std::min(height, sweep_.height(surface_, sites_[s]));
        }
        queue_.push_unknown(numbers_.of_site(site), start_of(starts_, site) + height);
    }
}

void SteinerFront::start(const SurfacePoint& place, Index s) {
    const double base = start_of(starts_, s);
    if (const auto vertex = vertex_of(surface_, place)) {
        relax(
            vertices_[*vertex], *vertex, base, [&] { return sweep_.height(*vertex); }, s, no_index,
            FaceRing::site_slot);
        return;
    }
    for_each_side(surface_, place, [&](const SurfacePoint& point, Index) {
        const Index face = point.face.value();
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Vec2 source = position_in_frame(surface_, point, h);
            relax_vertex(h, base + source.norm(), s, FaceRing::site_slot);
            relax_side(h, source, base, s, FaceRing::site_slot);
        }
        open(face);
    });
}

void SteinerFront::serve_one_ring(Index vertex) {
    const auto [base, site] = std::pair(vertices_[vertex].distance, vertices_[vertex].site);
    Index h = surface_.outgoing[vertex];
    if (h == no_index) return;
    do {
        const Index opposite = Surface::next(h);
        const Vec2& apex = surface_.apex[opposite];  // This vertex, seen from the opposite edge.
        relax_side(h, {0, 0}, base, site, FaceRing::slot(0, 0));
        relax_vertex(opposite, base + surface_.length_of(h), site, FaceRing::slot(2, 0));
        relax_side(opposite, apex, base, site, FaceRing::slot(2, 0));
        open(Surface::face(h));
        const Index previous = Surface::previous(h);
        h = surface_.twin[previous];
        if (h == no_index) {
            const double last = surface_.length_of(previous);
            relax_vertex(previous, base + last, site, FaceRing::slot(1, 0));
            relax_side(previous, {last, 0}, base, site, FaceRing::slot(1, 0));
        }
    } while (h != no_index && h != surface_.outgoing[vertex]);
}

void SteinerFront::serve_onward(Index edge, Index point) {
    const SteinerNode node = pool_.nodes(edge)[point];
    const Index out = surface_.twin[node.from];
    if (out == no_index) return;
    const double length = surface_.length[edge];
    const double step = counts_.step(edge);
    const bool forward = surface_.edge_half[edge] == out;
    const Index j = forward ? point + 1 : counts_[edge] - point;  // From the tail of `out`.
    const Vec2 here(length * j * step, 0);

    const Vec2 p = slot_position(node, Vec2(length, 0) - here);
    const Vec2 parent(length - p.x(), -p.y());
    if (!(parent.y() < 0)) return;  // The path came along the edge: the parent serves both sides.
    const Vec2& apex = surface_.apex[out];
    const Index next = Surface::next(out);
    const Index previous = Surface::previous(out);
    const Index to_apex = counts_[surface_.edge[next]] + 1;
    const Index from_apex = counts_[surface_.edge[previous]] + 1;
    const TargetRange range = FarSide{length, apex, to_apex, from_apex}.visible_targets(
        here, length * step, parent, parent_spacing(node));
    const Vec2 head(length, 0);
    relax_points(next, std::max<Index>(range.begin, 1), std::min(range.end, to_apex), head,
                 apex - head, here, node.distance, node.site, FaceRing::slot(2, j));
    if (range.begin <= to_apex && to_apex < range.end) {
        relax_vertex(previous, node.distance + (apex - here).norm(), node.site,
                     FaceRing::slot(1, j));
    }
    relax_points(previous, std::max(range.begin, to_apex + 1) - to_apex,
                 std::clamp(range.end, to_apex + 1, to_apex + from_apex) - to_apex, apex, -apex,
                 here, node.distance, node.site, FaceRing::slot(1, j));
}

// The path's previous node in the frame of node.from, where the node itself lies at `here`.
Vec2 SteinerFront::slot_position(const SteinerNode& node, const Vec2& here) const {
    if (node.parent_slot != FaceRing::site_slot) {
        return FaceRing::position(surface_, counts_, node.from, node.parent_slot);
    }
    // The nearest of the points of a line; and there are two names of a site on an edge along which
    // the face is glued to itself.
    Vec2 nearest(infinity, infinity);
    for (const PlacedSite& placed : placement_.in_face(Surface::face(node.from))) {
        if (placed.site != node.site) continue;
        const Vec2 p = position_in_frame(surface_, placed.point, node.from);
        if ((p - here).squaredNorm() < (nearest - here).squaredNorm()) nearest = p;
    }
    return nearest;
}

// The vector from the parent to its neighbour on the parent's edge, up to sign; 0 for a vertex or a
// site, which has no window. The parent must not lie on the node's edge.
Vec2 SteinerFront::parent_spacing(const SteinerNode& node) const {
    if (node.parent_slot == FaceRing::site_slot || FaceRing::number_of(node.parent_slot) == 0) {
        return {0, 0};
    }
    const Index h = node.from;
    const Vec2& apex = surface_.apex[h];
    if (FaceRing::side_of(node.parent_slot) == 1) {
        return counts_.step(surface_.edge[Surface::next(h)]) *
               Vec2(apex - Vec2(surface_.length_of(h), 0));
    }
    return counts_.step(surface_.edge[Surface::previous(h)]) * apex;
}

// By d(x) <= min(d(a) + |a x|, d(b) + |x b|) on an edge: with the heights this is the largest where
// both are equal, at (d(a) + d(b) + |e|) / 2.
bool SteinerFront::is_behind(Index face, double front) const {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double a = vertices_[surface_.tail(h)].distance;
        const double b = vertices_[surface_.head(h)].distance;
        const double length = surface_.length_of(h);
        const double height = sweep_.height(surface_.tail(h));
        const double rise = sweep_.height(surface_.head(h)) - height;
        const double bound = (a + b + length) / 2 + height + rise * (b - a + length) / (2 * length);
        if (!(bound < front)) return false;
    }
    return true;
}

void SteinerFront::retire(Index face, RetiredFaces& retired) {
    face_state_[face] = FaceState::Retired;
    retired.faces.push_back(face);
    if (is_mixed(face)) {
        const auto begin = static_cast<Index>(retired.relays.size());
        collect(face, retired.relays);
        retired.mixed_faces.push_back(face);
        retired.relay_ranges.push_back({begin, static_cast<Index>(retired.relays.size())});
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = surface_.twin[h];
        if (twin == no_index || face_state_[Surface::face(twin)] == FaceState::Retired) {
            pool_.retire(surface_.edge[h]);
        }
    }
}

bool SteinerFront::are_all_from(Index half_edge, Index site) {
    if (vertices_[surface_.tail(half_edge)].site != site) return false;
    const Index edge = surface_.edge[half_edge];
    if (counts_[edge] == 0) return true;
    const std::span nodes(pool_.nodes(edge), counts_[edge]);
    return std::ranges::all_of(nodes, [&](const SteinerNode& n) { return n.site == site; });
}

// Whether a face is not redundant (Sec. 4.3): its boundary has nodes of several sites, or a site in
// the face or in a neighbour may have a cell that lies between the nodes.
bool SteinerFront::is_mixed(Index face) {
    const Index site = vertices_[surface_.tail(3 * face)].site;
    const auto may_hold_another = [&](Index f) {
        return std::ranges::any_of(placement_.in_face(f),
                                   [&](const PlacedSite& p) { return p.site != site; });
    };
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (!are_all_from(h, site)) return true;
        const Index twin = surface_.twin[h];
        if (twin != no_index && may_hold_another(Surface::face(twin))) return true;
    }
    return may_hold_another(face);
}

void SteinerFront::add_relay(Index half_edge, const Vec2& image, double weight, Index site,
                             std::vector<Relay>& relays) const {
    relays.push_back({image.x(), image.y(), std::max(weight, 0.0), 0, surface_.length_of(half_edge),
                      SiteId(site), half_edge});
}

void SteinerFront::collect(Index face, std::vector<Relay>& relays) {
    for (const PlacedSite& placed : placement_.in_face(face)) {
        add_relay(3 * face, position_in_frame(surface_, placed.point, 3 * face),
                  start_of(starts_, placed.site), placed.site, relays);
    }
    for (const PlacedRegion& region : placement_.regions_of(face)) {
        relays.push_back(region_relay(surface_, region, start_of(starts_, region.site)));
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const SteinerNode& corner = vertices_[surface_.tail(h)];
        if (corner.from != h) {  // Else its parent in this face replaces it.
            add_relay(h, {0, 0}, corner.distance, corner.site, relays);
        }
        const Index twin = surface_.twin[h];
        if (twin != no_index) collect_across(h, twin, relays);
    }
}

// Adds the images of the parents in the neighbour from which nodes on h were reached.
void SteinerFront::collect_across(Index h, Index twin, std::vector<Relay>& relays) {
    const double length = surface_.length_of(h);
    const auto mirrored = [length](const Vec2& p) { return Vec2(length - p.x(), -p.y()); };
    const Index neighbour = Surface::face(twin);
    for (const PlacedSite& placed : placement_.in_face(neighbour)) {
        const Vec2 image = mirrored(position_in_frame(surface_, placed.point, twin));
        // Sites on the edge are in in_face(face), too.
        if (image.y() < 0) add_relay(h, image, start_of(starts_, placed.site), placed.site, relays);
    }
    const Index edge = surface_.edge[h];
    const Index m = counts_[edge];
    if (m == 0) return;
    const double step = counts_.step(edge);
    const SteinerNode* const nodes = pool_.nodes(edge);
    seen_slots_.clear();
    for (Index k = 0; k < m; ++k) {
        const SteinerNode& node = nodes[k];
        if (node.from != twin || node.parent_slot == FaceRing::site_slot ||
            FaceRing::is_on_base(node.parent_slot)) {
            continue;
        }
        const std::pair<Index, Index> key(node.parent_slot, node.site);
        if (std::find(seen_slots_.begin(), seen_slots_.end(), key) != seen_slots_.end()) {
            continue;
        }
        seen_slots_.push_back(key);
        const Vec2 p = FaceRing::position(surface_, counts_, twin, node.parent_slot);
        const Index j = surface_.edge_half[edge] == twin ? k + 1 : m - k;
        const double chord = (p - Vec2(length * j * step, 0)).norm();
        add_relay(h, mirrored(p), node.distance - chord, node.site, relays);
    }
}

void SteinerFront::retire_behind(double front, const RetirementSink& sink, Poller& poller) {
    constexpr std::size_t most_at_once = 1 << 10;  // Their relays take half a megabyte.
    RetiredFaces retired;
    std::size_t kept = 0;
    for (const Index face : open_) {
        if (!is_behind(face, front)) {
            open_[kept++] = face;
            continue;
        }
        retire(face, retired);
        if (retired.faces.size() == most_at_once) hand_over(retired, sink, poller);
    }
    open_.resize(kept);
    if (!retired.faces.empty()) hand_over(retired, sink, poller);
}

void SteinerFront::hand_over(RetiredFaces& retired, const RetirementSink& sink,
                             Poller& poller) const {
    retired.label = [this](Index v) {
        return VertexLabel{SiteId(vertices_[v].site), vertices_[v].distance};
    };
    sink(std::exchange(retired, {}), poller);
}

}  // namespace agvd
