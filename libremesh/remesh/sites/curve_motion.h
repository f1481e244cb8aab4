//! \file
//! Moves of sites along their curves. Private to relaxation.
#pragma once

#include <algorithm>

#include "remesh/curves/curve_sites.h"
#include "remesh/sites/cvt_energy.h"

namespace remesh::detail {

//! Moves sites along their curves, all copies of a site together.
class CurveMotion {
public:
    //! \param surface  of the network, whole or cut; outlives this, as does the network.
    CurveMotion(const Surface& surface, const CurveNetwork& network, CurveSites sites)
        : surface_(surface),
          network_(network),
          sites_(std::move(sites)),
          group_(groups_of_copies(sites_)),
          curve_(sites_.num_groups(), no_index),
          half_slope_(sites_.num_groups(), 0),
          stiffness_(sites_.num_groups(), 0),
          move_(sites_.num_groups(), 0),
          along_before_(sites_.along) {
        for (Index c = 0; c < network.curves.size(); ++c) {
            if (!is_even(sites_, network.curves[c], c)) continue;
            std::fill(curve_.begin() + sites_.first_of_curve[c],
                      curve_.begin() + sites_.first_of_curve[c + 1], c);
        }
    }

    [[nodiscard]] const CurveSites& sites() const { return sites_; }
    [[nodiscard]] Index num_copies() const { return static_cast<Index>(sites_.sites.size()); }

    //! Computes the slope of the energy along the curves from the cells of all copies.
    //! \param cells  #sites; the copies come first.
    //! \return the sum of slope times last move.
    double measure(std::span<const CvtEnergy::Cell> cells) {
        double uphill = 0;
        for (Index g = sites_.num_nodes(); g < sites_.num_groups(); ++g) {
            if (curve_[g] == no_index) continue;
            const Vec3 tangent =
                tangent_of_curve(surface_, network_.curves[curve_[g]], sites_.along[g]);
            half_slope_[g] = stiffness_[g] = 0;
            for (Index copy = sites_.first_copy[g]; copy < sites_.first_copy[g + 1]; ++copy) {
                half_slope_[g] += tangent.dot(cells[copy].slope) / 2;
                stiffness_[g] += cells[copy].mass;
            }
            uphill += half_slope_[g] * move_[g];
        }
        return uphill;
    }
    //! Moves all groups but nodes by `stretch` times Newton's step plus `keep` times the last move,
    //! but not past their neighbours.
    void step(double stretch, double keep) {
        along_before_ = sites_.along;
        for (Index g = sites_.num_nodes(); g < sites_.num_groups(); ++g) {
            const Index c = curve_[g];
            if (c == no_index) continue;
            const Curve& curve = network_.curves[c];
            const Index first = sites_.first_of_curve[c], last = sites_.first_of_curve[c + 1] - 1;
            const double at = along_before_[g];
            const double turn = curve.is_closed() ? curve.length() : 0;
            const double before = g > first           ? along_before_[g - 1]
                                  : curve.is_closed() ? along_before_[last] - turn
                                                      : 0;
            const double after = g < last            ? along_before_[g + 1]
                                 : curve.is_closed() ? along_before_[first] + turn
                                                     : curve.length();
            double move = keep * move_[g];
            if (stiffness_[g] > 0) move -= stretch * half_slope_[g] / stiffness_[g];
            const double least =
                least_interval * curve.length() / (last - first + (curve.is_closed() ? 1 : 2));
            const double back = std::max((at - before - least) / 2, 0.0);
            const double ahead = std::max((after - at - least) / 2, 0.0);
            move_[g] = std::clamp(move, -std::min(back, longest_curve_move * (at - before)),
                                  std::min(ahead, longest_curve_move * (after - at)));
            move_along(curve, g, at + move_[g], sites_);
        }
    }
    //! Undoes the last move of the group that has this copy.
    void take_back(Index copy) {
        const Index g = group_[copy];
        if (curve_[g] == no_index) return;
        move_[g] = 0;
        move_along(network_.curves[curve_[g]], g, along_before_[g], sites_);
    }
    //! The copies in the group of this one: [first, last).
    [[nodiscard]] std::pair<Index, Index> copies_with(Index copy) const {
        return {sites_.first_copy[group_[copy]], sites_.first_copy[group_[copy] + 1]};
    }

private:
    // Longest move, as a share of the distance to the neighbour: two approaching sites do not meet.
    static constexpr double longest_curve_move = 0.3;
    // Least distance of neighbours, as a share of their mean distance on the curve.
    static constexpr double least_interval = 0.5;
    // Largest ratio of a curve's intervals that counts as even.
    static constexpr double even_ratio = 1.01;

    // Whether the sites of a curve are evenly spaced. Only such sites move: others are closer in
    // bends, and moves would undo that.
    static bool is_even(const CurveSites& sites, const Curve& curve, Index c) {
        const Index first = sites.first_of_curve[c], last = sites.first_of_curve[c + 1];
        if (first == last) return true;
        double before = curve.is_closed() ? sites.along[last - 1] - curve.length() : 0;
        double least = curve.length(), most = 0;
        for (Index g = first; g < last; ++g) {
            least = std::min(least, sites.along[g] - before);
            most = std::max(most, sites.along[g] - before);
            before = sites.along[g];
        }
        if (!curve.is_closed()) {
            least = std::min(least, curve.length() - before);
            most = std::max(most, curve.length() - before);
        }
        return most <= even_ratio * least;
    }

    const Surface& surface_;
    const CurveNetwork& network_;
    CurveSites sites_;
    std::vector<Index> group_;  // By copy.
    std::vector<Index> curve_;  // By group; no_index: it does not move.
    std::vector<double> half_slope_, stiffness_, move_, along_before_;  // By group.
};

}  // namespace remesh::detail
