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

#include "agvd/propagation/corners.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/vertex_relays.h"
#include "agvd/propagation/vertex_views.h"
#include "agvd/propagation/window/bucket_queue.h"

namespace agvd {
namespace {

// A chord that passes outside a wedge by at most this angle counts as inside. The path bends by at
// most the angle, and its length is too short by the square of it.
constexpr double angle_tolerance = 1e-7;
// The parts of a wedge at a vertex that are narrower than this angle are dropped: they would hardly
// meet another vertex.
constexpr double least_width = 2e-2;
// A wedge passes a vertex that has a nearer source if the wedge is the nearest, up to this share of
// its distance, at an end of the edge that it crosses.
constexpr double lead_tolerance = 1e-6;
// The number of faces that a wedge crosses in search of a vertex. More faces give more accurate
// distances where sites are far apart: with 30 and narrower wedges, a tenth of the error on 70k
// faces with 100 sites, in three times the time.
constexpr int max_crossings = 8;
// The same for the shadow behind a saddle vertex. In most cases it is too narrow to meet another
// vertex than the next one.
constexpr int max_shadow_crossings = 2;
// Width of the queue's buckets in mean edge lengths.
constexpr double bucket_share = 0.4;
// How many nodes ahead are loaded.
constexpr Index look_ahead = 8;

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
    VertexFront(const Surface& surface, const Corners& corners, std::span<const SurfacePoint> sites,
                const PropagationOptions& options)
        : surface_(surface),
          sites_(sites),
          options_(options),
          placement_(surface, sites),
          corners_(corners),
          reach_(surface.num_vertices()),
          views_(surface.num_vertices()),
          queue_(1 / bucket_width(surface, corners)) {}

