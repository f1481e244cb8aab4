#include "agvd/diagram/diagram_on_input.h"

#include "agvd/core/progress.h"
#include "agvd/diagram/curve_piece.h"

namespace agvd {
namespace {

// Draws Voronoi edges point by point.
class Drawing {
public:
    Drawing(const IntrinsicTriangulation& base, const Diagram& diagram, Ticker ticker)
        : base_(base), diagram_(diagram), ticker_(ticker) {}

    void run() {
        edge_points.push_back(0);
        for (Index e = 0; e < diagram_.edges.size(); ++e) {
            const Index begin = diagram_.edge_points[e], end = diagram_.edge_points[e + 1];
            for (Index i = begin; i + 1 < end; ++i) draw(e, i, i + 1);
            if (diagram_.edges[e].tail == no_index) {
                if (begin < end) draw(e, end - 1, begin);
            } else {
                add(base_.to_input(diagram_.points[end - 1]), diagram_.point_distance[end - 1]);
            }
            edge_points.push_back(static_cast<Index>(points.size()));
        }
    }

    std::vector<SurfacePoint> points;
    std::vector<double> point_distance;
    std::vector<Index> edge_points;

private:
    void add(const SurfacePoint& point, double distance) {
        points.push_back(point);
        point_distance.push_back(distance);
    }

    // A piece of an edge but for its end.
    void draw(Index edge, Index from, Index to) {
        constexpr std::size_t segment_work = 16;  // Steps that a segment counts for.
        ticker_.tick(segment_work);
        const CurvePiece piece = curve_piece(base_.surface(), diagram_, edge, from);
        parts_.clear();
        base_.to_input(piece.from, piece.to, parts_);
        const MeshView mesh = base_.input().mesh.view();
        double length = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) {
            length += (position(mesh, parts_[i + 1]) - position(mesh, parts_[i])).norm();
        }
        double passed = 0;
        for (std::size_t i = 0; i < parts_.size(); i += 2) {
            const double share = length > 0 ? passed / length : 0;
            add(parts_[i],
                (1 - share) * diagram_.point_distance[from] + share * diagram_.point_distance[to]);
            passed += (position(mesh, parts_[i + 1]) - position(mesh, parts_[i])).norm();
        }
    }

    const IntrinsicTriangulation& base_;
    const Diagram& diagram_;
    Ticker ticker_;
    std::vector<SurfacePoint> parts_;
};

}  // namespace

Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                         const Progress& progress) {
    Poller poller(progress);
    Drawing drawing(base, diagram, Ticker(poller));
    drawing.run();
    diagram.points = std::move(drawing.points);
    diagram.point_distance = std::move(drawing.point_distance);
    diagram.edge_points = std::move(drawing.edge_points);
    diagram.passages.clear();  // Of the base's faces.
    diagram.vertices = base.to_input(diagram.vertices);
    diagram.nearest_site.resize(base.input().num_vertices());
    diagram.nearest_distance.resize(base.input().num_vertices());
    return diagram;
}

}  // namespace agvd
