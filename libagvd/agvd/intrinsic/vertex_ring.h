//! \file
//! Removes a vertex without curvature, on a layout of the faces around it in one plane. Private.
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/intrinsic/operations.h"

namespace agvd::detail {

//! The ring of faces around an inner vertex without curvature, counter-clockwise, laid out in one
//! plane. To remove the vertex, edges at it are flipped until three are left, or four of which two
//! are one straight line. Faces are written once, when it is known that the vertex can be removed.
//!
//! Notation: m is the vertex at (0, 0). A sector lies between two consecutive spokes, edges from m
//! to its neighbours; the rim of a sector is the side of its face opposite to m.
class VertexRing {
public:
    VertexRing(Surface& surface, FaceCharts& charts) : surface_(surface), charts_(charts) {}

    //! Reads the ring of an inner vertex. The surface must not change until remove().
    void set(Index vertex) {
        vertex_ = vertex;
        half_edge_.clear();
        for_each_outgoing(surface_, vertex, [&](Index h) { half_edge_.push_back(h); });
    }
    //! Half-edges that leave the vertex.
    [[nodiscard]] std::span<const Index> half_edges() const { return half_edge_; }
    //! Removes the vertex. The vertex, faces and edges leave gaps.
    //! \return false if it cannot be removed: a face comes twice, or no edge can be flipped. Then
    //! nothing has changed.
    [[nodiscard]] bool remove() {
        operations_.clear();
        made_.clear();
        gone_edges_.clear();
        if (!lay()) return false;
        while (sectors_.size() > 3 && !(sectors_.size() == 4 && straighten())) {
            if (!flip_away()) return false;
        }
        if (sectors_.size() == 3) {
            merge_three();
        } else {
            merge_straight();
        }
        write();
        return true;
    }
    //! Those of remove(): first the flips, then the one or two faces that were made.
    [[nodiscard]] std::span<const FaceOperation> operations() const { return operations_; }
    //! The neighbours, before the removal.
    [[nodiscard]] std::span<const Index> corners() const { return corners_; }

private:
    // A share of the faces' size: straight lines bend by this at most, by rounding.
    static constexpr double straight_enough = 1e-14;

    // The side of a face opposite to the vertex, and its neighbour beyond.
    struct Rim {
        Index twin, edge;
        Index number;  // Its index in the first ring; no_index: a diagonal.
        Vec2 along;
        Vec2 turn;  // Turns vectors of the chart beyond into the chart of the ring's first face.
    };
    // A face at the vertex and its edge from the vertex.
    struct Sector {
        Index half_edge;  // Leaves the vertex.
        Index spoke_edge;
        Index head;
        Vec2 spoke;  // In the chart of the first face.
        Rim rim;
    };
    // A face of the result.
    struct Made {
        Index face;
        Triangle corners;
        std::array<Rim, 3> side;
    };

    // False if a face has the vertex at two corners.
    bool lay() {
        sectors_.clear();
        corners_.clear();
        turns_.clear();
        Vec2 turn(1, 0);
        bool is_glued = false;
        for (const Index h : half_edge_) {
            const Triangle& t = surface_.mesh.triangles[Surface::face(h)];
            if ((t[0] == vertex_) + (t[1] == vertex_) + (t[2] == vertex_) != 1) return false;
            const FaceChart chart = charts_.peek(Surface::face(h));
            const Index across = Surface::next(h);
            const auto number = static_cast<Index>(sectors_.size());
            const Index twin = surface_.twin[across];
            for (const Index other : half_edge_)
                is_glued = is_glued || Surface::next(other) == twin;
            sectors_.push_back(
                {h,
                 surface_.edge[h],
                 surface_.head(h),
                 turned_by(chart.side[h % 3], turn),
                 {twin, surface_.edge[across], number, turned_by(chart.side[across % 3], turn),
                  turned_by(chart.turn[across % 3], turn).normalized()}});
            corners_.push_back(sectors_.back().head);
            turns_.push_back(turn);
            turn = turned_by(chart.turn[Surface::previous(h) % 3], turn).normalized();
        }
        is_glued_ = is_glued;
        if (is_glued) turn_glued_rims();
        return true;
    }