    Propagation run() {
        for (Index s = 0; s < sites_.size(); ++s) start(s);
        std::size_t served = 0;
        while (!queue_.empty()) {
            const Index v = queue_.pop();
            prefetch();
            if (!queue_.take(reach_[v].queued_in)) continue;
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

    static double bucket_width(const Surface& surface, const Corners& corners) {
        const double mean = corners.mean_length();
        return std::max({bucket_share * mean, mean * surface.num_edges() * 0x1p-24,
                         std::numeric_limits<double>::min()});
    }

    // Loads the next nodes, which may lie anywhere in memory.
    [[gnu::always_inline]] void prefetch() const {
        if (const Index* const v = queue_.peek(look_ahead)) {
            __builtin_prefetch(&reach_[*v]);
            __builtin_prefetch(&views_[*v]);
        }
        const auto face_of = [&](Index ahead) {
            const Index* const v = queue_.peek(ahead);
            const Index h = v == nullptr ? no_index : views_[*v].half_edge;
            return h == no_index ? no_index : Surface::face(h);
        };
        if (const Index face = face_of(look_ahead / 2); face != no_index) corners_.prefetch(face);
        if (const Index face = face_of(look_ahead / 4); face != no_index) {
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                const Index twin = corners_.twin(h);
                if (twin != no_index) corners_.prefetch(Surface::face(twin));
                __builtin_prefetch(&reach_[corners_.tail(h)]);
            }
        }
    }

    // --- Wedges --------------------------------------------------------------------------------

    [[nodiscard]] bool improve(Index v, double distance, Index site) {
        VertexReach& reach = reach_[v];
        if (!is_nearer(distance, site, reach.distance, reach.site)) return false;
        reach.distance = distance;
        reach.site = site;
        queue_.push(v, distance, reach.queued_in);
        return true;
    }

    [[nodiscard]] Wedge wedge_of(const VertexView& view, Index site) const {
        return {{0, 0},
                {corners_.length(view.half_edge), 0},
                view.image,
                direction(view.left),
                direction(view.right),
                view.weight,
                site,
                view.half_edge};
    }

    [[nodiscard]] VertexView view_of(const Wedge& w) const {
        const Vec2 axis = (w.head - w.tail) / corners_.length(w.half_edge);
        return {
            turned_back(w.image - w.tail, axis), w.weight,    rounded(turned_back(w.left, axis)),
            rounded(turned_back(w.right, axis)), w.half_edge, ViewKind::Window};
    }

    [[nodiscard]] Vec2 apex_of(const Wedge& w) const {
        return w.tail + turned(w.head - w.tail, corners_[w.half_edge].turn);
    }

    // Whether the wedge of a vertex that has just got another view still waited there. Such a wedge
    // must be traced on.
    [[nodiscard]] static bool has_waited(const VertexReach& before, const VertexView& loser) {
        return before.queued_in != no_index && loser.kind == ViewKind::Window;
    }

    // Lays out faces until the wedge meets a vertex that it improves. If the wedge of that vertex
    // still waited, it is traced on.
    void trace(Wedge w, int crossings) {
        for (; crossings > 0 && w.half_edge != no_index; --crossings) {
            const Index h = w.half_edge;
            const Vec2 apex = apex_of(w);
            const Vec2 chord = apex - w.image;
            if (cross_product(w.right, chord) < -angle_tolerance * w.right.dot(chord)) {
                w.head = apex;
                w.half_edge = corners_.twin(Surface::previous(h));
                continue;
            }
            if (cross_product(chord, w.left) < -angle_tolerance * w.left.dot(chord)) {
                w.tail = apex;
                w.half_edge = corners_.twin(Surface::next(h));
                continue;
            }
            const Index v = corners_.apex_vertex(h);
            const VertexReach before = reach_[v];
            if (improve(v, w.weight + chord.norm(), w.site)) {
                const VertexView loser = views_[v];
                views_[v] = view_of(w);
                if (!has_waited(before, loser)) return;
                w = wedge_of(loser, before.site);
            }
            if (!pass(w, crossings)) return;
        }
    }

    // Improves a vertex by a view that is not a wedge.
    void overtake(Index v, double distance, Index site, const VertexView& view) {
        const VertexReach before = reach_[v];
        if (!improve(v, distance, site)) return;
        const VertexView loser = views_[v];
        views_[v] = view;
        if (!has_waited(before, loser)) return;
        Wedge w = wedge_of(loser, before.site);
        if (pass(w, max_crossings)) trace(w, max_crossings - 1);
    }

    // The apex of the face has a nearer source. Beyond it the wedge keeps the sides on which it is
    // the nearest. If these are two, the right one is traced here. False if there is none.
    [[nodiscard]] bool pass(Wedge& w, int crossings) {
        const Vec2 apex = apex_of(w);
        const auto leads_at = [&](const Vec2& end, Index vertex) {
            const double bound = w.weight + (end - w.image).norm();
            return bound * (1 - lead_tolerance) <= reach_[vertex].distance;
        };
        const bool on_left = leads_at(w.tail, corners_.tail(w.half_edge));
        const bool on_right = leads_at(w.head, corners_.head(w.half_edge));
        if (!on_left) return on_right && keep_right(w, apex);
        if (on_right) {
            Wedge right = w;
            if (keep_right(right, apex)) trace(right, crossings - 1);
        }
        return keep_left(w, apex);
    }

    // Keeps the part left of the apex, about to leave the face. False if it is too narrow.
    [[nodiscard]] bool keep_left(Wedge& w, const Vec2& apex) const {
        const Vec2 chord = apex - w.image;
        if (!(cross_product(chord, w.left) > least_width * w.left.dot(chord))) return false;
        w.right = chord;
        w.head = apex;
        w.half_edge = corners_.twin(Surface::previous(w.half_edge));
        return true;
    }

    [[nodiscard]] bool keep_right(Wedge& w, const Vec2& apex) const {
        const Vec2 chord = apex - w.image;
        if (!(cross_product(w.right, chord) > least_width * w.right.dot(chord))) return false;
        w.left = chord;
        w.tail = apex;
        w.half_edge = corners_.twin(Surface::next(w.half_edge));
        return true;
    }

    // Traces all that a point of the face of h sees through an edge. `out`: the half-edge of that
    // edge in the face beyond, from `tail` to `head`. Coordinates are in the frame of h.
    void look_through(Index out, const Vec2& tail, const Vec2& head, const Vec2& point,
                      double weight, Index site) {
        trace({tail, head, point, tail - point, head - point, weight, site, out}, max_crossings);
    }
    void look_through_next(Index h, const Vec2& point, double weight, Index site) {
        look_through(corners_.twin(Surface::next(h)), corners_.apex(h), {corners_.length(h), 0},
                     point, weight, site);
    }
    void look_through_previous(Index h, const Vec2& point, double weight, Index site) {
        look_through(corners_.twin(Surface::previous(h)), {0, 0}, corners_.apex(h), point, weight,
                     site);
    }

    // --- Sites ---------------------------------------------------------------------------------

    void start(Index s) {
        const SurfacePoint& site = sites_[s];
        if (const auto vertex = vertex_of(surface_, site)) {
            overtake(*vertex, 0, s, {});
            return;
        }
        serve_face(site.face.value(), s, site);
        const auto half_edge = half_edge_of(site);
        if (half_edge && corners_.twin(*half_edge) != no_index) {
            serve_face(Surface::face(corners_.twin(*half_edge)), s,
                       across_edge(surface_, site, *half_edge));
        }
    }

    void serve_face(Index face, Index site, const SurfacePoint& point) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Vec2 image = position_in_frame(surface_, point, h);
            const Index v = corners_.apex_vertex(h);
            overtake(v, (corners_.apex(h) - image).norm(), site,
                     {image, 0, {}, {}, h, ViewKind::Face});
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
                serve_ring(reach, surface_.outgoing[v], {0, 0});
                break;
            case ViewKind::Window: {
                const Vec2 apex = corners_.apex(h);
                Wedge left = wedge_of(view, reach.site);
                if (keep_left(left, apex)) trace(left, max_crossings);
                Wedge right = wedge_of(view, reach.site);
                if (keep_right(right, apex)) trace(right, max_crossings);
                [[fallthrough]];
            }
            case ViewKind::Face:
                serve_ring(reach, Surface::previous(h),
                           turned_back(view.image - corners_.apex(h), -corners_.apex(h)));
                break;
            case ViewKind::FromTail:
                look_past_head(h, reach);
                serve_ring(reach,
                           corners_.twin(h) != no_index ? corners_.twin(h) : Surface::next(h),
                           {1, 0});
                break;
            case ViewKind::FromHead:
                look_through_previous(h, {corners_.length(h), 0},
                                      reach.distance - corners_.length(h), reach.site);
                serve_ring(reach, h, {1, 0});
                break;
        }
    }

