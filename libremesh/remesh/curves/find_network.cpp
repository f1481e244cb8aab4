// A side continues along the next edge of the network in the same fan of faces. A second pass ends
// curves at their corners.
#include <algorithm>
#include <numeric>

#include "agvd/mesh/surface.h"
#include "remesh/curves/curve_network.h"

namespace remesh {
namespace {

// Copies of an edge or a vertex at a junction are named by the first copy.
class NetworkFinder {
public:
    NetworkFinder(const Surface& surface, std::span<const std::uint8_t> is_crease,
                  const JunctionSet& junctions, const LockedElements& locked)
        : surface_(surface),
          junctions_(junctions),
          locked_(locked),
          first_copy_(first_copies(junctions, surface.num_vertices())),
          first_edge_(surface.num_edges()),
          is_outside_(surface.num_edges(), 1),
          degree_(surface.num_vertices(), 0),
          other_copies_(list_other_copies()) {
        std::iota(first_edge_.begin(), first_edge_.end(), Index{0});
        for (const std::vector<Index>& copies : junctions.edges) {
            for (const Index e : copies) first_edge_[e] = copies.front();
        }
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const bool is_alone = first_edge_[e] == e && !is_boundary(e) && is_crease[e] == 0;
            if (is_alone && !is_junction(e)) continue;
            is_outside_[e] = 0;
            if (first_edge_[e] != e) continue;
            ++degree_[tail(e)];
            ++degree_[head(e)];
        }
    }

    // \param is_node  #V: 1 for vertices that become nodes in any case.
    CurveNetwork run(std::span<const std::uint8_t> is_node) {
        CurveNetwork network;
        network.junctions = junctions_.in_result;
        const std::vector<bool> is_end = find_ends();
        node_.assign(surface_.num_vertices(), no_index);
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (is_node[v] == 0 && (degree_[v] == 0 || (degree_[v] == 2 && !is_end[v]))) continue;
            node_[v] = static_cast<Index>(network.nodes.size());
            network.nodes.push_back(v);
        }
        for (const auto& [first, copy] : other_copies_) {
            if (node_[first] != no_index) network.copies.emplace_back(copy, node_[first]);
        }
        std::sort(network.copies.begin(), network.copies.end());
        std::vector<std::uint8_t> is_done = is_outside_;
        for (const Index v : network.nodes) {
            for_each_edge(v, [&](Index e) {
                if (is_done[e] == 0) network.curves.push_back(follow(e, v, is_done));
            });
        }
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            if (is_done[e] == 0) network.curves.push_back(follow(e, tail(e), is_done));
        }
        return network;
    }

    [[nodiscard]] Index first_copy(Index vertex) const { return first_copy_[vertex]; }

    // Whether the sides of a closed curve are exchanged once around it.
    [[nodiscard]] bool is_twisted(const Curve& curve) const {
        return curve.is_closed() &&
               std::any_of(curve.sides.begin(), curve.sides.end(), [&](const CurveSide& side) {
                   return after(side.half_edges.back(), side.runs_along) != side.half_edges.front();
               });
    }

