//! \file
//! What of the cells is connected with its site, while faces are still traced.
#pragma once

#include <array>
#include <vector>

#include "agvd/core/union_find.h"
#include "agvd/diagram/arcs.h"
#include "agvd/diagram/edge_labels.h"

namespace agvd {

//! Unites points and stretches of one label that touch (nodes of EdgeLabels), face by face. Sets
//! that hold a site of their label are mainland; what is not when all faces are traced is an
//! island. Cost: quick steps, for each face as many as it has nodes.
class Mainland {
public:
    //! Keeps references.
    Mainland(const Surface& surface, const EdgeLabels& labels)
        : surface_(surface), labels_(labels), sets_(0) {}

    //! A face in one cell.
    void add_plain_face(Index face) {
        grow();
        const Triangle& corners = surface_.mesh.triangles[face];
        unite(corners[0], corners[1]);
        unite(corners[1], corners[2]);
    }

    //! A mixed face that was traced.
    void add_traced_face(Index face, std::span<const Connection> connections) {
        grow();
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (labels_.edge_rows[surface_.edge[h]].count > 0) continue;
            unite(surface_.tail(h), surface_.head(h));
        }
        for_each_cut(face, [&](const Cut& cut) {
            if (cut.row.count == 0) unite(cut.from.point, cut.to.point);
        });
        for (const Connection& c : connections) unite(c.a, c.b);
    }

    //! A node that holds a point of its site.
    void add_site(Index node) {
        grow();
        is_mainland_[sets_.root(node)] = 1;
    }

    //! Whether no part of a mixed face that was traced can be found to be on an island.
    [[nodiscard]] bool holds(Index face) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index edge = surface_.edge[h];
            const Index along = surface_.edge_half[edge];
            if (!holds_row(labels_.edge_rows[edge], surface_.tail(along), surface_.head(along))) {
                return false;
            }
        }
        bool all = true;
        for_each_cut(face, [&](const Cut& cut) {
            all = all && holds_row(cut.row, cut.from.point, cut.to.point);
        });
        return all;
    }

    [[nodiscard]] std::size_t num_nodes() const { return is_mainland_.size(); }

private:
    void grow() {
        sets_.grow(labels_.num_nodes());
        is_mainland_.resize(labels_.num_nodes(), 0);
    }

    void unite(Index a, Index b) {
        const bool is_either = is_on_mainland(a) || is_on_mainland(b);
        if (sets_.unite(a, b) && is_either) is_mainland_[sets_.root(a)] = 1;
    }

    [[nodiscard]] bool is_on_mainland(Index node) { return is_mainland_[sets_.root(node)] != 0; }

    [[nodiscard]] bool holds_row(const Block& row, Index from, Index to) {
        bool all = is_on_mainland(from) && is_on_mainland(to);
        for_each_crossing(labels_, row, from, to, [&](Index, Index, Index, Index after, Index) {
            all = all && is_on_mainland(after);
        });
        return all;
    }

    template <typename Each>
    void for_each_cut(Index face, const Each& each) const {
        for (const CutTriangle& triangle : cut_triangles_of(labels_, face)) {
            for (const LineId& side : triangle.sides) {
                if (side.is_cut()) each(labels_.cuts[side.cut()]);
            }
        }
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    UnionFind sets_;                         // Of nodes.
    std::vector<std::uint8_t> is_mainland_;  // By root.
};

}  // namespace agvd
