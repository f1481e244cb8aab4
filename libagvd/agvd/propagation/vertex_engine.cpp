// Sources: windows as in [xin2009] and [meng2021], cut down to one for each vertex.
//
// A wedge is a fan of rays from an image, laid out in the plane along the faces that it crosses;
// its sides pass through vertices already served. Nothing lies in its way, so the chord to a vertex
// that it meets is a path on the surface. A vertex keeps the wedge that reaches it on the shortest
// chord and, when its turn comes, passes on the two parts to its left and right. What wedges do not
// reach within a few faces is reached along the edges, and sees the vertex it was reached from.

#include "agvd/propagation/vertex_engine.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "agvd/core/parallel.h"
#include "agvd/propagation/bucket_queue.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/vertex_relays.h"
#include "agvd/propagation/vertex_views.h"

namespace agvd {
namespace {

// Distances that differ by less, relative to their size, are tied: some hundred roundings.
constexpr double tie_tolerance = 1e-13;
// Sine below which a wedge has no width, and a chord beside it still counts as inside: it then
// bends by no more than this, and is short by the square of it.
constexpr double least_angle = 1e-7;
// A wedge goes on past a vertex nearer to something else while it leads, up to this share of its
// distance, at an end of the edge it crosses.
constexpr double lead_tolerance = 1e-6;
// Faces that a wedge crosses in search of a vertex. More is more accurate where sites are far apart
// (30: a tenth of the error on 70k faces with 100 sites, at three times the cost).
constexpr int max_crossings = 7;
// The same for the shadow behind a saddle vertex, mostly too narrow to meet anything.
constexpr int max_shadow_crossings = 3;
// Width of the queue's buckets in mean edge lengths.
constexpr double bucket_share = 0.4;
// Nodes looked up ahead of their turn.
constexpr std::size_t look_ahead = 6;

// What a step across a face reads, in two cache lines for each face.
struct alignas(32) Corner {
    Vec2 turn;      // Turns and stretches the half-edge into the other edge at its tail.
    double length;  // Of the half-edge.
    Index twin;
    Index tail;
};

struct Wedge {
    Vec2 tail, head;  // Of the half-edge about to be crossed.
    Vec2 image;
    Vec2 left, right;  // Directions of the sides; the tail is to the left.
    double weight;     // Distance from the site to the image.
    Index site;
    Index half_edge;  // no_index: the surface ends here.
};

class VertexFront {
public:
    VertexFront(const Surface& surface, std::span<const SurfacePoint> sites,
                const PropagationOptions& options)
        : surface_(surface),
          sites_(sites),
          options_(options),
          placement_(surface, sites),
          corners_(make_corners(surface, options.num_threads)),
          reach_(surface.num_vertices()),
          views_(surface.num_vertices()),
          queue_(bucket_width(surface)) {}

    Propagation run() {
        poll(options_.progress, 0);
        for (Index s = 0; s < sites_.size(); ++s) start(s);
        std::size_t served = 0;
        for (Index v = queue_.pop(); v != no_index; v = queue_.pop()) {
            prefetch();
            if (!queue_.take(v, reach_[v].distance, reach_[v].queued_in)) continue;
            serve(v);
            if (++served % poll_interval == 0) {
                const double share = static_cast<double>(served) / surface_.num_vertices();
                poll(options_.progress, std::min(share, 1.0));
            }
        }
        poll(options_.progress, 1);
        return collect();
    }

private:
    static constexpr std::size_t poll_interval = 1 << 16;

    static std::unique_ptr<Corner[]> make_corners(const Surface& surface, int num_threads) {
        constexpr Index grain = 1 << 14;
        auto corners = std::make_unique_for_overwrite<Corner[]>(surface.twin.size());
        parallel_chunks(surface.num_faces(), grain, num_threads,
                        [&](Index, Index begin, Index end) {
                            for (Index h = 3 * begin; h < 3 * end; ++h) {
                                const double length = surface.length_of(h);
                                corners[h] = {surface.apex[h] / length, length, surface.twin[h],
                                              surface.tail(h)};
                            }
                        });
        return corners;
    }

    static double bucket_width(const Surface& surface) {
        double sum = 0;
        for (const double length : surface.length) sum += length;
        const double mean = sum / std::max<double>(surface.num_edges(), 1);
        return std::max({bucket_share * mean, sum * 0x1p-24, std::numeric_limits<double>::min()});
    }

