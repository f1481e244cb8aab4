// Sources: [meng2023] Algorithm 1, Sec. 4.3 and 5.2; the window filter after the simplified windows
// of [meng2021].
//
// Symbols: m = points_per_edge, Q = queue_, lambda n = retire_interval_; d(a), d(b), |e| as named.
//
// A node knows the face its path came through and the previous node on that face's boundary (its
// parent). A Steiner point stands for a window around it, seen from its parent, so it serves only
// the targets across its edge inside the fan through both windows; vertices serve their whole
// one-ring. So every target is reached, by a path of the graph, and d(x) <= (d(a) + d(b) + |e|) / 2
// holds on every edge.

#include "agvd/propagation/steiner_engine.h"

#include <algorithm>
#include <cmath>

#include "agvd/propagation/front_queue.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner_points.h"
#include "agvd/propagation/steiner_relays.h"

namespace agvd {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

enum class FaceState : std::uint8_t { Untouched, Open, Retired };

// Targets [begin, end) on the far side of a face, numbered counter-clockwise: 1 .. m on the next
// half-edge, m + 1 the apex, m + 2 .. 2 m + 1 on the previous one.
struct TargetRange {
    Index begin;
    Index end;
};

class SteinerFront {
public:
    SteinerFront(const Surface& surface, std::span<const SurfacePoint> sites,
                 const PropagationOptions& options)
        : surface_(surface),
          sites_(sites),
          options_(options),
          placement_(surface, sites),
          m_(static_cast<Index>(options.steiner_points)),
          step_(m_ + 1),
          inverse_step_(1.0 / step_),
          edge_shift_(edge_shift(m_)),
          vertices_(surface.num_vertices()),
          pool_(surface.num_edges(), m_),
          relays_(surface_, placement_, vertices_, pool_, m_),
          queue_(bucket_width(surface, m_)),
          face_state_(surface.num_faces(), FaceState::Untouched) {}

    Propagation run() {
        poll(options_.progress, 0);
        for (Index s = 0; s < sites_.size(); ++s) start(s);
        const double interval = std::max(1.0, options_.lambda * surface_.num_faces());
        double next_retirement = interval;
        const double all_nodes = static_cast<double>(surface_.num_vertices()) +
                                 static_cast<double>(surface_.num_edges()) * m_;
        std::size_t pops = 0;
        while (refill()) {
            const FrontEntry entry = queue_.pop();
            if (entry.node < vertices_.size()) {
                if (!settle(vertices_[entry.node], entry)) continue;
                serve_one_ring(entry.node);
            } else {
                const Index edge = edge_of_node(entry.node);
                if (pool_.is_retired(edge)) continue;
                const Index point = point_of_node(entry.node);
                if (!settle(pool_.nodes(edge)[point], entry)) continue;
                serve_onward(edge, point);
            }
            if (++pops % poll_interval == 0) {
                poll(options_.progress, static_cast<double>(pops) / all_nodes);
            }
            if (static_cast<double>(pops) >= next_retirement && refill()) {
                next_retirement += interval;
                retire_behind(queue_.top().distance);
            }
        }
        retire_behind(infinity);
        result_.num_nodes = pops;
        poll(options_.progress, 1);
        return collect();
    }

private:
    static constexpr std::size_t poll_interval = 1 << 16;

    // A share of the mean spacing of the nodes, so that most improvements stay within a bucket; and
    // no path is longer than all edges together.
    static double bucket_width(const Surface& surface, Index points_per_edge) {
        constexpr double share = 0.15;
        double sum = 0;
        for (const double length : surface.length) sum += length;
        const double nodes = static_cast<double>(surface.num_edges()) * (points_per_edge + 1);
        return std::max({share * sum / nodes, sum * 0x1p-30, std::numeric_limits<double>::min()});
    }

    // --- Propagation ---------------------------------------------------------------------------

    [[nodiscard]] Index node_id(Index edge, Index point) const {
        return surface_.num_vertices() + (edge << edge_shift_) + point;
    }
    [[nodiscard]] Index edge_of_node(Index node) const {
        return (node - surface_.num_vertices()) >> edge_shift_;
    }
    [[nodiscard]] Index point_of_node(Index node) const {
        return (node - surface_.num_vertices()) & ((Index{1} << edge_shift_) - 1);
    }

