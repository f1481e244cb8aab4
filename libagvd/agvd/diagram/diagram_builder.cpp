#include "agvd/diagram/diagram_builder.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/diagram/cell_measures.h"

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
          sites_(sites),
          propagation_(propagation),
          touched_(std::move(touched)),
          asked_(static_cast<Index>(sites.size()), touched_.is_all()) {}

    void run(Diagram& diagram) {
        const SitePlacement placement(surface_, sites_);
        if (touched_.is_all()) labels_.edge_rows.assign(surface_.num_edges(), {});
        list_mixed_faces(surface_, propagation_, labels_);
        settle_vertices();
        const std::vector<Index> mixed = touched_.is_all() ? all_mixed() : clear_touched();
        RelayGroups groups = group_relays(mixed);
        label_edges(surface_, propagation_, groups, touched_, mixed, options_.num_threads,
                    labels_);
        cut_faces(surface_, propagation_, placement, groups, mixed, options_.num_threads, labels_);
        poll(options_.progress, 0.5);
        trace(mixed, groups);
        if (!touched_.is_all()) {
            for (const Index face : new_faces_) asked_.insert_those_in(face, arcs_);
        }
        FaceList faces = faces_of(asked_);
        absorb_all_islands(faces, groups);
        poll(options_.progress, 0.9);

        diagram.num_sites = static_cast<Index>(sites_.size());
        kept_.joiner.join(surface_, labels_, arcs_, propagation_.mixed_faces, new_faces_, diagram);
        measure_cells(surface_, labels_, arcs_, faces, asked_, diagram);
        diagram.nearest_site.clear();
        diagram.nearest_site.reserve(surface_.num_vertices());
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            diagram.nearest_site.push_back(SiteId(labels_.point_site[v]));
        }
        diagram.nearest_distance = labels_.vertex_distance;
    }