    // All new faces get the chart of the first. A face beyond a rim may be in the ring, too.
    void turn_glued_rims() {
        for (Sector& sector : sectors_) {
            for (std::size_t k = 0; k < half_edge_.size(); ++k) {
                if (sector.rim.twin != Surface::next(half_edge_[k])) continue;
                sector.rim.turn = turned_by(sector.rim.turn, conjugate(turns_[k])).normalized();
            }
        }
    }

    // Rotates the ring so that its first and third edge are one line, if there are such edges.
    bool straighten() {
        for (std::size_t first = 0; first < 2; ++first) {
            const Vec2 &a = sectors_[first].spoke, &b = sectors_[first + 2].spoke;
            const double size =
                std::max(sectors_[first + 1].spoke.norm(), sectors_[(first + 3) % 4].spoke.norm());
            if (a.dot(b) < 0 && std::abs(cross(a, b)) <= straight_enough * size * (a - b).norm()) {
                if (first == 1) std::rotate(sectors_.begin(), sectors_.begin() + 1, sectors_.end());
                return true;
            }
        }
        return false;
    }

    // Flips the edge at the vertex whose flip gives the best triangle (d, b, c) without the vertex.
    // The two sectors beside the flipped edge become one.
    bool flip_away() {
        const std::size_t count = sectors_.size();
        const auto quad_of = [&](std::size_t i) -> Quad {
            return {sectors_[i].spoke, sectors_[(i + 1) % count].spoke,
                    sectors_[(i + count - 1) % count].spoke};
        };
        std::size_t best = count;
        double best_quality = -1;
        for (std::size_t i = 0; i < count; ++i) {
            const Quad quad = quad_of(i);
            const double quality = quad.quality_behind();
            if (!(quality > best_quality) || !quad.is_convex()) continue;
            best_quality = quality;
            best = i;
        }
        if (best == count) return false;
        const Quad quad = quad_of(best);
        Sector& after = sectors_[best];
        Sector& before = sectors_[(best + count - 1) % count];
        const Index near = Surface::face(before.half_edge), far = Surface::face(after.half_edge);
        const Index c = sectors_[(best + 1) % count].head;
        operations_.push_back(
            FaceFlip{after.half_edge, Surface::previous(before.half_edge), quad.shares()});
        const Vec2 diagonal = quad.apex - quad.across;
        const Index edge = after.spoke_edge;
        made_.push_back(
            {near,
             {before.head, after.head, c},
             {before.rim, after.rim, Rim{no_index, edge, no_index, -diagonal, Vec2(1, 0)}}});
        before.half_edge = 3 * far;
        before.rim = {3 * near + 2, edge, no_index, diagonal, Vec2(1, 0)};
        sectors_.erase(sectors_.begin() + static_cast<std::ptrdiff_t>(best));
        return true;
    }

    void merge_three() {
        FaceMerge merged;
        Made made{Surface::face(sectors_[0].half_edge), {}, {}};
        merged.face = made.face;
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Sector& sector = sectors_[k];
            merged.half_edge[k] = Surface::next(sector.half_edge);
            merged.shares[k] =
                std::max(cross(sectors_[(k + 1) % 3].spoke, sectors_[(k + 2) % 3].spoke), 0.0);
            sum += merged.shares[k];
            made.corners[k] = sector.head;
            made.side[k] = sector.rim;
            gone_edges_.push_back(sector.spoke_edge);
        }
        for (double& share : merged.shares) share /= sum;
        operations_.emplace_back(merged);
        made_.push_back(made);
    }

