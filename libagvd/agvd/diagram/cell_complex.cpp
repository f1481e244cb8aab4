// Around most triangles the label changes two or three times. Then the labels alone tell which
// cells meet inside: no Voronoi vertex or one. Only the others are traced.
#include <algorithm>

#include "agvd/core/union_find.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

using Sides = std::array<SideRow, 3>;

Index num_changes(const Sides& sides) {
    return sides[0].row.count + sides[1].row.count + sides[2].row.count;
}

class ComplexBuilder {
public:
    explicit ComplexBuilder(LabelledMesh& mesh)
        : in_(mesh.input),
          parts_(mesh.parts),
          all_(mesh.all),
          is_traced_(mesh.all.size(), 0),
          ticker_(mesh.poller) {}

    // Traces the faces with triangles around which labels change more than three times.
    void trace_some() {
        std::vector<Index> positions, half_edges;
        do {
            positions.clear();
            for_each_face([&](Index i, std::span<const CutTriangle> cut) {
                for_each_triangle(i, cut, [&](Index, const Sides& sides) {
                    if (num_changes(sides) > 3) is_traced_[i] = 1;
                });
                if (is_traced_[i] != 0) positions.push_back(i);
            });
            half_edges.clear();
            for (const Index i : positions) {
                const Index h = 3 * in_.propagation.mixed_faces[i];
                half_edges.insert(half_edges.end(), {h, h + 1, h + 2});
            }
            find_guessed(in_, half_edges, parts_.labels);
        } while (!half_edges.empty());
        trace_faces(in_, positions, parts_);
    }

    void trace_all() {
        trace_faces(in_, all_, parts_);
        parts_.boundary_loops = boundary_loops(surface_);
        parts_.joined = join_arcs(labels_, parts_.arcs, ticker_);
        (void)absorb_islands(in_, parts_);
        is_traced_.assign(all_.size(), 1);
    }

    // Whether all points and stretches of one label are connected with a site of it.
    [[nodiscard]] bool is_connected() {
        UnionFind sets(labels_.num_nodes());
        for_each_line([&](const Block& row, Index from, Index to) {
            if (row.count == 0) sets.unite(from, to);
        });
        for (const Connection& c : parts_.arcs.connections) sets.unite(c.a, c.b);
        std::vector<std::uint8_t> is_mainland(labels_.num_nodes(), 0);
        const Index first_inner = surface_.num_vertices();
        for (Index i = 0; i < labels_.inner_points.size(); ++i) {
            is_mainland[sets.root(first_inner + i)] = 1;
        }
        for (Index i = 0; i < in_.points.size(); ++i) {
            const Index node = holder_of(in_, labels_, i);
            if (node != no_index) {
                is_mainland[sets.root(node)] = 1;
            } else if (cut_triangles_of(labels_, in_.points[i].face.value()).empty()) {
                // A face that was not cut has a corner of the site, see faces_to_cut().
                for (const Index v : surface_.mesh.triangles[in_.points[i].face.value()]) {
                    if (labels_.point_site[v] == in_.site_of_point[i]) {
                        is_mainland[sets.root(v)] = 1;
                    }
                }
            }
        }
        bool result = true;
        const auto check = [&](Index node) { result &= is_mainland[sets.root(node)] != 0; };
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (labels_.point_site[v] != no_index) check(v);
        }
        for_each_line([&](const Block& row, Index, Index) {
            for (Index c = row.begin; c + 1 < row.end(); ++c) check(labels_.node_after(c));
        });
        return result;
    }

    [[nodiscard]] CellComplex write() {
        CellComplex out;
        out.num_sites = parts_.num_sites;
        out.cell_euler.assign(out.num_sites, 0);
        out.has_cell.assign(out.num_sites, 0);
        count_points_and_edges(surface_, labels_, out.cell_euler);
        const auto add = [&](Index site, int pieces) {
            if (site == no_index) return;
            out.cell_euler[site] += pieces;
            out.has_cell[site] = 1;
        };
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            if (labels_.mixed_index[f] != no_index) continue;
            add(labels_.point_site[surface_.mesh.triangles[f][0]], 1);
        }
        for_each_face([&](Index i, std::span<const CutTriangle> cut) {
            const FaceId face(in_.propagation.mixed_faces[i]);
            if (is_traced_[i] == 0) {
                for_each_triangle(i, cut, [&](Index site, const Sides& sides) {
                    add_triangle(site, sides, face, add, out);
                });
                return;
            }
            const Arcs& arcs = parts_.arcs;
            for (const CellPart& part : elements_of(arcs.parts, arcs.faces[i].parts)) {
                add(part.site, part.pieces);
            }
            for (const VoronoiVertex& vertex :
                 elements_of(arcs.voronoi_vertices, arcs.faces[i].voronoi_vertices)) {
                const auto& [a, b, c] = vertex.sites;
                out.vertex_sites.push_back({SiteId(a), SiteId(b), SiteId(c)});
                out.vertex_face.push_back(face);
            }
        });
        out.nearest_site.resize(surface_.num_vertices());
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            out.nearest_site[v] = SiteId(labels_.point_site[v]);
        }
        out.has_hidden_change.resize(surface_.num_edges(), 0);
        Index e = 0;
        for_each_line([&](const Block& row, Index from, Index to) {
            if (e >= surface_.num_edges()) return;  // A cut.
            const Index known = labels_.point_site[from] == labels_.point_site[to] ? 0 : 1;
            out.has_hidden_change[e++] = row.count > known ? 1 : 0;
        });
        return out;
    }

