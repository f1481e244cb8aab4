//! \file
//! What relaxation does before its steps, and levels: steps on one number of sites, with
//! measurements of the surface between them.
#pragma once

#include "remesh/dual/triangulate_sites.h"
#include "remesh/sites/relaxation.h"
#include "remesh/sites/sites.h"

namespace remesh::detail {

//! Moves random sites from crowded regions to sparse ones, where they are less even than random
//! points: a Lloyd step evens out neighbours only. Of several sites at one position all but one
//! move. Starts as even as random ones do not change.
//!
//! Sites on the boundary stay. A component keeps its number of sites unless that is further from
//! its share than chance explains.
//! \param surface   regions consist of its base's faces.
//! \param sites     on surface.input().
//! \param is_fixed  #sites: 1 for sites that stay; or empty.
//! \param sizes     areas count in squares of the local length; null: in mesh units.
//! \throw Cancelled  the progress callback returned false; `sites` is unspecified then.
//! Cost: O(n log n), a few sweeps over the edges.
void even_out(const PreparedSurface& surface, std::vector<SurfacePoint>& sites,
              std::span<const std::uint8_t> is_fixed, int num_threads,
              const Progress& progress = {}, const SizeField* sizes = nullptr);

//! Whether triangles are as large as the features of the surface, or too many sites are in none.
//! Sites that are even on such a triangulation are not even on the surface.
[[nodiscard]] bool is_hopeless(const Relaxation& relaxation);

//! The levels of one relaxation, coarse to fine.
class Levels {
public:
    //! \param prepared  outlives this, as options do.
    Levels(const PreparedSurface& prepared, const RelaxOptions& options, int num_levels);
    Levels(const Levels&) = delete;
    Levels& operator=(const Levels&) = delete;

    //! For all operations of a step: reports the share of steps done.
    [[nodiscard]] const Progress& progress() const { return progress_; }

    //! Takes steps until they gain too little or all are done.
    //! \param labels   of the sites; null: the relaxation has its weights already.
    //! \param chain    edges of curves that the relaxation holds.
    void run(Relaxation& relaxation, const DistanceBounds* labels,
             std::span<const ChainEdge> chain = {});

    [[nodiscard]] DistanceBounds label(std::span<const SurfacePoint> sites) const;

    //! The triangulation of the sites: by labels, or from the diagram if faces are too large for
    //! labels. Triangles with other corners are left out.
    //! \param labels  of the base's vertices.
    //! \param chain   edges that its rim is to have.
    [[nodiscard]] SiteTriangles triangulate(const DistanceBounds& labels,
                                            std::span<const SurfacePoint> sites,
                                            std::span<const ChainEdge> chain, Narrow narrow) const;

    //! The levels that were run.
    [[nodiscard]] const std::vector<RelaxLevel>& levels() const { return levels_; }

private:
    [[nodiscard]] double fraction() const;
    // Whether there are enough vertices for labels to tell what cells hold.
    [[nodiscard]] bool gives_cells(std::size_t num_sites) const;
    void look(Relaxation& relaxation, const DistanceBounds& labels) const;
    void sweep(Relaxation& relaxation, std::span<const ChainEdge> chain);

    const PreparedSurface& prepared_;
    const Surface& surface_;  // Of its base.
    const RelaxOptions& options_;
    Progress progress_;
    int steps_planned_;
    int steps_done_ = 0;
    std::vector<RelaxLevel> levels_;
};

}  // namespace remesh::detail
