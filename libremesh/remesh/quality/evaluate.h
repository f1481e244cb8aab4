//! \file
//! How good a mesh is by itself, and how near a remesh is to its original.
//! Held by Evaluate.AnyScaleGivesTheSameSharesAndScaledLengths in tests/remesh/quality.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"

namespace remesh {

//! Angles in radians, shares in [0, 1]. A face of area 0 has quality 0; its angles are 0 or pi.
struct TriangleQuality {
    //! Of Q = 6 / sqrt(3) * S / (p h): S area, p half the perimeter, h the longest edge. 1 for an
    //! equilateral triangle, 0 for a degenerate one ([frey1999]).
    double mean_quality = 0;
    double min_quality = 0;            //!< Of the worst triangle.
    double mean_min_angle = 0;         //!< Mean of the faces' smallest angles.
    double min_angle = 0;              //!< Radians.
    double max_angle = 0;              //!< Radians.
    double small_angle_share = 0;      //!< Faces whose smallest angle is below pi / 6.
    double regular_share = 0;          //!< Vertices of 6 edges, on the boundary of 4.
    double edge_length_variation = 0;  //!< Standard deviation over mean of the edge lengths.
    Index edges = 0;                   //!< #E.
    //! Inner edges whose two opposite angles (measured in space) sum to more than pi.
    Index non_delaunay_edges = 0;
    Index faces_without_area = 0;  //!< Flat up to rounding: see is_flat().
};

//! One triangle.
struct FaceShape {
    double quality = 0;             //!< Q: see TriangleQuality.
    std::array<double, 3> angle{};  //!< Radians, at each corner.
    //! Of the three.
    [[nodiscard]] double smallest_angle() const {
        return *std::min_element(angle.begin(), angle.end());
    }
};

//! \param corners  finite.
[[nodiscard]] FaceShape measure_face(const std::array<Vec3, 3>& corners);

//! Measures any mesh, manifold or not. Edges with one face or more than two are not tested for the
//! Delaunay condition, and vertices in no face do not count.
//! \param mesh  #V x 3 finite positions, #F x 3 indices in range; without faces all is 0.
//! Cost: O(n log n).
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] TriangleQuality measure_triangles(const MeshView& mesh,
                                                const Progress& progress = {});

//! Pairs of faces (lower, higher), sorted, that meet in more than the vertices or the edge they
//! share by index, or have the same corners. Exact on the coordinates, for any mesh. Faces without
//! area are skipped.
//! \param num_threads  >= 0; 0: all cores. Any number gives the same pairs.
//! \throw Cancelled  the progress callback returned false.
//! \return unset in a build without CGAL, whose box intersection and exact predicates are used.
//! Cost: O(n log^3 n) and about 1 us for each pair of neighbouring faces.
[[nodiscard]] std::optional<std::vector<std::pair<Index, Index>>> find_self_intersections(
    const MeshView& mesh, int num_threads = 0, const Progress& progress = {});

//! `{}` gives the defaults.
struct EvaluationOptions {
    Index samples = 200'000;  //!< On each of the two surfaces, >= 1; vertices are added.
    int num_threads = 0;      //!< >= 0; 0: all cores. Any number gives the same bytes.
    Progress progress = {};   //!< Polled during the call; see poll.
};

//! From one surface to the closest points of another, mesh units.
struct OneSidedDistance {
    double mean = 0;               //!< Over the area: from the samples alone.
    double rms = 0;                //!< Over the area: from the samples alone.
    double max = 0;                //!< Over samples and vertices.
    Vec3 farthest = Vec3::Zero();  //!< The point that is so far; of several the first.
};

//! Lengths in mesh units.
struct SurfaceDistance {
    OneSidedDistance from_original;  //!< From points of the original to the result.
    OneSidedDistance from_result;    //!< From points of the result to the original.
    double diagonal = 0;             //!< Of the box around the original's faces.
    Index samples = 0;               //!< On each surface, without the vertices.
    //! Faces of the result whose normal points against (more than a right angle away from) the
    //! normal of the original's face closest to their centroid.
    Index flipped_faces = 0;