private:
    // Calls each(position, triangles if it is cut) for the mixed faces.
    template <typename Each>
    void for_each_face(const Each& each) {
        auto cut = labels_.cut_faces.begin();
        for (const Index i : all_) {
            ticker_.tick();
            if (cut == labels_.cut_faces.end() || cut->face != in_.propagation.mixed_faces[i]) {
                each(i, std::span<const CutTriangle>());
            } else {
                each(i, elements_of(labels_.cut_triangles, cut++->triangles));
            }
        }
    }

    // Calls each(site at the first corner, sides) for the triangles of a mixed face.
    template <typename Each>
    void for_each_triangle(Index i, std::span<const CutTriangle> cut, const Each& each) {
        const auto sides_of = [&](const auto& side) { return Sides{side(0), side(1), side(2)}; };
        if (cut.empty()) {
            const Index h = 3 * in_.propagation.mixed_faces[i];
            each(labels_.point_site[surface_.tail(h)],
                 sides_of([&](Index k) { return row_along(surface_, labels_, h + k); }));
        }
        for (const CutTriangle& triangle : cut) {
            each(labels_.point_site[triangle.points[0].point],
                 sides_of([&](Index k) { return row_along(surface_, labels_, triangle, k); }));
        }
    }

    // Calls each(row, from, to) for all edges and cuts with the points at their ends.
    template <typename Each>
    void for_each_line(const Each& each) {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const Index h = surface_.edge_half[e];
            each(labels_.edge_rows[e], surface_.tail(h), surface_.head(h));
        }
        for (const Cut& cut : labels_.cuts) each(cut.row, cut.from.point, cut.to.point);
    }

    // A triangle around which labels change three times at most.
    template <typename Add>
    void add_triangle(Index site, const Sides& sides, FaceId face, const Add& add,
                      CellComplex& out) {
        std::array<SiteId, 3> after;
        std::size_t count = 0;
        for (const auto& [row, forward] : sides) {
            for (Index j = 0; j < row.count; ++j) {
                const Index c = forward ? row.begin + j : row.end() - 1 - j;
                const Crossing& crossing = labels_.crossings[c];
                const Index next = forward ? crossing.site_after : crossing.site_before;
                after[count++] = SiteId(next);
                add(next, 1);
            }
        }
        if (count == 0) add(site, 1);
        if (count < 3) return;
        out.vertex_sites.push_back(after);
        out.vertex_face.push_back(face);
    }

    const StageInput& in_;
    const Surface& surface_ = in_.surface;
    DiagramParts& parts_;
    const EdgeLabels& labels_ = parts_.labels;
    std::span<const Index> all_;
    std::vector<std::uint8_t> is_traced_;  // By position.
    Ticker ticker_;
};

}  // namespace

CellComplex build_cell_complex(const Surface& surface, std::span<const SurfacePoint> sites,
                               const Propagation& propagation, const DiagramOptions& given) {
    DiagramOptions options = given;
    options.chord.reset();
    {
        LabelledMesh mesh(surface, sites, propagation, options, true);
        ComplexBuilder builder(mesh);
        builder.trace_some();
        if (builder.is_connected()) return builder.write();
    }
    LabelledMesh mesh(surface, sites, propagation, options);
    ComplexBuilder builder(mesh);
    builder.trace_all();
    return builder.write();
}

}  // namespace agvd