    // The nodes to come are known, and lie anywhere in memory.
    void prefetch() const {
        if (const Index v = queue_.peek(look_ahead); v != no_index) {
            __builtin_prefetch(&reach_[v]);
            __builtin_prefetch(&views_[v]);
        }
        const Index v = queue_.peek(look_ahead / 2);
        if (v == no_index || views_[v].half_edge == no_index) return;
        const Index face = Surface::face(views_[v].half_edge);
        __builtin_prefetch(&corners_[3 * face]);
        __builtin_prefetch(&corners_[3 * face + 2]);
    }

    // --- Mesh ----------------------------------------------------------------------------------

    [[nodiscard]] Index tail(Index h) const { return corners_[h].tail; }
    [[nodiscard]] Index head(Index h) const { return corners_[Surface::next(h)].tail; }
    [[nodiscard]] Index twin(Index h) const { return corners_[h].twin; }
    [[nodiscard]] double length(Index h) const { return corners_[h].length; }
    [[nodiscard]] Vec2 apex(Index h) const { return corners_[h].turn * corners_[h].length; }

    // --- Wedges --------------------------------------------------------------------------------

    [[nodiscard]] bool improve(Index v, double distance, Index site) {
        VertexReach& reach = reach_[v];
        const double slack = tie_tolerance * distance;
        if (!(distance < reach.distance - slack ||
              (distance <= reach.distance + slack && site < reach.site))) {
            return false;
        }
        reach.distance = distance;
        reach.site = site;
        queue_.push(v, distance, reach.queued_in);
        return true;
    }

    [[nodiscard]] Wedge wedge_of(const VertexView& view, Index site) const {
        return {{0, 0},
                {length(view.half_edge), 0},
                view.image,
                direction(view.left),
                direction(view.right),
                view.weight,
                site,
                view.half_edge};
    }

    [[nodiscard]] VertexView view_of(const Wedge& w) const {
        const Vec2 axis = (w.head - w.tail) / length(w.half_edge);
        return {
            turned_back(w.image - w.tail, axis), w.weight,    rounded(turned_back(w.left, axis)),
            rounded(turned_back(w.right, axis)), w.half_edge, ViewKind::Window};
    }

    [[nodiscard]] Vec2 apex_of(const Wedge& w) const {
        return w.tail + turned(w.head - w.tail, corners_[w.half_edge].turn);
    }

    // Lays out faces until the wedge meets a vertex that it improves. What it meets there must not
    // be lost: the loser of the two goes on.
    void trace(Wedge w, int crossings) {
        for (; crossings > 0 && w.half_edge != no_index; --crossings) {
            const Index h = w.half_edge;
            const Vec2 apex = apex_of(w);
            const Vec2 chord = apex - w.image;
            if (cross_product(w.right, chord) < -least_angle * w.right.dot(chord)) {
                w.head = apex;
                w.half_edge = twin(Surface::previous(h));
                continue;
            }
            if (cross_product(chord, w.left) < -least_angle * w.left.dot(chord)) {
                w.tail = apex;
                w.half_edge = twin(Surface::next(h));
                continue;
            }
            const Index v = tail(Surface::previous(h));
            const VertexReach before = reach_[v];
            if (improve(v, w.weight + chord.norm(), w.site)) {
                const VertexView loser = views_[v];
                views_[v] = view_of(w);
                const bool was_served = before.queued_in == no_index;
                if (was_served || loser.kind != ViewKind::Window) return;
                w = wedge_of(loser, before.site);
            }
            if (!pass(w, crossings)) return;
        }
    }

    // Beyond the apex of its face, which is nearer to something else, a wedge keeps the sides on
    // which it leads. One of them is traced here if there are two; false if there is none.
    [[nodiscard]] bool pass(Wedge& w, int crossings) {
        const Vec2 apex = apex_of(w);
        const auto leads_at = [&](const Vec2& end, Index vertex) {
            const double bound = w.weight + (end - w.image).norm();
            return bound * (1 - lead_tolerance) <= reach_[vertex].distance;
        };
        const bool on_left = leads_at(w.tail, tail(w.half_edge));
        const bool on_right = leads_at(w.head, head(w.half_edge));
        if (!on_left) return on_right && keep_right(w, apex);
        if (on_right) {
            Wedge right = w;
            if (keep_right(right, apex)) trace(right, crossings - 1);
        }
        return keep_left(w, apex);
    }

    // The part left of the apex, about to leave the face; false if it has no width.
    [[nodiscard]] bool keep_left(Wedge& w, const Vec2& apex) const {
        const Vec2 chord = apex - w.image;
        if (!(cross_product(chord, w.left) > least_angle * w.left.dot(chord))) return false;
        w.right = chord;
        w.head = apex;
        w.half_edge = twin(Surface::previous(w.half_edge));
        return true;
    }