    // Traces what the tail of h sees beside the head, through the edges opposite to it in the two
    // faces at h. The neighbour at the other end of such an edge may have traced that already.
    void look_past_head(Index h, const VertexReach& at_head) {
        const auto has_looked = [&](Index spoke) {
            const Index v = corners_.head(spoke);
            return views_[v].half_edge == spoke && views_[v].kind == ViewKind::FromTail &&
                   reach_[v].queued_in == no_index;
        };
        const double weight = at_head.distance - corners_.length(h);
        const Index left = corners_.twin(Surface::previous(h));
        if (left == no_index || !has_looked(left)) {
            look_through_next(h, {0, 0}, weight, at_head.site);
        }
        const Index across = corners_.twin(h);
        if (across != no_index && !has_looked(Surface::next(across))) {
            look_through_previous(across, {corners_.length(h), 0}, weight, at_head.site);
        }
    }

    void relax_along(Index v, Index h, ViewKind kind, double distance, Index site) {
        overtake(v, distance, site, {{0, 0}, 0, {}, {}, h, kind});
    }

    // Serves the neighbours along the edges, and the shadow of a saddle vertex.
    //
    // \param first  a half-edge from the vertex.
    // \param back   towards where the path to the vertex comes from, in the frame of `first`.
    void serve_ring(const VertexReach& reach, Index first, const Vec2& back) {
        if (first == no_index) return;
        const Vec2 begin(corners_.length(first), 0);
        Vec2 spoke = begin;  // The half-edge h, laid out around the vertex at the origin.
        double side = cross_product(back, spoke);
        int half_turns = 0;
        // The edges on both sides of the way straight on, and the half-edge on its right.
        Vec2 right_of_ahead(0, 0), left_of_ahead(0, 0);
        Index ahead = no_index;
        Index h = first;
        do {
            const Corner& corner = corners_[h];
            relax_along(corners_.head(h), h, ViewKind::FromTail, reach.distance + corner.length,
                        reach.site);
            const Vec2 next_spoke = turned(spoke, corner.turn);
            const double next_side = cross_product(back, next_spoke);
            if (side > 0 && next_side <= 0 && half_turns++ == 0) {
                right_of_ahead = spoke;
                left_of_ahead = next_spoke;
                ahead = h;
            }
            spoke = next_spoke;
            side = next_side;
            const Index previous = Surface::previous(h);
            h = corners_.twin(previous);
            if (h == no_index) {
                relax_along(corners_.tail(previous), previous, ViewKind::FromHead,
                            reach.distance + corners_.length(previous), reach.site);
                serve_clockwise(first, reach);
                return;
            }
        } while (h != first);
        if (half_turns != 1) return;
        // The way straight on lies half a turn from `back`, counted from either side. At a saddle
        // vertex these are two ways, with the excess of the angle over 2 pi between them. If a
        // neighbour lies between them, look_past_head() will serve what lies behind the neighbour.
        const Vec2 excess(begin.dot(spoke), cross_product(begin, spoke));
        if (!(excess.x() > 0 && excess.y() > angle_tolerance * excess.x())) return;
        const Vec2 right = -back.normalized();  // Unit vectors, since a view stores floats.
        const Vec2 left = turned(right, excess.normalized());
        if (cross_product(left, left_of_ahead) <= 0) return;
        trace({left_of_ahead, right_of_ahead, Vec2(0, 0), left, right, reach.distance, reach.site,
               corners_.twin(Surface::next(ahead))},
              max_shadow_crossings);
    }

