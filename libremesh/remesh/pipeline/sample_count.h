//! \file
//! How many samples a run places.
#pragma once

#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! The length for a face of the cleaned mesh.
[[nodiscard]] inline double face_length(const CleanedInput& cleaned, const FaceLengths& lengths,
                                        Index face) {
    return lengths.values[cleaned.face_origin.empty() ? face : cleaned.face_origin[face]];
}

//! \throw InvalidOption  a number of vertices is above 8e8.
void check_count(Index count);

//! The vertices of a mesh that follows target lengths, and no fewer than what is locked needs.
//! \param area     of the surface in squares of the local length.
//! \param spacing  mesh units: of the sites in the mean.
//! \return a number for check_count. Cost: O(n).
[[nodiscard]] Index count_for_area(double area, const CleanedInput& cleaned, double spacing);

//! The mean edge of a result of which few edges are longer than the bound.
[[nodiscard]] double most_mean_edge(const ShapeBounds& bounds);

//! The number of samples by which the options' edge length, number of faces or target lengths come
//! out; num_samples if they have none of these; and as many as a longest edge needs. Creases and
//! junctions do not count yet.
//! \throw InvalidOption  it is above 8e8. Cost: O(#F).
[[nodiscard]] Index sample_count(const CleanedInput& cleaned, const RemeshOptions& options);

//! Whether the number of samples follows from lengths or faces.
[[nodiscard]] inline bool gives_num_samples(const Sizing& sizing) {
    return !std::holds_alternative<NumSamples>(sizing.count);
}

//! The edge length to ask for so that the mean edge comes nearer to that of MeanEdge; nothing if it
//! is near enough.
//! \param mean_edge  of the result with these options.
[[nodiscard]] std::optional<double> corrected_edge_length(double mean_edge,
                                                          const RemeshOptions& options);

//! The edge length by which so many samples come out. Cost: O(#F).
[[nodiscard]] double edge_length_for(Index count, const CleanedInput& cleaned,
                                     const RemeshOptions& options);

//! The number of faces by which so many samples come out. Cost: O(#F).
[[nodiscard]] Index faces_for(Index count, const CleanedInput& cleaned);

}  // namespace remesh::detail
