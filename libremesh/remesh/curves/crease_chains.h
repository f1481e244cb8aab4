//! \file
//! A set of crease edges and the chains that it consists of; the steps of find_creases on it.
//! Private to remeshing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Consecutive edges. Inner vertices have two edges of the set and are not on the boundary.
struct CreaseChain {
    std::vector<Index> edges;
    Index ends[2] = {no_index, no_index};  //!< Vertices; the same if closed.
    double length = 0;
};

//! A set of inner edges and how many of them meet at each vertex.
class CreaseSet {
public:
    explicit CreaseSet(const Surface& surface)
        : surface_(&surface), is_in_(surface.num_edges()), degree_(surface.num_vertices()) {
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            is_anchor_.push_back(surface.is_boundary_vertex(v) ? 1 : 0);
        }
    }

    void add(Index edge) { change(edge, true); }
    void remove(Index edge) { change(edge, false); }
    //! Chains end at the vertex as they do on the boundary.
    void anchor(Index vertex) { is_anchor_[vertex] = 1; }
    [[nodiscard]] bool has(Index edge) const { return is_in_[edge] != 0; }
    //! The first edge of the set from `edge` on; the number of edges if there is none.
    [[nodiscard]] Index next(Index edge) const;
    [[nodiscard]] Index degree(Index vertex) const { return degree_[vertex]; }
    //! A chain ends here, away from other chains, from the boundary and from anchors.
    [[nodiscard]] bool is_open_end(Index vertex) const {
        return degree_[vertex] == 1 && is_anchor_[vertex] == 0;
    }
    //! A chain passes through here.
    [[nodiscard]] bool is_inner(Index vertex) const {
        return degree_[vertex] == 2 && is_anchor_[vertex] == 0;
    }
    [[nodiscard]] const Surface& surface() const { return *surface_; }
    [[nodiscard]] std::vector<std::uint8_t> take_flags() { return std::move(is_in_); }

private:
    void change(Index edge, bool is_in) {
        if (has(edge) == is_in) return;
        is_in_[edge] = is_in ? 1 : 0;
        const Index h = surface_->edge_half[edge];
        for (const Index v : {surface_->tail(h), surface_->head(h)}) {
            degree_[v] += is_in ? 1 : no_index;  // Minus one.
        }
    }

    const Surface* surface_;
    std::vector<std::uint8_t> is_in_;      // #E.
    std::vector<Index> degree_;            // #V.
    std::vector<std::uint8_t> is_anchor_;  // #V.
};

//! All chains, ascending by their lowest edge. Cost: O(#E).
[[nodiscard]] std::vector<CreaseChain> chains_of(const CreaseSet& set, Poller& poller);

//! The angle between the normals on both sides of each edge, radians in [0, pi]; 0 on the boundary.
//!
//! A face lower than `narrow` has no reliable normal: it is joined with the neighbour that fits
//! best until the patch is not narrow. All edges of the patch get the normal of its vector area,
//! where noise cancels; edges inside get 0.
//! \param narrow  mesh units, >= 0: least height over the longest side.
//! \return #E.
//! Cost: O(#F + k log k), k = narrow faces.
[[nodiscard]] std::vector<double> edge_angles(const Surface& surface, double narrow,
                                              int num_threads, Poller& poller);

//! For each edge of the set: how much the surface around it turns, radians; 0 for others. The root
//! of the sum of angle squared times length over edges outside the set within `reach`, per length
//! of the set's edge: many small turns count little, noise as much as the noisy edge. The reach is
//! the length of the set's edges if longer, at most four times `reach`.
//! \param angles  #E, radians.
//! \return #E.
//! Cost: O(#V + k log k), k = edges within reach.
[[nodiscard]] std::vector<double> surrounding_turn(const CreaseSet& set,
                                                   const std::vector<double>& angles, double reach,
                                                   Poller& poller);

//! The edges along which a crease may continue.
struct CarryRules {
    double least_angle = 0;  //!< Radians.
    double most_gap = 0;     //!< Mesh units.
};

//! Joins open ends to vertices ahead of them by the shortest path of weak edges, shortest paths
//! first. No gap is longer than the chain that ends there.
//! \param angles  #E, radians.
//! Cost: O(#E + k log k), k = weak edges within reach of an end.
void close_gaps(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                Poller& poller);

//! Extends chains at open ends along weak edges that turn by less than 45 degrees, by at most their
//! own length.
//! Cost: O(#E).
void extend_ends(CreaseSet& set, const std::vector<double>& angles, const CarryRules& rules,
                 Poller& poller);

//! The least values of what stays, mesh units. The merit of a chain is the sum of length times
//! weight over its edges.
struct PruningRules {
    double least_spur = 0;    //!< Merit of a chain with one open end.
    double least_island = 0;  //!< Merit of a chain with two open ends.
    //! Merit of a connected network, which may be a single closed chain. Short chains count in
    //! proportion to their length.
    double least_network = 0;
    double short_chain = 0;    //!< Length below which chains are short.
    double least_density = 0;  //!< A network's merit, counted in this way, per length.
};

//! Removes chains with open ends, then networks, that fall short of the rules.
//! \param weights  #E, >= 0.
//! Cost: O(#E + k log k), k = edges of the set.
void prune(CreaseSet& set, const std::vector<double>& weights, const PruningRules& rules,
           Poller& poller);

}  // namespace remesh::detail

namespace remesh {

//! Edges that a mesh within a distance of the surface needs, whatever their angle: the chord across
//! them, as far as the surface is straight on both sides, is too far from them. No edges of a mesh
//! that is fine for the distance are such.
//! \param spacing   of the sites, mesh units: see find_creases.
//! \param distance  mesh units, > 0.
//! \return #E. Cost: for each edge that of the faces up to where the surface bends.
[[nodiscard]] std::vector<std::uint8_t> find_hinges(const Surface& surface, double spacing,
                                                    double distance, int num_threads,
                                                    const Progress& progress);

//! Leaves out seams around charts narrower than 2.5 spacings (twice the area over the length), the
//! narrowest first; then chains with a free end shorter than two spacings.
//! \param is_crease  #E: a chain that ends on these, or on the boundary, has no free end there;
//!                   empty: there are none.
//! \param spacing    of the sites, mesh units.
//! \param is_seam    #E; edited in place.
//! Cost: O(#E).
void prune_seams(const Surface& surface, std::span<const std::uint8_t> is_crease, double spacing,
                 std::vector<std::uint8_t>& is_seam, Ticker ticker = {});

}  // namespace remesh
