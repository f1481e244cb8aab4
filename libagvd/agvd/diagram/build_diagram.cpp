#include "agvd/diagram/diagram.h"

#include <algorithm>
#include <numeric>

#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// All stages but drawing the points.
Diagram build_complex(const StageInput& input, Index num_sites, DiagramParts& parts) {
    parts.num_sites = num_sites;
    parts.boundary_loops = boundary_loops(input.surface);
    label_vertices(input, parts.labels);
    label_edges(input, parts.labels);
    cut_faces(input, parts.labels);
    input.poller.tell(0.5);
    std::vector<Index> all(input.propagation.mixed_faces.size());
    std::iota(all.begin(), all.end(), Index{0});
    parts.arcs.faces.resize(all.size());
    trace_faces(input, all, parts);
    input.poller.tell(0.9);
    parts.joined = join_arcs(parts.labels, parts.arcs, Ticker(input.poller));
    return absorb_islands(input, parts);
}

// The points that own their own places, and their sites.
struct OwnPlaces {
    std::vector<SurfacePoint> points;
    std::vector<Index> sites;
    Index num_sites;
};

OwnPlaces own_places(const Surface& surface, std::span<const SurfacePoint> points,
                     const Propagation& propagation) {
    const std::vector<Index>& sites = propagation.site_of_point;
    if (sites.empty()) {
        OwnPlaces all{{points.begin(), points.end()}, std::vector<Index>(points.size()), 0};
        std::iota(all.sites.begin(), all.sites.end(), Index{0});
        all.num_sites = size_of(all.sites);
        return all;
    }
    OwnPlaces own{{}, {}, *std::max_element(sites.begin(), sites.end()) + 1};
    for (Index i = 0; i < points.size(); ++i) {
        if (label_at(surface, propagation, points[i]).site.value() != sites[i]) continue;
        own.points.push_back(points[i]);
        own.sites.push_back(sites[i]);
    }
    return own;
}

// \param relays  not null: freed when they have been read for the last time.
Diagram build(const Surface& surface, std::span<const SurfacePoint> sites,
              const Propagation& propagation, const DiagramOptions& options,
              std::vector<Relay>* relays) {
    Poller poller(options.progress);
    poller.poll();
    const OwnPlaces own = own_places(surface, sites, propagation);
    const SitePlacement placement(surface, own.points, own.sites);
    DiagramParts parts;
    Diagram diagram = build_complex({surface, own.points, own.sites, placement, propagation,
                                     options.chord_tolerance, options.num_threads, poller},
                                    own.num_sites, parts);
    if (relays != nullptr) std::vector<Relay>().swap(*relays);
    draw_points(surface, parts, Ticker(poller), diagram);
    measure_cells(surface, parts, Ticker(poller), diagram);
    diagram.nearest_site.reserve(surface.num_vertices());
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        diagram.nearest_site.push_back(SiteId(parts.labels.point_site[v]));
    }
    diagram.nearest_distance = std::move(parts.labels.vertex_distance);
    poll(options.progress, 1);
    return diagram;
}

// Draws Voronoi edges on the faces of another mesh, point by point.
class EdgeMapper {
public:
    EdgeMapper(const IntrinsicTriangulation& base, const Diagram& from, Diagram& to, Ticker ticker)
        : base_(base), from_(from), to_(to), ticker_(ticker) {}

    void map_edges() {
        to_.edge_points.push_back(0);
        for (Index e = 0; e < from_.edges.size(); ++e) {
            const Index begin = from_.edge_points[e], end = from_.edge_points[e + 1];
            for (Index i = begin; i + 1 < end; ++i) map_piece(e, i, i + 1);
            if (from_.edges[e].tail == no_index) {
                if (begin < end) map_piece(e, end - 1, begin);
            } else {
                add(base_.to_input(from_.points[end - 1]), from_.point_distance[end - 1]);
            }
            to_.edge_points.push_back(static_cast<Index>(to_.points.size()));
        }
    }

private:
    void add(const SurfacePoint& point, double distance) {
        to_.points.push_back(point);
        to_.point_distance.push_back(distance);
    }

    // But for its end.
    void map_piece(Index edge, Index begin, Index end) {
        constexpr std::size_t segment_work = 16;  // Steps that a segment counts for.
        ticker_.tick(segment_work);
        const CurvePiece piece = curve_piece(base_.surface(), from_, edge, begin);
        parts_.clear();
        base_.to_input(piece.from, piece.to, parts_);
        const MeshView mesh = base_.input().mesh.view();
        const auto length_of = [&](std::size_t i) {
            if (base_.input().has_own_lengths) {
                return face_distance(base_.input(), parts_[i], parts_[i + 1]);
            }
            return (position(mesh, parts_[i + 1]) - position(mesh, parts_[i])).norm();
        };
        double length = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) length += length_of(i);
        double passed = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) {
            const double share = length > 0 ? passed / length : 0;
            add(parts_[i],
                (1 - share) * from_.point_distance[begin] + share * from_.point_distance[end]);
            passed += length_of(i);
        }
    }

    const IntrinsicTriangulation& base_;
    const Diagram& from_;
    Diagram& to_;
    Ticker ticker_;
    std::vector<SurfacePoint> parts_;  // Two a part.
};

}  // namespace

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      const Propagation& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, nullptr);
}

Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                      Propagation&& propagation, const DiagramOptions& options) {
    return build(surface, sites, propagation, options, &propagation.relays);
}

Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                         const Progress& progress) {
    Poller poller(progress);
    Diagram mapped;  // Only the edges' points; passages are of the base's faces.
    EdgeMapper(base, diagram, mapped, Ticker(poller)).map_edges();
    diagram.points = std::move(mapped.points);
    diagram.point_distance = std::move(mapped.point_distance);
    diagram.edge_points = std::move(mapped.edge_points);
    diagram.passages.clear();
    diagram.vertices = base.to_input(diagram.vertices);
    diagram.nearest_site.resize(base.input().num_vertices());
    diagram.nearest_distance.resize(base.input().num_vertices());
    return diagram;
}

}  // namespace agvd