    void merge_straight() {
        const Index a = Surface::face(sectors_[0].half_edge),
                    b = Surface::face(sectors_[2].half_edge);
        const double near = sectors_[0].spoke.norm(), far = sectors_[2].spoke.norm();
        const double share = far / (near + far);  // Of the first spoke's end.
        std::array<Index, 4> side;
        for (std::size_t k = 0; k < 4; ++k) side[k] = Surface::next(sectors_[k].half_edge);
        operations_.push_back(FaceMerge{a, {side[0], side[1], no_index}, {share, 0, 1 - share}});
        operations_.push_back(FaceMerge{b, {side[2], side[3], no_index}, {1 - share, 0, share}});
        for (std::size_t k = 1; k < 4; ++k) gone_edges_.push_back(sectors_[k].spoke_edge);
        const Index line = sectors_[0].spoke_edge;
        const Vec2 across = sectors_[0].spoke - sectors_[2].spoke;
        made_.push_back({a,
                         {sectors_[0].head, sectors_[1].head, sectors_[2].head},
                         {sectors_[0].rim, sectors_[1].rim,
                          Rim{3 * b + 2, line, no_index, across, Vec2(1, 0)}}});
        made_.push_back({b,
                         {sectors_[2].head, sectors_[3].head, sectors_[0].head},
                         {sectors_[2].rim, sectors_[3].rim,
                          Rim{no_index, line, no_index, -across, Vec2(1, 0)}}});
    }

    void write() {
        for (const Index e : gone_edges_) surface_.edge_half[e] = no_index;
        for (const Index h : half_edge_) {
            const Index face = Surface::face(h);
            forget_outgoing(surface_, std::span(&face, 1));
        }
        for (const Index h : half_edge_) bury(surface_, Surface::face(h));
        rim_places_.resize(half_edge_.size());
        for (const Made& made : made_) {
            surface_.mesh.triangles[made.face] = made.corners;
            for (Index k = 0; k < 3; ++k) {
                const Index number = made.side[k].number;
                if (number != no_index) rim_places_[number] = 3 * made.face + k;
            }
        }
        for (const Made& made : made_) write_sides(made);
        for (const Index h : half_edge_) {
            const Index face = Surface::face(h);
            if (surface_.mesh.triangles[face][0] == no_index) charts_.forget(face);
        }
        for (const Made& made : made_) {
            FaceChart chart;
            for (std::size_t k = 0; k < 3; ++k) {
                chart.side[k] = made.side[k].along;
                chart.turn[k] = made.side[k].turn;
            }
            charts_.set(made.face, chart);
            set_apexes(surface_, made.face, chart);
        }
        for (const Made& made : made_) {
            charts_.share_turns(made.face);
            renew_outgoing(surface_, std::span(&made.face, 1));
        }
    }

    void write_sides(const Made& made) {
        for (Index k = 0; k < 3; ++k) {
            const Rim& rim = made.side[k];
            const Index h = 3 * made.face + k;
            if (rim.number != no_index) {
                join(surface_, h, is_glued_ ? twin_now(rim.twin) : rim.twin, rim.edge);
                continue;
            }
            surface_.edge[h] = rim.edge;
            surface_.length[rim.edge] = rim.along.norm();
            if (rim.twin != no_index) join(surface_, h, rim.twin, rim.edge);
        }
    }

    // The present half-edge for one that may have been a rim of the ring.
    Index twin_now(Index half_edge) const {
        for (std::size_t k = 0; k < half_edge_.size(); ++k) {
            if (Surface::next(half_edge_[k]) == half_edge) return rim_places_[k];
        }
        return half_edge;
    }

    Surface& surface_;
    FaceCharts& charts_;
    Index vertex_ = no_index;
    std::vector<Index> half_edge_, corners_;
    std::vector<Vec2> turns_;  // Turn vectors of each face's chart into that of the first face.
    std::vector<Index> rim_places_;  // By number of a rim: where it lies now.
    std::vector<Sector> sectors_;
    std::vector<FaceOperation> operations_;
    std::vector<Made> made_;
    std::vector<Index> gone_edges_;
    bool is_glued_ = false;  // Whether a rim is the twin of another one.
};

}  // namespace agvd::detail
