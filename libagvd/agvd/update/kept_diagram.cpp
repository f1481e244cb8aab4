#include "agvd/update/kept_diagram.h"

namespace agvd {
namespace {

void renumber(const Renumbering& new_site, EdgeLabels& labels) {
    for (Index& site : labels.point_site) site = new_site(site);
    for (Crossing& crossing : labels.crossings) {
        crossing.site_before = new_site(crossing.site_before);
        crossing.site_after = new_site(crossing.site_after);
    }
    for (InnerPoint& point : labels.inner_points) point.site = new_site(point.site);
}

void renumber(const Renumbering& new_site, CellTally& tally) {
    auto& cells = tally.cells();
    for (Index s = 0; s < new_site.num_old(); ++s) {
        if (new_site(s) != no_index) cells[new_site(s)] = cells[s];
    }
    cells.resize(new_site.num_left());
}

void renumber(const Renumbering& new_site, CellSet& cells) {
    CellSet left(new_site.num_left());
    for (Index s = 0; s < cells.num_sites(); ++s) {
        if (cells.has(s)) left.insert(new_site(s));
    }
    cells = std::move(left);
}

}  // namespace

void renumber(const Renumbering& new_site, KeptDiagram& kept) {
    renumber(new_site, kept.parts.labels);
    kept.parts.arcs.for_each_site([&](Index& site) { site = new_site(site); });
    for (JoinedEdges::Edge& edge : kept.parts.joined.edges) {
        edge.left = new_site(edge.left);
        edge.right = new_site(edge.right);
    }
    renumber(new_site, kept.parts.tally);
    renumber(new_site, kept.displaced);
    renumber(new_site, kept.absorbed.in_doubt);
    for (OldLabel& old : kept.absorbed.points) old.site = new_site(old.site);
    kept.is_renumbered = true;
}

bool is_wasteful(const DiagramParts& parts) {
    const EdgeLabels& labels = parts.labels;
    const ArcStore& arcs = parts.arcs;
    return labels.crossings.is_wasteful() || labels.inner_points.is_wasteful() ||
           labels.cuts.is_wasteful() || labels.cut_triangles.is_wasteful() ||
           arcs.arcs().is_wasteful() || arcs.voronoi_vertices().is_wasteful() ||
           arcs.points().is_wasteful() || arcs.connections().is_wasteful() ||
           arcs.parts().is_wasteful();
}

}  // namespace agvd