    [[nodiscard]] bool keep_right(Wedge& w, const Vec2& apex) const {
        const Vec2 chord = apex - w.image;
        if (!(cross_product(w.right, chord) > least_angle * w.right.dot(chord))) return false;
        w.left = chord;
        w.tail = apex;
        w.half_edge = twin(Surface::next(w.half_edge));
        return true;
    }

    // All that a point of the face of h sees through an edge from `tail` to `head` seen from
    // outside, whose half-edge there is `out`; in the frame of h.
    void look_through(Index out, const Vec2& tail, const Vec2& head, const Vec2& point,
                      double weight, Index site) {
        trace({tail, head, point, tail - point, head - point, weight, site, out}, max_crossings);
    }
    void look_through_next(Index h, const Vec2& point, double weight, Index site) {
        look_through(twin(Surface::next(h)), apex(h), {length(h), 0}, point, weight, site);
    }
    void look_through_previous(Index h, const Vec2& point, double weight, Index site) {
        look_through(twin(Surface::previous(h)), {0, 0}, apex(h), point, weight, site);
    }

    // --- Sites ---------------------------------------------------------------------------------

    void start(Index s) {
        const SurfacePoint& site = sites_[s];
        if (const auto vertex = vertex_of(surface_, site)) {
            if (improve(*vertex, 0, s)) views_[*vertex] = {};
            return;
        }
        serve_face(site.face.value(), s, site);
        const auto half_edge = half_edge_of(site);
        if (half_edge && twin(*half_edge) != no_index) {
            serve_face(Surface::face(twin(*half_edge)), s, across_edge(surface_, site, *half_edge));
        }
    }

