#include "agvd/propagation/shape_source.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// The least start of the shapes that hold a vertex, an edge or a face.
class LeastStarts {
public:
    void add(const std::vector<Index>& elements, double start) {
        for (const Index element : elements) starts_.emplace_back(element, start);
    }
    void sort() { std::sort(starts_.begin(), starts_.end()); }
    // Infinity: none holds it.
    [[nodiscard]] double at(Index element) const {
        const auto first =
            std::lower_bound(starts_.begin(), starts_.end(), std::pair(element, 0.0));
        return first != starts_.end() && first->first == element ? first->second : infinity;
    }

private:
    std::vector<std::pair<Index, double>> starts_;  // Sorted.
};

void check_range(const std::vector<Index>& indices, Index count, std::size_t shape,
                 const char* what) {
    for (const Index i : indices) {
        if (i < count) continue;
        throw InvalidSites("shape " + std::to_string(shape) + " of the sites names " + what + " " +
                           std::to_string(i) + ", but the surface has only " +
                           std::to_string(count) + "; use those of this surface");
    }
}

}  // namespace

ShapeSource shape_source(const Surface& surface, const SiteShape& shape) {
    const std::vector<Index> faces = distinct(shape.faces);
    const auto is_inside = [&](Index half_edge) {
        return is_among(faces, Surface::face(half_edge));
    };
    ShapeSource source;
    source.start = shape.start;
    const auto add_side = [&](Index half_edge) {
        if (half_edge != no_index && !is_inside(half_edge)) source.sides.push_back(half_edge);
    };
    for (const Index edge : shape.edges) {
        const Index h = surface.edge_half[edge];
        add_side(h);
        add_side(surface.twin[h]);
        source.vertices.push_back(surface.tail(h));
        source.vertices.push_back(surface.head(h));
    }
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            add_side(surface.twin[h]);
            source.vertices.push_back(surface.tail(h));
        }
    }
    source.sides = distinct(std::move(source.sides));
    source.vertices = distinct(std::move(source.vertices));
    source.own_sides = source.sector_sides = source.sides;
    source.own_vertices = source.vertices;
    return source;
}

std::vector<ShapeSource> sources_of(const Surface& surface, std::span<const SiteShape> shapes) {
    std::vector<ShapeSource> sources;
    sources.reserve(shapes.size());
    for (const SiteShape& shape : shapes) sources.push_back(shape_source(surface, shape));
    return sources;
}

void leave_own(const Surface& surface, std::span<const SiteShape> shapes,
               std::vector<ShapeSource>& sources) {
    using Owner = std::pair<double, Index>;  // Its start, and its number.
    std::map<Index, Owner> of_side, of_vertex, of_face;
    const auto claim = [](std::map<Index, Owner>& owners, const std::vector<Index>& elements,
                          const Owner& owner) {
        for (const Index element : elements) {
            Owner& best = owners.try_emplace(element, owner).first->second;
            best = std::min(best, owner);
        }
    };
    for (Index i = 0; i < sources.size(); ++i) {
        const Owner owner(sources[i].start, i);
        claim(of_side, sources[i].sides, owner);
        claim(of_vertex, sources[i].vertices, owner);
        claim(of_face, shapes[i].faces, owner);
        sources[i].own_sides.clear();
        sources[i].own_vertices.clear();
        sources[i].sector_sides.clear();
    }
    for (const auto& [vertex, owner] : of_vertex) {
        sources[owner.second].own_vertices.push_back(vertex);
    }
    const auto is_in_region = [&](Index side, double start) {
        const auto region = of_face.find(Surface::face(side));
        return region != of_face.end() && region->second.first <= start;
    };
    for (const auto& [side, owner] : of_side) {
        if (is_in_region(side, owner.first)) continue;
        sources[owner.second].own_sides.push_back(side);
        // Shapes with a start let paths through.
        if (owner.first > 0) continue;
        for (const Index vertex : {surface.tail(side), surface.head(side)}) {
            sources[of_vertex.at(vertex).second].sector_sides.push_back(side);
        }
    }
    for (ShapeSource& source : sources) {
        std::vector<Index>& sides = source.sector_sides;
        const std::vector<Index>& more = source.start > 0 ? source.sides : source.own_sides;
        sides.insert(sides.end(), more.begin(), more.end());
        sides = distinct(std::move(sides));
    }
}