private:
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

    // Labels the touched vertices and finds out which of them are as they were.
    void settle_vertices() {
        for (auto old = kept_.absorbed.rbegin(); old != kept_.absorbed.rend(); ++old) {
            asked_.insert(std::exchange(labels_.point_site[old->point], old->site));
            asked_.insert(old->site);
        }
        kept_.absorbed.clear();
        std::vector<Nearest> before;
        before.reserve(touched_.vertices().size());
        for (const Index v : touched_.vertices()) {
            before.push_back({labels_.point_site[v], labels_.vertex_distance[v]});
        }
        label_vertices(surface_, propagation_, touched_,
                       touched_.is_all() ? all_mixed() : places_of(touched_.faces()),
                       options_.num_threads, labels_);
        for (Index i = 0; i < before.size(); ++i) {
            const Index v = touched_.vertices()[i];
            const auto& [site, distance] = before[i];
            if (labels_.point_site[v] == site && labels_.vertex_distance[v] == distance) {
                touched_.clear_vertex(v);
            } else {
                asked_.insert(site);
                asked_.insert(labels_.point_site[v]);
            }
        }
    }

    // Takes out what does not hold, and returns the places of the faces that want it anew.
    [[nodiscard]] std::vector<Index> clear_touched() {
        std::vector<Index> stale;
        for (const Index face : touched_.faces()) {
            if (touched_.holds_in_face(face)) continue;
            stale.push_back(face);
            clear_arcs(face, asked_);
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                if (touched_.holds_on_edge(h)) continue;
                labels_.crossings.release(std::exchange(labels_.edge_rows[surface_.edge[h]], {}));
            }
        }
        std::erase_if(labels_.cut_faces, [&](const CutFace& cut) {
            if (touched_.holds_in_face(cut.face)) return false;
            release_cut(cut, surface_.num_vertices(), labels_);
            return true;
        });
        return places_of(stale);
    }

    void clear_arcs(Index face, CellSet& asked) {
        asked.insert_those_in(face, arcs_);
        kept_.joiner.forget(arcs_, face);
        arcs_.remove(face);
    }

    // Cells differ from what they were, and have parts that hang together with nothing else of
    // them, next to touched faces and to those that were mended.
    [[nodiscard]] FaceList faces_of(const CellSet& cells) const {
        if (touched_.is_all()) return FaceList(surface_.num_faces());
        std::vector<Index> seeds = touched_.faces();
        seeds.insert(seeds.end(), kept_.mended_faces.begin(), kept_.mended_faces.end());
        return {surface_, labels_, arcs_, cells, seeds};
    }

    // For labelling and tracing these faces.
    [[nodiscard]] RelayGroups group_relays(std::span<const Index> mixed) const {
        std::vector<std::uint8_t> is_needed;
        if (!touched_.is_all()) {
            is_needed.assign(propagation_.mixed_faces.size(), 0);
            for (const Index i : mixed) {
                is_needed[i] = 1;
                const Index first = 3 * propagation_.mixed_faces[i];
                for (Index h = first; h < first + 3; ++h) {
                    const Index twin = surface_.twin[h];
                    if (twin == no_index) continue;
                    const Index beside = labels_.mixed_index[Surface::face(twin)];
                    if (beside != no_index) is_needed[beside] = 1;
                }
            }
        }
        return {propagation_, is_needed, options_.num_threads};
    }

    void trace(std::span<const Index> mixed, const RelayGroups& groups) {
        constexpr Index grain = 128;
        const auto count = static_cast<Index>(mixed.size());
        std::vector<FaceArcs> chunks(num_chunks(count, grain));
        parallel_chunks(count, grain, options_.num_threads,
                        [&](Index chunk, Index begin, Index end) {
                            chunks[chunk] = trace_faces(surface_, propagation_, groups, labels_,
                                                        options_.chord_tolerance,
                                                        mixed.subspan(begin, end - begin));
                        });
        const bool is_first = touched_.is_all() && new_faces_.empty();
        if (is_first) arcs_.reserve(chunks);
        const std::vector<Index> faces = faces_at(mixed);
        // Places that were released are for one face at a time.
        const Index step = is_first ? grain : 1;
        for (Index i = 0; i < count; i += step) {
            FaceArcs& chunk = chunks[i / grain];
            arcs_.add(std::span(faces).subspan(i, std::min(step, count - i)), chunk, i % grain);
            if (is_first) chunk = {};
        }
        std::vector<Index> all;
        std::set_union(faces.begin(), faces.end(), new_faces_.begin(), new_faces_.end(),
                       std::back_inserter(all));
        new_faces_ = std::move(all);
    }

    [[nodiscard]] std::vector<Index> faces_at(std::span<const Index> mixed) const {
        std::vector<Index> faces;
        faces.reserve(mixed.size());
        for (const Index i : mixed) faces.push_back(propagation_.mixed_faces[i]);
        return faces;
    }

    // \param faces  of the cells asked for, before and after.
    void absorb_all_islands(FaceList& faces, RelayGroups& groups) {
        kept_.mended_faces.clear();
        CellSet asked = asked_;
        FaceList faces_of_round = faces;
        std::vector<Index> stale;
        while (absorb_islands(surface_, sites_, arcs_, faces_of_round, labels_, asked,
                              kept_.absorbed, stale) > 0) {
            std::sort(stale.begin(), stale.end());
            stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
            const std::vector<Index> mixed = places_of(stale);
            stale = faces_at(mixed);
            for (const Index face : stale) clear_arcs(face, asked);
            if (!touched_.is_all()) groups = group_relays(mixed);
            trace(mixed, groups);
            for (const Index face : stale) asked.insert_those_in(face, arcs_);
            kept_.mended_faces.insert(kept_.mended_faces.end(), stale.begin(), stale.end());
            faces_of_round = faces_of(asked);
            if (asked_.insert(asked)) faces = faces_of(asked_);
            stale.clear();
        }
    }

    const Surface& surface_;
    const DiagramOptions& options_;
    Kept& kept_;
    EdgeLabels& labels_;
    ArcStore& arcs_;
    std::span<const SurfacePoint> sites_;
    const Propagation& propagation_;
    TouchedParts touched_;
    CellSet asked_;                 // Whose cells may be others now.
    std::vector<Index> new_faces_;  // Those that were traced, ascending.
};

DiagramBuilder::DiagramBuilder(const Surface& surface, DiagramOptions options)
    : surface_(surface), options_(std::move(options)) {}

void DiagramBuilder::build(std::span<const SurfacePoint> sites, const Propagation& propagation,
                           std::span<const Index> changed_faces, Diagram& diagram) {
    std::optional<Kept> kept = std::exchange(kept_, {});  // None after a call that throws.
    poll(options_.progress, 0);
    if (!kept || kept->arcs.is_wasteful()) {
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

}  // namespace agvd
