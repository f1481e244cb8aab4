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

//! The nearest number of samples, at least 1.
//! \throw InvalidOption  it is above 8e8.
[[nodiscard]] Index to_count(double vertices);

//! The number of samples by which the options' edge length, number of faces or target lengths come
//! out; num_samples if they have none of these. Creases and junctions do not count yet.
//!
//! \throw InvalidOption  the number would be too large.
//! Cost: O(#F).
[[nodiscard]] Index sample_count(const CleanedInput& cleaned, const RemeshOptions& options);

//! Whether the number of samples follows from lengths or faces.
[[nodiscard]] inline bool gives_num_samples(const Sizing& sizing) {
    return !std::holds_alternative<NumSamples>(sizing.count);
}

//! The number of locked edges on the boundary. Cost: O(n).
[[nodiscard]] Index num_locked_on_boundary(const CleanedInput& cleaned);

//! The fewest samples that topology and what is locked allow; 1 if nothing is locked.
//! Cost: O(n).
[[nodiscard]] Index least_samples(const CleanedInput& cleaned, double spacing);

//! The edge length to ask for so that the mean edge comes nearer to that of MeanEdge;
//! nothing if it is near enough.
//!
//! \param mean_edge  of the result with these options.
[[nodiscard]] std::optional<double> corrected_edge_length(double mean_edge,
                                                          const RemeshOptions& options);

//! The edge length by which so many samples come out. Cost: O(#F).
[[nodiscard]] double edge_length_for(Index count, const CleanedInput& cleaned,
                                     const RemeshOptions& options);

//! The number of faces by which so many samples come out. Cost: O(#F).
[[nodiscard]] Index faces_for(Index count, const CleanedInput& cleaned);

}  // namespace remesh::detail
