#include "agvd/propagation/shape_source.h"

#include <algorithm>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

bool is_among(const std::vector<Index>& ascending, Index value) {
    return std::binary_search(ascending.begin(), ascending.end(), value);
}

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
    return source;
}

void check_shapes(const Surface& surface, const std::vector<SiteShape>& shapes) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        check_range(shapes[i].edges, surface.num_edges(), i, "edge");
        check_range(shapes[i].faces, surface.num_faces(), i, "face");
        if (!shapes[i].edges.empty() || !shapes[i].faces.empty()) continue;
        throw InvalidSites("shape " + std::to_string(i) +
                           " of the sites has no edge and no face; leave it out");
    }
}

std::vector<Index> points_off_shapes(const Surface& surface, std::span<const SurfacePoint> points,
                                     const std::vector<SiteShape>& shapes) {
    std::vector<Index> vertices, edges, faces;
    for (const SiteShape& shape : shapes) {
        const std::vector<Index> own = shape_source(surface, shape).vertices;
        vertices.insert(vertices.end(), own.begin(), own.end());
        edges.insert(edges.end(), shape.edges.begin(), shape.edges.end());
        for (const Index face : shape.faces) {
            faces.push_back(face);
            for (Index h = 3 * face; h < 3 * face + 3; ++h) edges.push_back(surface.edge[h]);
        }
    }
    for (std::vector<Index>* const all : {&vertices, &edges, &faces}) {
        *all = distinct(std::move(*all));
    }
    std::vector<Index> off;
    for (Index i = 0; i < points.size(); ++i) {
        const SurfacePoint& p = points[i];
        if (is_among(faces, p.face.value())) continue;
        if (const auto vertex = vertex_of(surface, p)) {
            if (is_among(vertices, *vertex)) continue;
        } else if (const auto half_edge = half_edge_of(p)) {
            if (is_among(edges, surface.edge[*half_edge])) continue;
        }
        off.push_back(i);
    }
    return off;
}

}  // namespace agvd