std::vector<Index> all_edges_of(const Surface& surface, const SiteShape& shape) {
    std::vector<Index> edges = shape.edges;
    for (const Index face : shape.faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) edges.push_back(surface.edge[h]);
    }
    return distinct(std::move(edges));
}

SurfaceSites on_all_sides(const Surface& whole, const Surface& opened, SurfaceSites sites) {
    std::vector<SurfacePoint>& points = sites.points;  // clang 14 captures no structured binding.
    SitePoints& roles = sites.roles;
    const std::size_t num_given = points.size();
    std::vector<Index> site;
    std::vector<double> start;
    for (Index i = 0; i < num_given; ++i) {
        site.push_back(roles.site_of(i));
        start.push_back(start_of(roles.start, i));
    }
    const auto add_others = [&](const SurfacePoint& given, Index of_site, double from) {
        const SurfacePoint point = snapped(whole, given);
        std::vector<SurfacePoint> views{point};
        for_each_view(whole, point, [&](const SurfacePoint& view) { views.push_back(view); });
        for (const Index i : distinct_points(opened, views)) {
            if (i == 0) continue;
            points.push_back(views[i]);
            site.push_back(of_site);
            start.push_back(from);
        }
    };
    for (std::size_t i = 0; i < num_given; ++i)
        add_others(SurfacePoint(points[i]), site[i], start[i]);
    for (SiteShape& shape : sites.shapes) {
        std::vector<Index> edges = shape.edges;
        for (const Index edge : shape.edges) {
            const Index h = opened.edge_half[edge];
            if (whole.twin[h] != no_index) edges.push_back(opened.edge[whole.twin[h]]);
            add_others(point_on(h, 0), shape.site, shape.start);
            add_others(point_on(Surface::next(h), 0), shape.site, shape.start);
        }
        shape.edges = distinct(std::move(edges));
    }
    if (points.size() == num_given) return sites;
    roles.site = std::move(site);
    const auto is_zero = [](double from) { return from == 0; };
    if (!std::all_of(start.begin(), start.end(), is_zero)) roles.start = std::move(start);
    return sites;
}

void check_shapes(const Surface& surface, const std::vector<SiteShape>& shapes) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        check_range(shapes[i].edges, surface.num_edges(), i, "edge");
        check_range(shapes[i].faces, surface.num_faces(), i, "face");
        if (shapes[i].edges.empty() && shapes[i].faces.empty()) {
            throw InvalidSites("shape " + std::to_string(i) +
                               " of the sites has no edge and no face; leave it out");
        }
        if (shapes[i].start >= 0 && shapes[i].start < infinity) continue;
        throw InvalidSites("shape " + std::to_string(i) + " of the sites starts at the distance " +
                           number_text(shapes[i].start) + "; use a number of 0 or more");
    }
}

std::vector<Index> points_off_shapes(const Surface& surface, std::span<const SurfacePoint> points,
                                     std::span<const double> starts,
                                     const std::vector<SiteShape>& shapes) {
    LeastStarts of_vertices, of_edges, of_faces;
    for (const SiteShape& shape : shapes) {
        of_vertices.add(shape_source(surface, shape).vertices, shape.start);
        of_edges.add(all_edges_of(surface, shape), shape.start);
        of_faces.add(shape.faces, shape.start);
    }
    for (LeastStarts* const all : {&of_vertices, &of_edges, &of_faces}) all->sort();
    const auto least_at = [&](const SurfacePoint& point) {
        const double in_face = of_faces.at(point.face.value());
        if (const auto vertex = vertex_of(surface, point)) {
            return std::min(in_face, of_vertices.at(*vertex));
        }
        const auto half_edge = half_edge_of(point);
        return half_edge ? std::min(in_face, of_edges.at(surface.edge[*half_edge])) : in_face;
    };
    std::vector<Index> off;
    for (Index i = 0; i < points.size(); ++i) {
        if (least_at(points[i]) > start_of(starts, i)) off.push_back(i);
    }
    return off;
}

}  // namespace agvd
