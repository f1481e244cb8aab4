// A face keeps the relays of the sites that did not run again. Those of the sites that did are
// patches, sorted by face with a counting sort. Both are merged in the order of the sites, as a
// fresh run gives them.
#include "agvd/update/face_patches.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/mesh/one_ring.h"
#include "agvd/propagation/window_relays.h"

namespace agvd {
namespace {

void sort_by_face(FacePatches& patches) {
    const std::vector<Index>& faces = patches.changed_faces;
    for (Index i = 0; i < faces.size(); ++i) patches.place[faces[i]] = i;
    std::vector<Index>& ends = patches.ends;
    ends.assign(faces.size(), 0);
    for (const Patch& patch : patches.by_site) ++ends[patches.place[patch.face]];
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), Index{0});
    patches.patches.resize(patches.by_site.size());
    for (const Patch& patch : patches.by_site) {
        patches.patches[ends[patches.place[patch.face]]++] = patch;
    }
    for (const Index face : faces) patches.place[face] = no_index;
}

// What collecting reads.
struct Source {
    const MovingInput& in;
    const SiteRuns& runs;
    const RelayStore& store;
    const Propagation& result;
};

// Merges the relays that a face has of sites that did not run again with its patches, in the order
// of the sites.
class WindowMerger {
public:
    WindowMerger(const Source& source, std::span<const Patch> patches, FaceRelays& all,
                 std::vector<Relay>& out)
        : source_(source), patches_(patches), next_(patches.begin()), all_(all), out_(out) {}

    void merge(std::span<const Relay> old) {
        while (!old.empty()) {
            const SiteId site = old.front().site;
            std::size_t count = 1;
            while (count < old.size() && old[count].site == site) ++count;
            if (site.is_valid()) take_old(old.first(count));  // Else it was removed.
            old = old.subspan(count);
        }
        while (next_ != patches_.end()) take_patch();
    }

private:
    // Of one site.
    void take_old(std::span<const Relay> relays) {
        const NumberedSites& sites = source_.in.sites;
        const Index rank = relays.front().site.value();
        const Index number = sites.number(rank);
        if (std::any_of(patches_.begin(), patches_.end(),
                        [&](const Patch& p) { return p.site == number; })) {
            return;
        }
        while (next_ != patches_.end() && sites.comes_before(next_->site, number)) take_patch();
        append(relays, rank);
    }

    void take_patch() {
        append(std::span(source_.runs.changes[next_->chunk].changes.relays)
                   .subspan(next_->first, next_->count),
               source_.in.sites.rank(next_->site));
        ++next_;
    }

    void append(std::span<const Relay> relays, Index rank) {
        if (relays.empty()) return;
        all_.add_site(rank);
        for (const Relay& relay : relays) out_.push_back(relay);
        const auto first = out_.end() - static_cast<std::ptrdiff_t>(relays.size());
        std::for_each(first, out_.end(), [&](Relay& r) { r.site = SiteId(rank); });
    }

    const Source& source_;
    std::span<const Patch> patches_;
    std::span<const Patch>::iterator next_;
    FaceRelays& all_;
    std::vector<Relay>& out_;
};

// Appends the relays that a face has now.
void collect(const Source& source, Index face, std::span<const Patch> patches,
             CollectedFaces& out) {
    FaceRelays all;
    const std::size_t begin = out.relays.size();
    WindowMerger(source, patches, all, out.relays).merge(source.store.windows(source.result, face));
    const auto num_windows = static_cast<Index>(out.relays.size() - begin);

    const Surface& surface = source.in.surface;
    for (const Index v : surface.mesh.triangles[face]) {
        all.add_site(source.result.vertex_site[v].value());
    }
    const auto placed = source.in.placement.in_face(face);
    for (const PlacedSite& p : placed) all.add_site(p.site);
    const bool is_mixed = all.site == FaceRelays::several;
    if (is_mixed) {
        const std::size_t windows_end = out.relays.size();
        out.relays.resize(windows_end + count_inner_relays(surface, placed, source.result, face));
        write_inner_relays(surface, placed, source.result, face, out.relays.data() + windows_end);
    }
    out.faces.push_back({static_cast<Index>(begin), num_windows,
                         static_cast<Index>(out.relays.size() - begin), is_mixed});
}

// What collect() reads of a face, in two steps. Always inline: g++ drops calls of functions that do
// nothing but prefetch.
[[gnu::always_inline]] inline void prefetch(const Source& source, Index far, Index near) {
    const Surface& surface = source.in.surface;
    if (far != no_index) {
        source.store.prefetch_place(far);
        __builtin_prefetch(&surface.mesh.triangles[far]);
    }
    if (near != no_index) {
        source.store.prefetch_relays(source.result, near);
        for (const Index v : surface.mesh.triangles[near]) {
            __builtin_prefetch(&source.result.vertex_site[v]);
            __builtin_prefetch(&source.result.vertex_distance[v]);
            __builtin_prefetch(&surface.can_be_pseudo_source[v]);
        }
    }
}

}  // namespace

void list_patches(const MovingInput& input, const SiteRuns& runs, std::span<const Index> sites,
                  std::span<const Index> vertices, FacePatches& patches) {
    patches.changed_faces.clear();
    patches.by_site.clear();
    const auto add = [&](Index face) {
        if (std::exchange(patches.place[face], 0) == no_index) {
            patches.changed_faces.push_back(face);
        }
    };
    for (const Index face : input.sites.changed_faces()) add(face);
    for (Index i = 0; i < sites.size(); ++i) {
        const SiteChangesView changes = changes_of(runs, i);
        for (const RunChanges::Face& change : changes.faces) {
            patches.by_site.push_back(
                {change.face, sites[i], changes.chunk, change.first, change.count});
            add(change.face);
        }
    }
    for (const Index v : vertices) {
        for_each_outgoing(input.surface, v, [&](Index h) { add(Surface::face(h)); });
    }
    std::sort(patches.changed_faces.begin(), patches.changed_faces.end());
    sort_by_face(patches);
}

void replace_relays(const MovingInput& input, const SiteRuns& runs, FacePatches& patches,
                    RelayStore& store, Propagation& result) {
    constexpr Index grain = 256;
    const std::vector<Index>& faces = patches.changed_faces;
    const auto count = static_cast<Index>(faces.size());
    patches.collected.resize(num_chunks(count, grain));
    const Source source{input, runs, store, result};
    const auto collect_chunk = [&](Index chunk, Index begin, Index end) {
        CollectedFaces& out = patches.collected[chunk];
        out.faces.clear();
        out.relays.clear();
        for (Index i = begin; i < end; ++i) {
            prefetch(source, i + 6 < end ? faces[i + 6] : no_index,
                     i + 3 < end ? faces[i + 3] : no_index);
            collect(source, faces[i], patches.of(i), out);
        }
    };
    parallel_chunks(count, grain, input.num_threads, collect_chunk);
    for (Index i = 0; i < count; ++i) {
        const CollectedFaces& chunk = patches.collected[i / grain];
        const auto& [begin, num_windows, size, is_mixed] = chunk.faces[i % grain];
        store.replace(faces[i], std::span(chunk.relays).subspan(begin, size), num_windows, is_mixed,
                      result);
    }
    store.list_mixed_faces(faces, result);
}

}  // namespace agvd
