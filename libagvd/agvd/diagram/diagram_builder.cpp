#include "agvd/diagram/diagram_builder.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/diagram/label_edges.h"
#include "agvd/mesh/one_ring.h"

namespace agvd {

class DiagramBuilder::Run {
public:
    Run(const Surface& surface, const DiagramOptions& options, Kept& kept,
        std::span<const SurfacePoint> sites, const Propagation& propagation, TouchedParts touched)
        : surface_(surface),
          options_(options),
          kept_(kept),
          labels_(kept.labels),
          arcs_(kept.arcs),
          tally_(kept.tally),
          sites_(sites),
          propagation_(propagation),
          touched_(std::move(touched)) {}

    void run(Diagram& diagram) {
        const SitePlacement placement(surface_, sites_);
        tally_.resize(static_cast<Index>(sites_.size()));
        begin_labels();
        settle_vertices();
        count_unlisted_faces();
        const std::vector<Index> candidates = mixed_candidates();
        RelayGroups groups = group_relays(candidates);
        label_edges(surface_, propagation_, groups, candidates, options_.num_threads, poller_,
                    touched_, labels_, tally_);
        const std::vector<Index> mixed = touched_.is_all() ? candidates : clear_stale();
        cut_faces(surface_, propagation_, placement, groups, mixed, options_.num_threads, poller_,
                  labels_);
        count_cuts_in(mixed);
        poller_.tell(0.5);
        trace(mixed, groups);
        poller_.tell(0.9);
        kept_.joiner.join(labels_, arcs_, faces_at(mixed), Ticker(poller_));
        absorb_all_islands(groups);
        if (touched_.is_all()) {
            Diagram whole;
            write(Ticker(poller_), whole);
            diagram = std::move(whole);
        } else {
            write({}, diagram);  // Nothing throws.
        }
    }

private:
    void write(Ticker ticker, Diagram& diagram) {
        diagram.num_sites = static_cast<Index>(sites_.size());
        kept_.joiner.draw(surface_, labels_, arcs_, ticker, diagram);
        tally_.write(diagram);
        set_nearest(diagram);
    }

    void set_nearest(Diagram& diagram) {
        if (std::exchange(kept_.is_renumbered, false) || touched_.is_all()) {
            diagram.nearest_distance = labels_.vertex_distance;
            diagram.nearest_site.clear();
            diagram.nearest_site.reserve(surface_.num_vertices());
            for (Index v = 0; v < surface_.num_vertices(); ++v) {
                diagram.nearest_site.push_back(SiteId(labels_.point_site[v]));
            }
            return;
        }
        for (const Index v : touched_.vertices()) {
            diagram.nearest_distance[v] = labels_.vertex_distance[v];
            diagram.nearest_site[v] = SiteId(labels_.point_site[v]);
        }
        for (const Index v : relabelled_) diagram.nearest_site[v] = SiteId(labels_.point_site[v]);
    }

    [[nodiscard]] std::vector<Index> all_mixed() const {
        std::vector<Index> all(propagation_.mixed_faces.size());
        std::iota(all.begin(), all.end(), Index{0});
        return all;
    }

    // The places of the listed ones.
    [[nodiscard]] std::vector<Index> places_of(std::span<const Index> faces) const {
        std::vector<Index> places;
        for (const Index face : faces) {
            if (labels_.mixed_index[face] != no_index) places.push_back(labels_.mixed_index[face]);
        }
        return places;
    }

    [[nodiscard]] std::vector<Index> faces_at(std::span<const Index> mixed) const {
        std::vector<Index> faces;
        faces.reserve(mixed.size());
        for (const Index i : mixed) faces.push_back(propagation_.mixed_faces[i]);
        return faces;
    }

    // Lists the mixed faces. Labels are as they were before islands were absorbed.
    void begin_labels() {
        if (touched_.is_all()) labels_.edge_rows.assign(surface_.num_edges(), {});
        for (auto old = kept_.absorbed.rbegin(); old != kept_.absorbed.rend(); ++old) {
            const Index site = std::exchange(labels_.point_site[old->point], old->site);
            count_relabelled(old->point, site);
        }
        kept_.absorbed.clear();
        old_labels_.reserve(touched_.faces().size());
        for (const Index face : touched_.faces()) old_labels_.push_back(label_of(face));
        list_mixed_faces(surface_, propagation_, labels_);
    }

    // A vertex that islands gave another label, or that has its own again.
    void count_relabelled(Index v, Index old_site) {
        relabelled_.push_back(v);
        const Index site = labels_.point_site[v];
        tally_.count_vertex(v, old_site, -1);
        tally_.count_vertex(v, site, 1);
        for_each_outgoing(surface_, v, [&](Index h) {
            const Index face = Surface::face(h);
            const bool is_unlisted = labels_.mixed_index[face] == no_index;
            if (!is_unlisted || h % 3 != 0) return;  // At its first corner: once a face.
            tally_.count_face(face, old_site, -1);
            tally_.count_face(face, site, 1);
        });
    }

