// A position is known by the number of its first vertex.
#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/clean/soup.h"
#include "remesh/curves/glue.h"
#include "remesh/pipeline/region.h"

namespace remesh::detail {
namespace {

class RegionCutter {
public:
    RegionCutter(const MeshView& mesh, std::span<const std::uint8_t> is_marked,
                 const CleanOptions& cleaning)
        : mesh_(mesh),
          cleaning_(cleaning),
          poller_(cleaning.progress),
          ticker_(poller_),
          position_(first_at_position(mesh.positions, ticker_)),
          is_inside_(is_marked.begin(), is_marked.end()),
          is_outer_position_(mesh.positions.size(), false) {
        check_elements(mesh, ticker_);
        find_flat_faces();
    }

    Region run() {
        while (true) {
            Region region = divide();
            if (flat_.empty()) return region;
            if (!keep_flat_faces(find_torn(region))) return region;
        }
    }

private:
    Region divide() {
        Region region;
        std::vector<Index> faces;
        for (Index f = 0; f < is_inside_.size(); ++f) {
            (is_inside_[f] != 0 ? faces : region.kept).push_back(f);
        }
        if (std::ranges::none_of(faces, [&](Index f) { return has_area(f); })) {
            throw InvalidOption(
                "the region has no face with an area; mark the faces to remesh with other values "
                "than 0");
        }
        static_cast<MeshPart&>(region) = take_faces(mesh_, std::move(faces), ticker_);
        find_rim(region);
        return region;
    }

    [[nodiscard]] bool has_area(Index face) const {
        return smallest_doubled_area(mesh_.positions, mesh_.triangles[face]) > 0;
    }
    [[nodiscard]] Triangle positions_of(Index face) const {
        const auto& [a, b, c] = mesh_.triangles[face];
        return {position_[a], position_[b], position_[c]};
    }

    // Calls each(key) for the edges of a face, between positions.
    template <typename Each>
    void for_each_edge_of(const Triangle& positions, const Each& each) const {
        for (std::size_t k = 0; k < 3; ++k) {
            each(edge_key(positions[k], positions[(k + 1) % 3]));
        }
    }

    void find_flat_faces() {
        for (Index f = 0; f < is_inside_.size(); ++f) {
            ticker_.tick();
            const Triangle t = positions_of(f);
            if (is_inside_[f] == 0) {
                for (const Index p : t) is_outer_position_[p] = true;
            } else if (!has_area(f)) {
                for (const Index p : t) flat_.emplace_back(edge_key(p, p), f);
                for_each_edge_of(t, [&](std::uint64_t edge) { flat_.emplace_back(edge, f); });
            }
        }
        std::sort(flat_.begin(), flat_.end());
    }

    // Vertices (edge_key(v, v)) and edges of the rim that cleaning the region loses.
    [[nodiscard]] std::vector<std::uint64_t> find_torn(const Region& region) {
        const CleanResult clean = clean_input(region.mesh.view(), cleaning_);
        const auto position_of = [&](Index v) { return position_[region.vertices[v]]; };
        std::vector<std::uint64_t> left;
        for (const auto& [a, b, c] : clean.mesh.triangles) {
            ticker_.tick();
            const std::vector<Index>& origin = clean.vertex_origin;
            const Triangle t{position_of(origin[a]), position_of(origin[b]),
                             position_of(origin[c])};
            for (const Index p : t) left.push_back(edge_key(p, p));
            for_each_edge_of(t, [&](std::uint64_t edge) { left.push_back(edge); });
        }
        std::sort(left.begin(), left.end());
        std::vector<std::uint64_t> torn;
        const auto require = [&](Index a, Index b) {
            const std::uint64_t edge = edge_key(position_of(a), position_of(b));
            if (!std::binary_search(left.begin(), left.end(), edge)) torn.push_back(edge);
        };
        for (const RimVertex& rim : region.rim) require(rim.vertex, rim.vertex);
        for (const auto& [a, b] : region.rim_edges) require(a, b);
        return torn;
    }