    //! Lengths as percentages of the diagonal.
    [[nodiscard]] OneSidedDistance percent_of_diagonal(const OneSidedDistance& d) const {
        return {100 * d.mean / diagonal, 100 * d.rms / diagonal, 100 * d.max / diagonal,
                d.farthest};
    }
    //! The larger of the two sides, for mean, RMS and max each (so `max` is the Hausdorff
    //! distance).
    [[nodiscard]] OneSidedDistance two_sided() const {
        const bool is_original = from_original.max >= from_result.max;
        return {std::max(from_original.mean, from_result.mean),
                std::max(from_original.rms, from_result.rms),
                std::max(from_original.max, from_result.max),
                is_original ? from_original.farthest : from_result.farthest};
    }
};

//! Compares two surfaces by stratified area-uniform samples and by their vertices. Faces without
//! area are skipped.
//! \return unset in a build without CGAL, whose AABB tree finds the closest points.
//! \throw InvalidOption  samples < 1 or num_threads < 0.
//! \throw InvalidInput   no face of a mesh has area.
//! \throw Cancelled      the progress callback returned false.
//! Cost: O((samples + n) log n), about 2 us a sample.
[[nodiscard]] std::optional<SurfaceDistance> surface_distance(
    const MeshView& original, const MeshView& result, const EvaluationOptions& options = {});

//! An edge is sharp if its faces meet at more than 40 degrees or are more than two, and blunt above
//! 25 degrees. Points with equal coordinates count as one. A face of the original lower than 1e-6
//! diagonals (of the result 1e-9) takes the normal of the face across its longest other side.
struct FeatureCoverage {
    double length = 0;  //!< Of the original's sharp edges, mesh units.
    //! Share of it within .1 % of the diagonal of the result's blunt edges; 1 if there is none.
    double covered = 1;
    double covered_closely = 1;  //!< Share of it within .02 % of the diagonal.
    double result_length = 0;    //!< Of the result's sharp edges, mesh units.
    //! Share of it farther than .1 % of the diagonal from the original's blunt edges and boundary;
    //! 0 if there is none.
    double false_share = 0;
    //! Vertices of the original where three or more sharp or boundary edges meet, or two that turn
    //! by more than 45 degrees.
    Index corners = 0;
    Index corners_kept = 0;  //!< With a vertex of the result within .05 % of the diagonal.
    //! Corners where two of these edges meet at less than 30 degrees: a triangle between them
    //! cannot have a larger angle there.
    Index acute_corners = 0;
    //! Smallest angle of the result's triangles, radians, except those with a vertex within .05 %
    //! of the diagonal of an acute corner; pi if there is no other.
    double min_angle_elsewhere = 0;
    double diagonal = 0;  //!< Of the box around the original's faces, mesh units.
};

//! Measures how well a result keeps the sharp edges and corners of the original. Shares refer to 20
//! 000 points at equal distances along the edges.
//! \param original, result  any triangles, manifold or not; indices in range, positions finite.
//! \return nothing if the original has neither sharp edges nor corners.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n).
[[nodiscard]] std::optional<FeatureCoverage> feature_coverage(const MeshView& original,
                                                              const MeshView& result,
                                                              const Progress& progress = {});

//! One mesh by itself.
struct MeshFigures {
    Index vertices = 0;         //!< Also those in no face.
    Index faces = 0;            //!< #F.
    Topology topology;          //!< Components, genus, boundary loops.
    TriangleQuality triangles;  //!< Shapes and sizes.
    //! See find_self_intersections; unset in a build without CGAL.
    std::optional<std::vector<std::pair<Index, Index>>> self_intersections;
};

//! Everything but self-intersections.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n log n).
[[nodiscard]] MeshFigures measure_figures(const MeshView& mesh, const Progress& progress = {});

//! A remesh compared with its original.
struct Evaluation {
    MeshFigures original;        //!< After the repair that remesh() does, with its face numbers.
    CleanCounts cleaned;         //!< What that repair did.
    MeshFigures result;          //!< As given.
    bool topology_kept = false;  //!< The result is an oriented manifold with same_topology().
    std::optional<SurfaceDistance> distance;  //!< Unset in a build without CGAL.
    //! Unset if the original has neither sharp edges nor corners.
    std::optional<FeatureCoverage> features;
    //! Whether the original has creases at the spacing of the result, or of 2000 vertices; or edges
    //! with more than two faces. Otherwise its sharp edges are noise.
    bool has_creases = false;
};