    // Of an unlisted face; no_index: it is listed.
    [[nodiscard]] Index label_of(Index face) const {
        return labels_.mixed_index[face] == no_index
                   ? labels_.point_site[surface_.mesh.triangles[face][0]]
                   : no_index;
    }

    // The touched ones.
    void count_unlisted_faces() {
        for (Index i = 0; i < old_labels_.size(); ++i) {
            const Index face = touched_.faces()[i];
            const Index label = label_of(face);
            if (label == old_labels_[i]) continue;
            tally_.count_face(face, old_labels_[i], -1);
            tally_.count_face(face, label, 1);
        }
        Ticker ticker(poller_);
        for (Index f = 0; touched_.is_all() && f < surface_.num_faces(); ++f) {
            ticker.tick();
            tally_.count_face(f, label_of(f), 1);
        }
    }

    // Labels the touched vertices and finds out which of them are as they were.
    void settle_vertices() {
        std::vector<Nearest> before;
        before.reserve(touched_.vertices().size());
        for (const Index v : touched_.vertices()) {
            before.push_back({labels_.point_site[v], labels_.vertex_distance[v]});
        }
        label_vertices(surface_, propagation_, touched_,
                       touched_.is_all() ? all_mixed() : places_of(touched_.faces()),
                       options_.num_threads, poller_, labels_);
        for (Index i = 0; i < before.size(); ++i) {
            const Index v = touched_.vertices()[i];
            const auto& [site, distance] = before[i];
            if (labels_.point_site[v] != site) {
                tally_.count_vertex(v, site, -1);
                tally_.count_vertex(v, labels_.point_site[v], 1);
            } else if (labels_.vertex_distance[v] == distance) {
                touched_.clear_vertex(v);
            }
        }
        if (touched_.is_all()) tally_.count_vertices(labels_.point_site);
    }

    // The places of the faces that may have other arcs.
    [[nodiscard]] std::vector<Index> mixed_candidates() const {
        if (touched_.is_all()) return all_mixed();
        std::vector<Index> faces;
        for (const Index face : touched_.faces()) {
            if (!touched_.holds_on_edges_of(face)) faces.push_back(face);
        }
        return places_of(faces);
    }

    // Takes out the arcs that do not hold, and returns the places of the faces that want others.
    [[nodiscard]] std::vector<Index> clear_stale() {
        std::vector<Index> stale;
        for (const Index face : touched_.faces()) {
            if (!holds_in_face(face)) stale.push_back(face);
        }
        for (std::size_t i = 0; i < stale.size(); ++i) {
            constexpr std::size_t ahead = 4;
            for (int step = 0; step < 3; ++step) {
                const std::size_t later = i + ahead * (3 - step);
                if (later < stale.size()) arcs_.prefetch(stale[later], step);
            }
            clear_arcs(stale[i]);
        }
        std::erase_if(labels_.cut_faces, [&](const CutFace& cut) {
            if (holds_in_face(cut.face)) return false;
            count_cuts(cut, -1);
            release_cut(cut, surface_.num_vertices(), labels_);
            return true;
        });
        return places_of(stale);
    }

    [[nodiscard]] bool holds_in_face(Index face) const {
        return touched_.holds_in_face(face, arcs_.of_face(face).is_local);
    }

    void clear_arcs(Index face) {
        kept_.joiner.forget(arcs_, face);
        tally_.count_parts(arcs_.parts()[arcs_.of_face(face).parts], -1);
        arcs_.remove(face);
    }

    void count_cuts_in(std::span<const Index> mixed) {
        for (const CutFace& cut : labels_.cut_faces) {
            const Index place = labels_.mixed_index[cut.face];
            if (std::binary_search(mixed.begin(), mixed.end(), place)) count_cuts(cut, 1);
        }
    }

    void count_cuts(const CutFace& face, int sign) {
        for (const InnerPoint& point : std::as_const(labels_.inner_points)[face.inner_points]) {
            tally_.count_inner_point(point, sign);
        }
        for (const Cut& cut : std::as_const(labels_.cuts)[face.cuts]) {
            tally_.count_cut(std::as_const(labels_.crossings)[cut.row],
                             labels_.point_site[cut.to.point], sign);
        }
    }

    // For labelling and tracing these faces.
    [[nodiscard]] RelayGroups group_relays(std::span<const Index> mixed) {
        if (touched_.is_all()) return {propagation_, mixed, options_.num_threads, poller_};
        std::vector<Index> faces = faces_at(mixed);
        for (const Index i : mixed) {
            const Index first = 3 * propagation_.mixed_faces[i];
            for (Index h = first; h < first + 3; ++h) {
                if (surface_.twin[h] != no_index) faces.push_back(Surface::face(surface_.twin[h]));
            }
        }
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        return {propagation_, places_of(faces), options_.num_threads, poller_};
    }

