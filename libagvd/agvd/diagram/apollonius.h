//! \file
//! The local Apollonius diagram of a triangle whose boundary is already labelled ([meng2023]
//! Sec. 4.2): which arcs join the label changes on the boundary, and where they branch.
#pragma once

#include "agvd/diagram/face_relays.h"

namespace agvd {

//! A label change on the triangle's boundary. Joints run counter-clockwise; between joint i and
//! joint i + 1 (cyclic) the boundary has label joints[i].site_after.
struct Joint {
    Vec2 position;
    Index node;  //!< Caller's name of the point.
    Index site_after;
    Index interval;  //!< Caller's name of the interval after it.
};

//! A piece of bisector between two nodes.
struct LocalArc {
    Index tail, head;   //!< Nodes.
    Index left, right;  //!< Sites, walking from tail to head.
    Index first_point;  //!< Its inner polyline points in LocalDiagram::points.
    Index num_points;
};

//! A point where three cells meet. Counter-clockwise around it: arc_ends[i], then sites[i].
struct LocalBranch {
    Vec2 position;
    double distance;
    std::array<Index, 3> arcs;    //!< Indices into arcs.
    std::array<bool, 3> at_tail;  //!< True: the arc starts here.
    std::array<Index, 3> sites;
};

struct LocalDiagram {
    std::vector<Vec2> points;
    std::vector<double> point_distance;
    std::vector<LocalArc> arcs;
    std::vector<LocalBranch> branches;  //!< Branch b is node first_branch_node + b.
    //! (site, change): their sum over a site is the number of connected pieces of its cell.
    std::vector<std::pair<Index, int>> pieces;
    //! Boundary intervals that hang together inside.
    std::vector<std::pair<Index, Index>> connected;
};

//! Appends to `out`. The result is a planar forest whatever the distances are: the boundary's
//! intervals are closed off one after the other, each by the arc or branch that fits the distances
//! best, and each step leaves a shorter cycle. Where the distances are those of a true Apollonius
//! diagram it is that diagram.
//!
//! \param joints            at least 2, neighbours differ in site_after; consumed.
//! \param first_branch_node node number of out.branches[0].
//! \param chord_tolerance   arcs are sampled until they stray less than this share of a chord.
//! Cost: O(k) branch points for k joints, each O(relays), and O(k^2) comparisons.
void solve_triangle(std::span<const PlanarRelay> relays, const std::array<Vec2, 3>& corners,
                    std::vector<Joint>& joints, Index first_branch_node, double chord_tolerance,
                    LocalDiagram& out);

}  // namespace agvd