    [[nodiscard]] bool refill() {
        return queue_.refill([this](Index id, Index bucket) -> std::optional<FrontEntry> {
            const SteinerNode* node = nullptr;
            if (id < vertices_.size()) {
                node = &vertices_[id];
            } else {
                const Index edge = edge_of_node(id);
                if (pool_.is_retired(edge)) return std::nullopt;
                node = pool_.nodes(edge) + point_of_node(id);
            }
            if (node->queued_in != bucket) return std::nullopt;
            return FrontEntry{node->distance, node->site, id};
        });
    }

    static bool settle(SteinerNode& node, const FrontEntry& entry) {
        if (node.is_settled() || node.distance != entry.distance || node.site != entry.site) {
            return false;
        }
        node.queued_in = SteinerNode::settled;
        return true;
    }

    void relax(SteinerNode& node, Index id, double distance, Index site, Index from, Index slot) {
        if (distance > node.distance || node.is_settled()) return;
        if (distance == node.distance && site >= node.site) return;
        node.distance = distance;
        node.site = site;
        node.from = from;
        node.parent_slot = static_cast<std::uint16_t>(slot);
        queue_.push({distance, site, id}, node.queued_in);
    }

    void relax_vertex(Index from, double distance, Index site, Index slot) {
        const Index v = surface_.tail(from);
        relax(vertices_[v], v, distance, site, from, slot);
    }

    // Serves the points [begin, end) of half-edge `from` (1 .. m counted from its tail), whose
    // positions run on the line tail + t * along, from `source` in the same frame.
    void relax_points(Index from, Index begin, Index end, const Vec2& tail, const Vec2& along,
                      const Vec2& source, double base, Index site, Index slot) {
        if (begin >= end) return;
        touch(Surface::face(from));
        const Index edge = surface_.edge[from];
        if (pool_.is_retired(edge)) return;
        SteinerNode* const nodes = pool_.nodes(edge);
        const bool forward = surface_.edge_half[edge] == from;
        const Index first_id = node_id(edge, 0);
        const Vec2 offset = tail - source;
        for (Index j = begin; j < end; ++j) {
            const double t = j * inverse_step_;
            const double distance = base + (offset + t * along).norm();
            const Index k = forward ? j - 1 : m_ - j;
            relax(nodes[k], first_id + k, distance, site, from, slot);
        }
    }

    void touch(Index face) {
        if (face_state_[face] != FaceState::Untouched) return;
        face_state_[face] = FaceState::Open;
        open_faces_.push_back(face);
    }

    // The whole boundary of a face from a point inside it or on it.
    void serve_face(Index face, Index site, const SurfacePoint& point) {
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * face + k;
            const Vec2 source = position_in_frame(surface_, point, h);
            relax_vertex(h, source.norm(), site, FaceRing::site_slot);
            relax_points(h, 1, step_, {0, 0}, {surface_.length_of(h), 0}, source, 0, site,
                         FaceRing::site_slot);
        }
        touch(face);
    }

    void start(Index s) {
        const SurfacePoint& site = sites_[s];
        if (const auto vertex = vertex_of(surface_, site)) {
            relax(vertices_[*vertex], *vertex, 0, s, no_index, FaceRing::site_slot);
            return;
        }
        serve_face(site.face.value(), s, site);
        const auto half_edge = half_edge_of(site);
        if (half_edge && surface_.twin[*half_edge] != no_index) {
            serve_face(Surface::face(surface_.twin[*half_edge]), s,
                       across_edge(surface_, site, *half_edge));
        }
    }

    void serve_one_ring(Index vertex) {
        const SteinerNode node = vertices_[vertex];
        Index h = surface_.outgoing[vertex];
        if (h == no_index) return;
        do {
            const double length = surface_.length_of(h);
            const Index opposite = Surface::next(h);
            const Vec2& apex =
                surface_.apex[opposite];  // This vertex, seen from the opposite edge.
            const Index slot = FaceRing::slot(2, 0);
            relax_points(h, 1, step_, {0, 0}, {length, 0}, {0, 0}, node.distance, node.site,
                         FaceRing::slot(0, 0));
            relax_vertex(opposite, node.distance + length, node.site, slot);
            relax_points(opposite, 1, step_, {0, 0}, {surface_.length_of(opposite), 0}, apex,
                         node.distance, node.site, slot);
            touch(Surface::face(h));
            const Index previous = Surface::previous(h);
            h = surface_.twin[previous];
            if (h == no_index) {
                const double last = surface_.length_of(previous);
                relax_vertex(previous, node.distance + last, node.site, FaceRing::slot(1, 0));
                relax_points(previous, 1, step_, {0, 0}, {last, 0}, {last, 0}, node.distance,
                             node.site, FaceRing::slot(1, 0));
            }
        } while (h != no_index && h != surface_.outgoing[vertex]);
    }