    void serve_face(Index face, Index site, const SurfacePoint& point) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Vec2 image = position_in_frame(surface_, point, h);
            const Index v = tail(Surface::previous(h));
            if (!improve(v, (apex(h) - image).norm(), site)) continue;
            views_[v] = {image, 0, {}, {}, h, ViewKind::Face};
        }
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            look_through_next(h, position_in_frame(surface_, point, h), 0, site);
        }
    }

    // --- Vertices ------------------------------------------------------------------------------

    void serve(Index v) {
        const VertexReach reach = reach_[v];
        const VertexView view = views_[v];
        const Index h = view.half_edge;
        switch (view.kind) {
            case ViewKind::Site:
                serve_ring(v, reach, surface_.outgoing[v], {0, 0});
                break;
            case ViewKind::Window: {
                const Vec2 apex = this->apex(h);
                Wedge left = wedge_of(view, reach.site);
                if (keep_left(left, apex)) trace(left, max_crossings);
                Wedge right = wedge_of(view, reach.site);
                if (keep_right(right, apex)) trace(right, max_crossings);
                [[fallthrough]];
            }
            case ViewKind::Face:
                serve_ring(v, reach, Surface::previous(h),
                           turned_back(view.image - apex(h), -apex(h)));
                break;
            case ViewKind::FromTail:
                look_past_head(h, reach);
                serve_ring(v, reach, twin(h) != no_index ? twin(h) : Surface::next(h), {1, 0});
                break;
            case ViewKind::FromHead:
                look_through_previous(h, {length(h), 0}, reach.distance - length(h), reach.site);
                serve_ring(v, reach, h, {1, 0});
                break;
        }
    }

    // What the tail of h sees beside its head, through the edges opposite to it in the two faces at
    // h. The neighbour at the other end of such an edge may have looked through it already.
    void look_past_head(Index h, const VertexReach& at_head) {
        const auto has_looked = [&](Index spoke) {
            const Index v = head(spoke);
            return views_[v].half_edge == spoke && views_[v].kind == ViewKind::FromTail &&
                   reach_[v].queued_in == no_index;
        };
        const double weight = at_head.distance - length(h);
        const Index left = twin(Surface::previous(h));
        if (left == no_index || !has_looked(left)) {
            look_through_next(h, {0, 0}, weight, at_head.site);
        }
        const Index across = twin(h);
        if (across != no_index && !has_looked(Surface::next(across))) {
            look_through_previous(across, {length(h), 0}, weight, at_head.site);
        }
    }

    void relax_along(Index v, Index h, ViewKind kind, double distance, Index site) {
        if (!improve(v, distance, site)) return;
        views_[v].half_edge = h;
        views_[v].kind = kind;
    }

    // The neighbours, along the edges; and the shadow of a saddle vertex.
    //
    // \param first  a half-edge from v.
    // \param back   where the path to v comes from, in the frame of `first`, in its face.
    void serve_ring(Index v, const VertexReach& reach, Index first, const Vec2& back) {
        if (first == no_index) return;
        const Vec2 begin(length(first), 0);
        Vec2 spoke = begin;  // h, laid out around v at the origin.
        double side = cross_product(back, spoke);
        int half_turns = 0;
        Wedge shadow{};
        Index h = first;
        do {
            const Corner& corner = corners_[h];
            relax_along(head(h), h, ViewKind::FromTail, reach.distance + corner.length, reach.site);
            const Vec2 next_spoke = turned(spoke, corner.turn);
            const double next_side = cross_product(back, next_spoke);
            if (side > 0 && next_side <= 0 && half_turns++ == 0) {
                shadow.tail = next_spoke;
                shadow.head = spoke;
                shadow.half_edge = twin(Surface::next(h));
            }
            spoke = next_spoke;
            side = next_side;
            const Index previous = Surface::previous(h);
            h = twin(previous);
            if (h == no_index) {
                relax_along(tail(previous), previous, ViewKind::FromHead,
                            reach.distance + length(previous), reach.site);
                serve_clockwise(first, reach);
                return;
            }
        } while (h != first);
        if (half_turns != 1) return;
        // Straight on lies half a turn from `back`, counted from either side; between the two lies
        // what the angle of the cone exceeds 2 pi by. If a neighbour lies there, it will look past
        // itself from v.
        const Vec2 excess(begin.dot(spoke), cross_product(begin, spoke));
        if (!(excess.x() > 0 && excess.y() > least_angle * excess.x())) return;
        shadow.right = -back;
        shadow.left = turned(shadow.right, excess);
        if (cross_product(shadow.left, shadow.tail) <= 0) return;
        shadow.image = {0, 0};
        shadow.weight = reach.distance;
        shadow.site = reach.site;
        trace(shadow, max_shadow_crossings);
    }

    // The part of a boundary vertex's ring that lies clockwise of half-edge h.
    void serve_clockwise(Index h, const VertexReach& reach) {
        while (twin(h) != no_index) {
            h = Surface::next(twin(h));
            relax_along(head(h), h, ViewKind::FromTail, reach.distance + length(h), reach.site);
        }
    }

    // --- Result --------------------------------------------------------------------------------

    Propagation collect() {
        const std::size_t common = reach_.capacity() * sizeof(VertexReach) +
                                   views_.capacity() * sizeof(VertexView) + queue_.bytes();
        const std::size_t in_front = common + surface_.twin.size() * sizeof(Corner);
        corners_.reset();

        Propagation result;
        const VertexRelays relays(surface_, sites_, placement_, reach_, views_);
        result.mixed_faces = relays.mixed_faces();
        result.relay_offsets.reserve(result.mixed_faces.size() + 1);
        result.relays.reserve(relays_per_face * result.mixed_faces.size());
        for (const Index face : result.mixed_faces) {
            result.relay_offsets.push_back(static_cast<Index>(result.relays.size()));
            relays.collect(face, result.relays);
        }
        result.relay_offsets.push_back(static_cast<Index>(result.relays.size()));

        result.vertex_site.reserve(reach_.size());
        result.vertex_distance.reserve(reach_.size());
        for (const VertexReach& reach : reach_) {
            result.vertex_site.push_back(SiteId(reach.site));
            result.vertex_distance.push_back(reach.distance);
            if (reach.site != no_index) ++result.num_nodes;
        }
        const std::size_t in_result =
            result.relays.capacity() * sizeof(Relay) +
            (result.mixed_faces.capacity() + result.relay_offsets.capacity()) * sizeof(Index) +
            result.vertex_site.capacity() * sizeof(SiteId) +
            result.vertex_distance.capacity() * sizeof(double);
        result.peak_bytes = std::max(in_front, common + in_result);
        return result;
    }

    static constexpr std::size_t relays_per_face = 5;  // Seldom exceeded on average.

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    const PropagationOptions& options_;
    SitePlacement placement_;
    std::unique_ptr<Corner[]> corners_;  // #H
    std::vector<VertexReach> reach_;     // #V
    std::vector<VertexView> views_;      // #V
    BucketQueue queue_;
};

}  // namespace

Propagation propagate_vertices(const Surface& surface, std::span<const SurfacePoint> sites,
                               const PropagationOptions& options) {
    return VertexFront(surface, sites, options).run();
}

}  // namespace agvd