//! \param original  any mesh that remesh() takes; it is repaired first (see clean_input).
//! \param result    any triangles, manifold or not; measured as they are.
//! \throw InvalidOption  see surface_distance.
//! \throw InvalidInput   the original cannot be repaired; or the result has an index out of
//!        range, a coordinate that is not finite, or no face with area. The text begins with
//!        "original: " or "result: ".
//! \throw Cancelled      the progress callback returned false.
//! Cost: O((samples + n) log n): about a second for 70 000 faces each and 200 000 samples.
[[nodiscard]] Evaluation evaluate(const MeshView& original, const MeshView& result,
                                  const EvaluationOptions& options = {});

//! Faces with an angle below pi / 6, and how many of them the input forces. An edge is sharp if two
//! faces meet there at more than 40 degrees, or if it has not two.
struct NarrowFaces {
    Index count = 0;             //!< Of all.
    Index at_acute_corners = 0;  //!< The angle below pi / 6 lies between two sharp edges.
    //! Of the others: with a vertex on a wall that is thinner than the edges there are long.
    Index at_thin_walls = 0;
    Index between_creases = 0;  //!< Of the others: all three corners are on sharp edges.
};

//! What is to be known before a mesh is printed. Closed components are bodies, or the walls of
//! cavities in them.
struct BodyCounts {
    Index closed = 0;        //!< Closed components.
    Index holes = 0;         //!< Connected chains of the edges with one face.
    Index hole_edges = 0;    //!< Edges of all holes.
    Index inside_out = 0;    //!< Closed components in no other one whose normals point inward.
    Index cavities = 0;      //!< Closed components in others whose normals point inward.
    Index inner_bodies = 0;  //!< The same whose normals point outward.
};

//! #components: signed volumes, cubic mesh units, above 0 where normals point outward; 0 of open
//! components. Cost: O(#F).
[[nodiscard]] std::vector<double> body_volumes(const MeshView& mesh, const Topology& topology);

//! Counts closed components and holes.
//! \param topology  of these faces; sheets may have been welded since.
//! Cost: O(n log n), and of each component as many steps as those have faces whose boxes hold it.
[[nodiscard]] BodyCounts count_bodies(const MeshView& mesh, const Topology& topology,
                                      Ticker ticker = {});

//! Parts of a result that are smaller than the spacing of its vertices. All lengths in mesh units.
struct Verdict {
    double spacing = 0;  //!< Mean edge length of the result.

    Index small_components = 0;        //!< Fewer vertices than least_component_vertices.
    Index samples_for_components = 0;  //!< About as many give each component enough.

    //! Connected parts of the result whose two sides are nearer to each other than their edges are
    //! long. Both sides of a plate are one part.
    Index thin_walls = 0;
    double thinnest_wall = 0;     //!< Least distance between the sides of these.
    Index samples_for_walls = 0;  //!< About as many give edges as short as that.

    double largest_distance = 0;   //!< Of the input's vertices from the result: see judge_result.
    Vec3 farthest = Vec3::Zero();  //!< The vertex of the input that is so far.
    double diagonal = 0;           //!< Of the input's bounding box.

    double min_angle = 0;          //!< Radians; of the faces of the result.
    double small_angle_share = 0;  //!< Of these faces: those with an angle below pi / 6.
    NarrowFaces narrow = {};       //!< The same ones.
    Index faces_without_area = 0;  //!< Of these faces.
    BodyCounts bodies = {};        //!< Of the result.
};

//! A component with fewer vertices is hard to recognise.
inline constexpr Index least_component_vertices = 12;

//! The input's vertices, or as many of them, evenly chosen by number, are compared with the result.
inline constexpr Index most_compared_vertices = 30'000;

//! \param input        the cleaned input; at least one vertex.
//! \param result       #V x 3 positions, #F x 3 indices; at least one face.
//! \param topology     of `result`.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O((#V + min(input vertices, most_compared_vertices)) log #F).
[[nodiscard]] Verdict judge_result(const MeshView& input, const MeshView& result,
                                   const Topology& topology, int num_threads = 0,
                                   const Progress& progress = {});

}  // namespace remesh
