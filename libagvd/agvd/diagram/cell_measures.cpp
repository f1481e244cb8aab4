#include "agvd/diagram/cell_measures.h"

#include "agvd/mesh/face_area.h"

namespace agvd {
namespace {

// The open cell is a union of open pieces of triangles, open intervals of inner edges and cuts, and
// inner points, and for a surface without its boundary their alternating sum is the Euler
// characteristic.
class CellMeasurer {
public:
    CellMeasurer(const Surface& surface, const EdgeLabels& labels, const CellSet& asked,
                 Diagram& diagram)
        : surface_(surface), labels_(labels), asked_(asked), diagram_(diagram) {
        diagram.cell_area.resize(diagram.num_sites, 0);
        diagram.cell_euler.resize(diagram.num_sites, 0);
        for (Index s = 0; s < diagram.num_sites; ++s) {
            if (asked.has(s)) diagram.cell_area[s] = diagram.cell_euler[s] = 0;
        }
    }

    void run(const ArcStore& arcs, const FaceList& faces) {
        for (Index i = 0; i < faces.size(); ++i) add_edges_and_whole(faces[i]);
        for (Index i = 0; i < faces.size(); ++i) {
            for (const FaceArcs::CellPart& part : arcs.parts()[arcs.of_face(faces[i]).parts]) {
                if (!asked_.has(part.site)) continue;
                diagram_.cell_euler[part.site] += part.pieces;
                diagram_.cell_area[part.site] += part.area;
            }
        }
        for (const CutFace& face : labels_.cut_faces) {
            for (const Cut& cut : labels_.cuts[face.cuts]) {
                count(labels_.point_site[cut.from], -1);
                add_row(cut.row);
            }
            for (const InnerPoint& point : labels_.inner_points[face.inner_points]) {
                count(point.site, 1);
            }
        }
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (surface_.outgoing[v] != no_index) count(labels_.point_site[v], 1);
        }
    }

private:
    void count(Index site, int change) {
        if (asked_.has(site)) diagram_.cell_euler[site] += change;
    }

    // What a face of one label adds. Takes out the first interval of each inner edge, and what is on
    // the boundary: one edge of it leaves each of its vertices.
    void add_edges_and_whole(Index face) {
        const Triangle& corners = surface_.mesh.triangles[face];
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * face + k;
            const Index twin = surface_.twin[h];
            if (h >= twin) continue;
            count(labels_.point_site[corners[k]], -1);
            if (twin != no_index) add_row(labels_.edge_rows[surface_.edge[h]]);
        }
        if (labels_.mixed_index[face] != no_index) return;
        const Index site = labels_.point_site[corners[0]];
        if (!asked_.has(site)) return;
        ++diagram_.cell_euler[site];
        diagram_.cell_area[site] += face_area(surface_, face);
    }

    void add_row(const Block& row) {
        for (const Crossing& crossing : labels_.crossings[row]) count(crossing.site_after, -1);
    }

    const Surface& surface_;
    const EdgeLabels& labels_;
    const CellSet& asked_;
    Diagram& diagram_;
};

}  // namespace

void measure_cells(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
                   const FaceList& faces, const CellSet& asked, Diagram& diagram) {
    CellMeasurer(surface, labels, asked, diagram).run(arcs, faces);
}

}  // namespace agvd