private:
    [[nodiscard]] bool is_boundary(Index e) const {
        return surface_.twin[surface_.edge_half[e]] == no_index;
    }
    [[nodiscard]] Index tail(Index e) const {
        return first_copy_[surface_.tail(surface_.edge_half[e])];
    }
    [[nodiscard]] Index head(Index e) const {
        return first_copy_[surface_.head(surface_.edge_half[e])];
    }

    // All copies of an edge, itself included.
    [[nodiscard]] std::span<const Index> copies_of(const Index& edge) const {
        const Index first = first_edge_[edge];
        const auto found = std::lower_bound(
            junctions_.edges.begin(), junctions_.edges.end(), first,
            [](const std::vector<Index>& copies, Index e) { return copies.front() < e; });
        if (found == junctions_.edges.end() || found->front() != first) return {&edge, 1};
        return *found;
    }
    [[nodiscard]] bool is_junction(Index edge) const { return copies_of(edge).size() > 1; }

    [[nodiscard]] std::vector<std::pair<Index, Index>> list_other_copies() const {
        std::vector<std::pair<Index, Index>> result;  // (first copy, other copy)
        for (const std::vector<Index>& copies : junctions_.vertices) {
            for (const Index v : copies) {
                if (v != copies.front()) result.emplace_back(copies.front(), v);
            }
        }
        std::sort(result.begin(), result.end());
        return result;
    }

    // Calls each(first copy of an edge) for the network's edges at a vertex and its copies; an edge
    // may come twice.
    template <typename Each>
    void for_each_edge(Index vertex, const Each& each) const {
        const auto at_copy = [&](Index v) {
            for_each_edge_at(surface_, v, [&](Index h, Index) {
                const Index e = surface_.edge[h];
                if (is_outside_[e] == 0) each(first_edge_[e]);
            });
        };
        at_copy(vertex);
        for (auto other = std::lower_bound(other_copies_.begin(), other_copies_.end(),
                                           std::pair(vertex, Index{0}));
             other != other_copies_.end() && other->first == vertex; ++other) {
            at_copy(other->second);
        }
    }

    // The half-edge of a side after one of its half-edges.
    [[nodiscard]] Index after(Index half_edge, bool runs_along) const {
        const auto turn = [&](Index h) {
            return runs_along ? Surface::next(h) : Surface::previous(h);
        };
        Index h = turn(half_edge);
        while (is_outside_[surface_.edge[h]] != 0) h = turn(surface_.twin[h]);
        return h;
    }

    // The sides of a curve that begins with an edge at a vertex.
    [[nodiscard]] std::vector<CurveSide> sides_at(Index edge, Index from) const {
        std::vector<CurveSide> sides;
        Index sheet = 0;
        for (const Index e : copies_of(edge)) {
            const Index h = surface_.edge_half[e], twin = surface_.twin[h];
            const bool runs_along = first_copy_[surface_.tail(h)] == from;
            sides.push_back({{h}, runs_along, sheet});
            if (twin != no_index) sides.push_back({{twin}, !runs_along, sheet});
            ++sheet;
        }
        std::stable_sort(sides.begin(), sides.end(), [](const CurveSide& a, const CurveSide& b) {
            return a.runs_along && !b.runs_along;
        });
        return sides;
    }

    // Vertices between two edges of the network where the sides of the one do not all continue in
    // the other, or two sides of one sheet do not continue in one sheet.
    [[nodiscard]] std::vector<bool> find_ends() const {
        std::vector<bool> is_end(surface_.num_vertices(), false);
        for (const std::vector<Index>& copies : junctions_.edges) {
            const Index e = copies.front();
            for (const Index v : {tail(e), head(e)}) {
                is_end[v] = is_end[v] || (degree_[v] == 2 && !goes_on(e, v));
            }
        }
        return is_end;
    }
    [[nodiscard]] bool goes_on(Index edge, Index at) const {
        Index other = no_index;
        for_each_edge(at, [&](Index e) {
            if (e != first_edge_[edge]) other = e;
        });
        const std::vector<CurveSide> sides = sides_at(edge, other_end(edge, at));
        if (sides_at(other, at).size() != sides.size()) return false;
        return std::all_of(sides.begin(), sides.end(), [&](const CurveSide& side) {
            const Index h = side.half_edges[0], next = after(h, side.runs_along);
            const Index twin = surface_.twin[h];
            const Index across = twin == no_index ? no_index : after(twin, !side.runs_along);
            return first_edge_[surface_.edge[next]] == other && surface_.twin[next] == across;
        });
    }
    [[nodiscard]] Index other_end(Index e, Index v) const {
        return tail(e) == v ? head(e) : tail(e);
    }

    // Follows a curve from a vertex to the next node, or once around.
    Curve follow(Index edge, Index from, std::vector<std::uint8_t>& is_done) const {
        Curve curve;
        curve.begin = node_[from];
        curve.up_to.push_back(0);
        curve.sides = sides_at(edge, from);
        curve.num_sheets = static_cast<Index>(copies_of(edge).size());
        curve.is_locked = locked_.has_edge(edge);
        for (Index at = from;;) {
            for (const Index e : copies_of(edge)) is_done[e] = 1;
            curve.up_to.push_back(curve.up_to.back() + surface_.length[edge]);
            at = other_end(edge, at);
            curve.end = node_[at];
            if (curve.end != no_index) break;
            edge = no_index;
            for_each_edge(at, [&](Index e) {
                if (is_done[e] == 0) edge = e;
            });
            if (edge == no_index) break;
            for (CurveSide& side : curve.sides) {
                side.half_edges.push_back(after(side.half_edges.back(), side.runs_along));
            }
        }
        return curve;
    }

    const Surface& surface_;
    const JunctionSet& junctions_;
    const LockedElements& locked_;
    const std::vector<Index> first_copy_;   // #V
    std::vector<Index> first_edge_;         // #E
    std::vector<std::uint8_t> is_outside_;  // #E: 0 for the network's edges.
    std::vector<Index> degree_;             // #V: edges of the network, at first copies.
    const std::vector<std::pair<Index, Index>> other_copies_;  // (first copy, other copy)
    std::vector<Index> node_;                                  // #V
};

}  // namespace

CurveNetwork find_network(const Surface& surface, std::span<const std::uint8_t> is_crease,
                          double spacing, const JunctionSet& junctions,
                          const LockedElements& locked, const UnitAt& unit_at) {
    NetworkFinder finder(surface, is_crease, junctions, locked);
    std::vector<std::uint8_t> is_node(surface.num_vertices(), 0);
    for (const Index v : locked.vertices) is_node[finder.first_copy(v)] = 1;
    const CurveNetwork smooth = finder.run(is_node);
    for (const Curve& curve : smooth.curves) {
        if (curve.is_locked) continue;
        for (const std::size_t i : corners_of_curve(surface, curve, spacing, unit_at)) {
            is_node[finder.first_copy(curve.vertex(surface, i))] = 1;
        }
        if (finder.is_twisted(curve)) is_node[finder.first_copy(curve.vertex(surface, 0))] = 1;
    }
    return finder.run(is_node);
}

}  // namespace remesh
