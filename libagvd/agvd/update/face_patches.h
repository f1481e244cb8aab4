//! \file
//! Faces get other relays where sites ran again.
#pragma once

#include "agvd/update/relay_store.h"
#include "agvd/update/site_runs.h"

namespace agvd {

//! All that a site that ran again gives to a face: relays of its chunk.
struct Patch {
    Index face;
    Index site;
    Index chunk;
    Index first, count;
};

//! What some faces are to have.
struct CollectedFaces {
    struct Face {
        Index begin;               //!< In relays.
        Index num_windows, count;  //!< As in StoredFace.
        bool is_mixed;
    };
    std::vector<Face> faces;
    std::vector<Relay> relays;
};

//! Keeps its memory from update to update.
struct FacePatches {
    std::vector<Index> changed_faces;       //!< Ascending.
    std::vector<Patch> patches;             //!< Face after face; those to one face by site.
    std::vector<Index> ends;                //!< By changed face: where its patches end.
    std::vector<Patch> by_site;             //!< The same patches, site after site.
    std::vector<Index> place;               //!< #F: no_index but while faces are listed.
    std::vector<CollectedFaces> collected;  //!< Chunks of changed faces.

    [[nodiscard]] std::span<const Patch> of(Index changed) const {
        const Index first = changed == 0 ? 0 : ends[changed - 1];
        return std::span(patches).subspan(first, ends[changed] - first);
    }
};

//! Lists the faces with patches, around settled vertices and of sites that changed, and sorts the
//! patches by face.
//! \param sites     those of the last run_again().
//! \param vertices  those that were settled.
void list_patches(const MovingInput& input, const SiteRuns& runs, std::span<const Index> sites,
                  std::span<const Index> vertices, FacePatches& patches);

//! Gives the listed faces their relays: those of sites that did not run again, and the patches.
//! Parallel.
void replace_relays(const MovingInput& input, const SiteRuns& runs, FacePatches& patches,
                    RelayStore& store, Propagation& result);

}  // namespace agvd
