//! \file
//! Steps towards a centroidal Voronoi tessellation.
#pragma once

#include <optional>

#include "remesh/sites/cell_measures.h"
#include "remesh/sites/curve_motion.h"

namespace remesh::detail {

//! Lloyd's method with momentum, on the triangulation of the sites, which flips keep Delaunay: a
//! step costs a few hundredths of a propagation. Sites walk on the surface.
//!
//! Cells weigh more if they hold more of the surface than of the triangulation, or are bent: sites
//! would leave such regions, as the tip of an ear.
class Relaxation {
public:
    //! Sites on the boundary stay on it. Sites at boundary vertices do not move, nor do sites in no
    //! triangle, nor inner sites around which triangles do not close.
    //! \param start     its weights are the density at the start.
    //! \param is_fixed  #sites: 1 for sites that stay; or empty.
    //! \param progress  outlives this; polled by all long operations. If one of these throws
    //!                  Cancelled, this object is unspecified then.
    Relaxation(const Surface& surface, TriangulatedSites start, std::vector<std::uint8_t> is_fixed,
               int num_threads, const Progress& progress);

    //! From now on sites of curves, which come first, slide along these; those at nodes stay.
    //! \param network  outlives this.
    //! \param curves  its sites: the first ones of all.
    void hold(const CurveNetwork& network, CurveSites curves);

    //! Sets the density by what the cells hold of the surface, by target lengths, or both: then
    //! bent cells are not smaller than others.
    //! \param cells   null: target lengths alone.
    //! \param length  #sites: in any unit; or empty.
    void set_density(const CellMeasures* cells, std::span<const double> length);

    //! The number of triangles that face against the surface.
    [[nodiscard]] Index num_turned() const { return static_cast<Index>(turned_.size()); }
    //! The number of these and of sites around which triangles do not close.
    [[nodiscard]] Index num_flaws() const { return num_stuck_ + num_turned(); }
    //! Replaces the triangles if the new ones have fewer flaws.
    void repair(const std::vector<Triangle>& triangles);

    //! Cost: O(#sites) and the faces crossed.
    void step();

    [[nodiscard]] const CvtEnergy& energy() const { return now_; }

    //! What steps reduce: the weighted energy, and the squared distances from the cells' planes.
    [[nodiscard]] double objective() const;

    [[nodiscard]] const std::vector<SurfacePoint>& sites() const { return sites_; }
    //! Empty unless curves are held.
    [[nodiscard]] const std::optional<CurveMotion>& curves() const { return curves_; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return mesh_.triangles; }
    [[nodiscard]] const std::vector<double>& weights() const { return weight_; }

private:
    void weigh_cells(const CellMeasures& cells, double power_of_bending);
    void measure();
    void find_stuck();
    void take_triangles(std::vector<Triangle> triangles);
    void locate(Index i);
    void choose_moves();
    void choose_move(Index i, double keep);
    void walk();
    void walk_curves();
    bool take_back(Index i);
    void prefetch(Index i) const;
    void take_back();

    const Surface& surface_;
    int num_threads_;
    Poller poller_;
    Ticker ticker_;
    SiteMesh mesh_;
    std::vector<SurfacePoint> sites_;
    std::vector<Vec3> at_, facing_;                // #sites: positions, normals of their faces.
    std::vector<SurfacePoint> sites_before_;       // Before the last step.
    std::vector<Vec3> at_before_, facing_before_;  // at_ and facing_ of these.
    std::vector<Vec3> move_;                       // #sites: the last move.
    std::vector<Vec3> half_slope_;                 // #sites
    std::vector<double> weight_;                   // #sites
    std::vector<CellPlanes> planes_;               // #sites
    std::vector<std::uint8_t> is_fixed_;           // #sites
    std::vector<std::uint8_t> is_stuck_;           // #sites: the triangles around do not close.
    std::vector<Index> boundary_;                  // #sites: the boundary half-edge, or no_index.
    Index num_stuck_ = 0;
    std::vector<Index> turned_;  // Triangles that face against the surface.
    CvtEnergy now_;
    std::optional<CurveMotion> curves_;
};

}  // namespace remesh::detail