    // Faces without area there are not remeshed either, nor those that they are joined to.
    // \return whether there are any.
    bool keep_flat_faces(std::vector<std::uint64_t> edges) {
        bool is_changed = false;
        while (!edges.empty()) {
            ticker_.tick();
            const std::uint64_t edge = edges.back();
            edges.pop_back();
            auto here = std::lower_bound(flat_.begin(), flat_.end(), std::pair(edge, Index{0}));
            for (; here != flat_.end() && here->first == edge; ++here) {
                if (is_inside_[here->second] == 0) continue;
                is_inside_[here->second] = 0;
                is_changed = true;
                const Triangle t = positions_of(here->second);
                for (const Index p : t) is_outer_position_[p] = true;
                for_each_edge_of(t, [&](std::uint64_t other) { edges.push_back(other); });
            }
        }
        return is_changed;
    }

    void find_rim(Region& region) {
        const std::vector<Index>& number = region.number;
        std::vector<Index> inner(mesh_.positions.size(),
                                 no_index);  // By position: a vertex inside.
        for (const Index v : region.vertices) {
            if (inner[position_[v]] == no_index) inner[position_[v]] = v;
        }
        std::vector<Index> shared(mesh_.positions.size(), no_index);  // By position.
        const auto share = [&](Index v) {
            shared[position_[v]] = std::min(shared[position_[v]], v);
        };
        const auto is_on_rim = [&](Index p) {
            return is_outer_position_[p] && inner[p] != no_index;
        };
        std::vector<EdgeSide> sides;  // Of edges between positions of the rim.
        for (Index f = 0; f < is_inside_.size(); ++f) {
            ticker_.tick();
            for (Index k = 0; k < 3; ++k) {
                const Index v = mesh_.triangles[f][k];
                if (is_inside_[f] == 0 && number[v] != no_index) share(v);
                const Index a = position_[v], b = position_[mesh_.triangles[f][(k + 1) % 3]];
                if (a == b || !is_on_rim(a) || !is_on_rim(b)) continue;
                sides.push_back({edge_key(a, b), 3 * f + k, a < b});
            }
        }
        sides = sort_edge_sides(sides, static_cast<Index>(position_.size()), ticker_);
        for_each_edge(std::span<const EdgeSide>(sides), [&](std::span<const EdgeSide> edge) {
            const std::array ends{number[inner[edge[0].low()]], number[inner[edge[0].high()]]};
            const auto is_inside = [&](const EdgeSide& side) {
                return is_inside_[side.face()] != 0;
            };
            const auto outer = std::ranges::find_if_not(edge, is_inside);
            if (outer == edge.end()) {
                if (edge.size() > 2) region.branched_edges.push_back(ends);
                return;
            }
            if (std::ranges::none_of(edge, is_inside)) return;
            region.rim_edges.push_back(ends);
            // A crack: cleaning would weld it.
            if (edge.size() == 2) {
                const Triangle& t = mesh_.triangles[outer->face()];
                share(t[outer->half_edge % 3]);
                share(t[(outer->half_edge + 1) % 3]);
            }
        });
        for (Index p = 0; p < inner.size(); ++p) {
            if (is_on_rim(p)) region.rim.push_back({number[inner[p]], shared[p]});
        }
        std::ranges::sort(region.rim, {}, &RimVertex::vertex);
    }

    const MeshView& mesh_;
    const CleanOptions& cleaning_;
    Poller poller_;
    Ticker ticker_;
    const std::vector<Index> position_;    // #V
    std::vector<std::uint8_t> is_inside_;  // #F
    std::vector<bool> is_outer_position_;  // By position: a corner of a kept face.
    // (edge or vertex, marked face without area there); sorted.
    std::vector<std::pair<std::uint64_t, Index>> flat_;
};

}  // namespace

MeshPart take_faces(const MeshView& mesh, std::vector<Index> faces, Ticker& ticker) {
    MeshPart part;
    for_each_ticked(faces, ticker,
                    [&](Index f) { part.mesh.triangles.push_back(mesh.triangles[f]); });
    part.vertices = drop_unused(static_cast<Index>(mesh.positions.size()), part.mesh.triangles);
    part.mesh.positions = take(mesh.positions, part.vertices);
    part.number.assign(mesh.positions.size(), no_index);
    for (Index v = 0; v < part.vertices.size(); ++v) part.number[part.vertices[v]] = v;
    part.faces = std::move(faces);
    return part;
}

Region cut_region(const MeshView& mesh, std::span<const std::uint8_t> is_marked,
                  const CleanOptions& cleaning) {
    return RegionCutter(mesh, is_marked, cleaning).run();
}

}  // namespace remesh::detail