    // Faces come in lots, so that what is traced is stored while it is in the cache.
    void trace(std::span<const Index> mixed, const RelayGroups& groups) {
        constexpr Index most = 64 * grain;
        std::vector<FaceArcs> chunks(num_chunks(most, grain));
        const bool is_first = arcs_.is_empty();
        for (std::size_t begin = 0; begin < mixed.size(); begin += most) {
            const auto some =
                mixed.subspan(begin, std::min<std::size_t>(most, mixed.size() - begin));
            const auto trace_chunk = [&](Index chunk, Index first, Index last) {
                trace_faces(surface_, propagation_, groups, labels_, options_.chord_tolerance,
                            some.subspan(first, last - first), Ticker(poller_), chunks[chunk]);
            };
            parallel_chunks(static_cast<Index>(some.size()), grain, options_.num_threads,
                            trace_chunk, poller_);
            poller_.poll();
            // Places that were released are for one face at a time.
            store(faces_at(some), chunks, is_first ? grain : 1);
            if (begin == 0 && is_first) {
                arcs_.reserve_for(static_cast<double>(mixed.size()) / most);
            }
        }
    }

    void store(std::span<const Index> faces, std::span<const FaceArcs> chunks, Index step) {
        for (Index i = 0; i < faces.size(); i += step) {
            const auto some = faces.subspan(i, std::min<std::size_t>(step, faces.size() - i));
            arcs_.add(some, chunks[i / grain], i % grain);
            for (const Index face : some) {
                tally_.count_parts(arcs_.parts()[arcs_.of_face(face).parts], 1);
            }
        }
    }

    void absorb_all_islands(RelayGroups& groups) {
        kept_.mended_faces.clear();
        find_displaced(surface_, sites_, labels_, touched_, kept_.displaced);
        while (true) {
            poller_.poll();
            CellSet asked = tally_.take_changed();
            asked.insert(kept_.in_doubt);
            kept_.in_doubt = cells_in_doubt(
                kept_.displaced, kept_.joiner.count_loops(surface_, labels_, arcs_, asked));
            const CellSet& in_doubt = kept_.in_doubt;
            if (in_doubt.is_empty()) return;
            const std::vector<Index> faces = faces_of_cells(
                surface_, labels_, arcs_, in_doubt, kept_.joiner.faces_beside(arcs_, in_doubt));
            const std::size_t num_before = kept_.absorbed.size();
            std::vector<Index> stale;
            if (absorb_islands(surface_, sites_, arcs_, in_doubt, faces, labels_, tally_,
                               kept_.absorbed, stale) == 0) {
                return;
            }
            for (const OldLabel& old : std::span(kept_.absorbed).subspan(num_before)) {
                count_relabelled(old.point, old.site);
            }
            std::sort(stale.begin(), stale.end());
            stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
            const std::vector<Index> mixed = places_of(stale);
            stale = faces_at(mixed);
            for (const Index face : stale) clear_arcs(face);
            if (!touched_.is_all()) groups = group_relays(mixed);
            trace(mixed, groups);
            kept_.joiner.join(labels_, arcs_, stale, Ticker(poller_));
            kept_.mended_faces.insert(kept_.mended_faces.end(), stale.begin(), stale.end());
        }
    }

    static constexpr Index grain = 128;  // Faces that are traced by one task.

    const Surface& surface_;
    const DiagramOptions& options_;
    Poller poller_{options_.progress};
    Kept& kept_;
    EdgeLabels& labels_;
    ArcStore& arcs_;
    CellTally& tally_;
    std::span<const SurfacePoint> sites_;
    const Propagation& propagation_;
    TouchedParts touched_;
    std::vector<Index> old_labels_;  // Of the touched faces.
    std::vector<Index> relabelled_;  // Vertices, by islands that came and went.
};

DiagramBuilder::DiagramBuilder(const Surface& surface, DiagramOptions options)
    : surface_(surface), options_(std::move(options)) {}

void DiagramBuilder::build(std::span<const SurfacePoint> sites, const Propagation& propagation,
                           std::span<const Index> changed_faces, Diagram& diagram) {
    std::optional<Kept> kept = std::exchange(kept_, {});  // None after a call that throws.
    poll(options_.progress, 0);
    if (!kept || kept->arcs.is_wasteful() || kept->labels.is_wasteful()) {
        kept.emplace(surface_);
        Run(surface_, options_, *kept, sites, propagation, TouchedParts(surface_)).run(diagram);
    } else {
        std::vector<Index> faces(changed_faces.begin(), changed_faces.end());
        faces.insert(faces.end(), kept->mended_faces.begin(), kept->mended_faces.end());
        Run(surface_, options_, *kept, sites, propagation, TouchedParts(surface_, faces))
            .run(diagram);
    }
    kept_ = std::move(kept);
}

void DiagramBuilder::renumber(const Renumbering& renumbering) {
    if (!kept_) return;
    kept_->labels.renumber(renumbering);
    kept_->arcs.renumber(renumbering);
    kept_->joiner.renumber(renumbering);
    kept_->tally.renumber(renumbering);
    kept_->displaced.renumber(renumbering);
    kept_->in_doubt.renumber(renumbering);
    for (OldLabel& old : kept_->absorbed) renumbering.apply(old.site);
    kept_->is_renumbered = true;
}

}  // namespace agvd