    void serve_onward(Index edge, Index point) {
        const SteinerNode node = pool_.nodes(edge)[point];
        const Index out = surface_.twin[node.from];
        if (out == no_index) return;
        const double length = surface_.length[edge];
        const bool forward = surface_.edge_half[edge] == out;
        const Index j = forward ? point + 1 : m_ - point;  // Counted from the tail of `out`.
        const Vec2 here(length * j * inverse_step_, 0);

        const auto [parent, spacing] = parent_in_frame(node, length);
        if (!(parent.y() < 0)) return;  // Came along its own edge: the parent serves both sides.
        const TargetRange range = visible_targets(out, here, parent, spacing);

        const Vec2& apex = surface_.apex[out];
        const Index next = Surface::next(out);
        const Index previous = Surface::previous(out);
        const Vec2 head(length, 0);
        relax_points(next, std::max<Index>(range.begin, 1), std::min(range.end, step_), head,
                     apex - head, here, node.distance, node.site, FaceRing::slot(2, j));
        if (range.begin <= step_ && step_ < range.end) {
            relax_vertex(previous, node.distance + (apex - here).norm(), node.site,
                         FaceRing::slot(1, j));
        }
        relax_points(previous, std::max(range.begin, step_ + 1) - step_,
                     std::clamp(range.end, step_ + 1, 2 * step_) - step_, apex, -apex, here,
                     node.distance, node.site, FaceRing::slot(1, j));
    }

    struct Parent {
        Vec2 position;  // In the frame of the half-edge that looks onward: y <= 0.
        Vec2 spacing;   // From it to its neighbour on its own edge, up to sign.
    };

    [[nodiscard]] Vec2 slot_position(const SteinerNode& node) const {
        if (node.parent_slot == FaceRing::site_slot) {
            const SurfacePoint& site = placement_.seen_from(Surface::face(node.from), node.site);
            return position_in_frame(surface_, site, node.from);
        }
        return FaceRing(surface_, node.from, inverse_step_).position(node.parent_slot);
    }

    [[nodiscard]] Parent parent_in_frame(const SteinerNode& node, double length) const {
        const Vec2 p = slot_position(node);
        Vec2 spacing(0, 0);
        if (node.parent_slot != FaceRing::site_slot && FaceRing::number_of(node.parent_slot) != 0) {
            const Vec2& apex = surface_.apex[node.from];
            const bool is_next = FaceRing::side_of(node.parent_slot) == 1;
            spacing = inverse_step_ * (is_next ? Vec2(apex - Vec2(length, 0)) : apex);
        }
        return {{length - p.x(), -p.y()}, spacing};
    }

    // The strip of straight lines from the parent's window to this point's window, both one spacing
    // wide to either side.
    [[nodiscard]] TargetRange visible_targets(Index out, const Vec2& here, const Vec2& parent,
                                              const Vec2& spacing) const {
        const Vec2 ahead = here - parent;
        const bool is_left = ahead.x() * spacing.y() - ahead.y() * spacing.x() > 0;
        const Vec2 turn =
            Vec2(surface_.length_of(out) * inverse_step_, 0) + (is_left ? -spacing : spacing);
        const Vec2 right = ahead + turn;
        const Vec2 left = ahead - turn;
        const double first = right.y() > 0 ? target_at(out, here, right) : 0;
        const double last = left.y() > 0 ? target_at(out, here, left) : 2 * step_;
        return {static_cast<Index>(std::max(0.0, std::floor(first))),
                static_cast<Index>(std::min(2.0 * step_, std::ceil(last))) + 1};
    }

    // Where a ray upwards from the base meets the far side, in target numbers (real).
    [[nodiscard]] double target_at(Index out, const Vec2& origin, const Vec2& direction) const {
        const Vec2& apex = surface_.apex[out];
        const double length = surface_.length_of(out);
        const double run = apex.y() * direction.x() / direction.y();
        if (run < apex.x() - origin.x()) {  // The apex lies to the right: the previous half-edge.
            return step_ * (2 - origin.x() / (apex.x() - run));
        }
        return step_ * (length - origin.x()) / (run - apex.x() + length);
    }

