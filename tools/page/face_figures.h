//! \file
//! The shapes of a mesh's triangles, as histograms and as a list of the worst.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "page/embed.h"
#include "remesh/quality/evaluate.h"

namespace page {

//! Values of [low, low + counts.size() * width), in bins of equal width; the last bin also holds
//! all that are larger.
struct Histogram {
    double low = 0;                     //!< Where the first bin begins.
    double width = 1;                   //!< Of each bin.
    std::vector<std::uint64_t> counts;  //!< Of each bin.
};

//! \pre num_bins > 0. Values below `low` are in the first bin.
[[nodiscard]] Histogram histogram_of(std::span<const double> values, double low, double width,
                                     std::size_t num_bins);

//! As the viewer reads it.
[[nodiscard]] Json to_json(const Histogram& histogram);

struct Histograms {
    Histogram angle;    //!< Degrees, of all corners.
    Histogram quality;  //!< Q of all faces.
    Histogram edge;     //!< Length over target, of all edges.
    Histogram valence;  //!< Edges of each vertex that has some.
};

//! \param targets  for each vertex the length of edges there; of an edge the mean of its ends
//!        counts. Empty: the mean edge is the target of all.
//! Cost: O(n).
[[nodiscard]] Histograms histograms_of(const agvd::MeshView& mesh, std::span<const double> targets);

//! The faces with the least Q, the worst first; of equal ones the first.
//! Cost: O(n).
[[nodiscard]] std::vector<agvd::Index> worst_faces(const agvd::MeshView& mesh, std::size_t count);

}  // namespace page