    // Serves the part of a boundary vertex's ring that lies clockwise of half-edge h.
    void serve_clockwise(Index h, const VertexReach& reach) {
        while (corners_.twin(h) != no_index) {
            h = Surface::next(corners_.twin(h));
            relax_along(corners_.head(h), h, ViewKind::FromTail,
                        reach.distance + corners_.length(h), reach.site);
        }
    }

    // --- Result --------------------------------------------------------------------------------

    Propagation collect() {
        Propagation result;
        const VertexRelays relays(surface_, sites_, placement_, corners_, reach_, views_);
        result.mixed_faces = relays.mixed_faces();
        const std::size_t num_mixed = result.mixed_faces.size();
        result.relay_ranges.reserve(num_mixed);
        result.relays.reserve(relays_per_face * num_mixed);
        for (std::size_t i = 0; i < num_mixed; ++i) {
            if (i + look_ahead < num_mixed) relays.prefetch(result.mixed_faces[i + look_ahead]);
            const auto begin = static_cast<Index>(result.relays.size());
            relays.collect(result.mixed_faces[i], result.relays);
            result.relay_ranges.push_back({begin, static_cast<Index>(result.relays.size())});
        }

        result.vertex_site.reserve(reach_.size());
        result.vertex_distance.reserve(reach_.size());
        for (const VertexReach& reach : reach_) {
            result.vertex_site.push_back(SiteId(reach.site));
            result.vertex_distance.push_back(reach.distance);
            if (reach.site != no_index) ++result.num_nodes;
        }
        result.peak_bytes = corners_.bytes() + reach_.capacity() * sizeof(VertexReach) +
                            views_.capacity() * sizeof(VertexView) + queue_.bytes() +
                            result.relays.capacity() * sizeof(Relay) +
                            result.mixed_faces.capacity() * sizeof(Index) +
                            result.relay_ranges.capacity() * sizeof(RelayRange) +
                            result.vertex_site.capacity() * sizeof(SiteId) +
                            result.vertex_distance.capacity() * sizeof(double);
        return result;
    }

    static constexpr std::size_t relays_per_face = 3;  // An average that is seldom exceeded.

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    const PropagationOptions& options_;
    SitePlacement placement_;
    const Corners& corners_;
    std::vector<VertexReach> reach_;  // #V
    std::vector<VertexView> views_;   // #V
    BucketQueue<Index> queue_;
};

}  // namespace

Propagation propagate_vertices(const Surface& surface, const Corners& corners,
                               std::span<const SurfacePoint> sites,
                               const PropagationOptions& options) {
    return VertexFront(surface, corners, sites, options).run();
}

}  // namespace agvd