    // --- Retirement (Sec. 5.2) -----------------------------------------------------------------

    void retire_behind(double front) {
        const auto is_behind = [&](Index face) {
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                const double bound =
                    (vertices_[surface_.tail(h)].distance + vertices_[surface_.head(h)].distance +
                     surface_.length_of(h)) /
                    2;
                if (!(bound < front)) return false;
            }
            return true;
        };
        std::size_t kept = 0;
        for (const Index face : open_faces_) {
            if (is_behind(face)) {
                retire(face);
            } else {
                open_faces_[kept++] = face;
            }
        }
        open_faces_.resize(kept);
    }

    void retire(Index face) {
        face_state_[face] = FaceState::Retired;
        const std::size_t before = result_.relays.size();
        if (relays_.is_mixed(face)) {
            relays_.collect(face, result_.relays);
            result_.mixed_faces.push_back(face);
            result_.relay_offsets.push_back(static_cast<Index>(before));
        }
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index twin = surface_.twin[h];
            if (twin == no_index || face_state_[Surface::face(twin)] == FaceState::Retired) {
                pool_.retire(surface_.edge[h]);
            }
        }
    }

    // --- Result --------------------------------------------------------------------------------

    [[nodiscard]] static std::size_t bytes_of(const Propagation& p) {
        return p.relays.capacity() * sizeof(Relay) +
               (p.mixed_faces.capacity() + p.relay_offsets.capacity()) * sizeof(Index) +
               p.vertex_site.capacity() * sizeof(SiteId) +
               p.vertex_distance.capacity() * sizeof(double);
    }

    // Faces retire in an order that depends on lambda; the result does not.
    Propagation collect() {
        Propagation& r = result_;
        const std::size_t common = vertices_.capacity() * sizeof(SteinerNode) +
                                   face_state_.capacity() + open_faces_.capacity() * sizeof(Index) +
                                   bytes_of(r);
        const std::size_t peak_of_front = common + pool_.peak_bytes() + queue_.peak_bytes();
        pool_ = SteinerPool(0, m_);
        const auto count = static_cast<Index>(r.mixed_faces.size());
        r.relay_offsets.push_back(static_cast<Index>(r.relays.size()));
        std::vector<Index> order(count);
        for (Index i = 0; i < count; ++i) order[i] = i;
        std::sort(order.begin(), order.end(),
                  [&](Index a, Index b) { return r.mixed_faces[a] < r.mixed_faces[b]; });

        Propagation sorted;
        sorted.relays.reserve(r.relays.size());
        sorted.mixed_faces.reserve(count);
        sorted.relay_offsets.reserve(count + 1);
        for (const Index i : order) {
            sorted.mixed_faces.push_back(r.mixed_faces[i]);
            sorted.relay_offsets.push_back(static_cast<Index>(sorted.relays.size()));
            sorted.relays.insert(sorted.relays.end(), r.relays.begin() + r.relay_offsets[i],
                                 r.relays.begin() + r.relay_offsets[i + 1]);
        }
        sorted.relay_offsets.push_back(static_cast<Index>(sorted.relays.size()));
        sorted.vertex_site.reserve(vertices_.size());
        sorted.vertex_distance.reserve(vertices_.size());
        for (const SteinerNode& node : vertices_) {
            sorted.vertex_site.push_back(SiteId(node.site));
            sorted.vertex_distance.push_back(node.distance);
        }
        sorted.num_nodes = r.num_nodes;
        sorted.peak_bytes =
            std::max(peak_of_front, common + queue_.peak_bytes() + bytes_of(sorted));
        return sorted;
    }

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    const PropagationOptions& options_;
    SitePlacement placement_;
    Index m_;
    Index step_;           // m + 1 intervals on each edge.
    double inverse_step_;  // 1 / (m + 1)
    int edge_shift_;       // Nodes of an edge are numbered in steps of 2^edge_shift_ >= m.
    std::vector<SteinerNode> vertices_;
    SteinerPool pool_;
    SteinerRelays relays_;
    FrontQueue queue_;
    std::vector<FaceState> face_state_;
    std::vector<Index> open_faces_;
    Propagation result_;
};

}  // namespace

Propagation propagate_steiner(const Surface& surface, std::span<const SurfacePoint> sites,
                              const PropagationOptions& options) {
    return SteinerFront(surface, sites, options).run();
}

}  // namespace agvd
