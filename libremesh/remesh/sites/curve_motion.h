//! \file
//! Moves sites along their curves, all copies of a site together.
#pragma once

#include <span>

#include "remesh/curves/curve_sites.h"
#include "remesh/sites/cvt_energy.h"

namespace remesh::detail {

class CurveMotion {
public:
    //! \param surface  of the network, whole or cut; outlives this, as does the network.
    CurveMotion(const Surface& surface, const CurveNetwork& network, CurveSites sites);

    [[nodiscard]] const CurveSites& sites() const { return sites_; }
    [[nodiscard]] Index num_copies() const { return static_cast<Index>(sites_.sites.size()); }

    //! Computes the slope of the energy along the curves from the cells of all copies.
    //!
    //! \param cells  #sites; the copies come first.
    //! \return the sum of slope times last move.
    double measure(std::span<const CvtEnergy::Cell> cells);
    //! Moves all groups but nodes by `stretch` times Newton's step plus `keep` times the last move,
    //! but not past their neighbours.
    void step(double stretch, double keep);
    //! Undoes the last move of the group that has this copy.
    void take_back(Index copy);
    //! The copies in the group of this one: [first, last).
    [[nodiscard]] std::pair<Index, Index> copies_with(Index copy) const {
        return {sites_.first_copy[group_[copy]], sites_.first_copy[group_[copy] + 1]};
    }

private:
    const Surface& surface_;
    const CurveNetwork& network_;
    CurveSites sites_;
    std::vector<Index> group_;  // By copy.
    std::vector<Index> curve_;  // By group; no_index: it does not move.
    std::vector<double> half_slope_, stiffness_, move_, along_before_;  // By group.
};

}  // namespace remesh::detail
