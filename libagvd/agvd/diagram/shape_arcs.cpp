// Faces are independent. What changes is collected by chunks and stored in their order.
#include <algorithm>
#include <cmath>

#include "agvd/core/parallel.h"
#include "agvd/diagram/arc_conics.h"
#include "agvd/diagram/gather_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

constexpr Index shaped_faces_per_task = 128;
constexpr int most_arc_halvings = 20;

// An arc as it is drawn now.
struct DrawnArc {
    Index arc;
    std::vector<Vec2> points;  // With both ends.
    std::vector<ArcShape> shapes;
    bool has_conics;
};

// What one task found.
struct ShapedFaces {
    struct Entry {
        Index arc, num_points, num_shapes;
        bool has_conics;
    };
    struct AreaChange {
        Index part;
        double area;
    };
    struct MovedVertex {
        Index voronoi_vertex;
        Vec2 position;
        double distance;
    };
    std::vector<Entry> entries;
    std::vector<Vec2> points;
    std::vector<double> distances;
    std::vector<ArcShape> shapes;
    std::vector<AreaChange> area_changes;
    std::vector<MovedVertex> moved_vertices;
};

class FaceShaper {
public:
    FaceShaper(const StageInput& input, const DiagramParts& parts, ShapedFaces& out)
        : in_(input), parts_(parts), out_(out) {}

    void shape(Index position) {
        const FaceArcs& found = arcs_.faces[position];
        if (found.arcs.count == 0) return;
        face_ = in_.propagation.mixed_faces[position];
        corners_ = face_corners(in_.surface, face_);
        size_ = longest_side(corners_);
        gatherer_.gather_own(position, relays_);
        const std::size_t first_vertex = out_.moved_vertices.size();
        if (!split_all(found)) {
            out_.moved_vertices.resize(first_vertex);
            gatherer_.gather_all(position, relays_);
            static_cast<void>(split_all(found));
        }
        for (DrawnArc& drawn : drawn_arcs()) draw(drawn);
        if (any_outside() || any_cross() || !change_areas(found)) {
            vertices_.clear();
            out_.moved_vertices.resize(first_vertex);
            for (DrawnArc& drawn : drawn_arcs()) keep(drawn);
        }
        for (const DrawnArc& drawn : drawn_arcs()) store(drawn);
    }

private:
    [[nodiscard]] std::span<DrawnArc> drawn_arcs() { return std::span(drawn_).first(num_drawn_); }

    // Where distances with errors contradict each other, steps are long: such vertices stay.
    void settle_vertices(const Block& found) {
        constexpr double farthest = 1e-6;  // A share of the triangle's size.
        vertices_.clear();
        for (Index i = found.begin; i < found.end(); ++i) {
            const VoronoiVertex& vertex = arcs_.voronoi_vertices[i];
            const VertexCandidate settled = settled_vertex(
                {of_site(relays_, vertex.sites[0]), of_site(relays_, vertex.sites[1]),
                 of_site(relays_, vertex.sites[2])},
                {vertex.position, vertex.distance, 0});
            if (!((settled.position - vertex.position).norm() <= farthest * size_)) continue;
            vertices_.push_back({i, settled.position, settled.distance});
        }
        out_.moved_vertices.insert(out_.moved_vertices.end(), vertices_.begin(), vertices_.end());
    }

    [[nodiscard]] Chord ends_of(const Arc& arc) const {
        const auto at = [&](NodeId node, bool is_across) {
            for (const ShapedFaces::MovedVertex& moved : vertices_) {
                if (node == NodeId::of_voronoi_vertex(moved.voronoi_vertex)) return moved.position;
            }
            return old_position(node, is_across);
        };
        return {at(arc.tail, arc.tail_is_across), at(arc.head, arc.head_is_across)};
    }
    [[nodiscard]] Chord old_ends_of(const Arc& arc) const {
        return {old_position(arc.tail, arc.tail_is_across),
                old_position(arc.head, arc.head_is_across)};
    }
    [[nodiscard]] Vec2 old_position(NodeId node, bool is_across) const {
        return position_of(in_.surface, parts_.labels, arcs_, face_, node, is_across);
    }
    [[nodiscard]] double distance_at(NodeId node) const {
        return node.is_voronoi_vertex() ? arcs_.voronoi_vertices[node.voronoi_vertex()].distance
                                        : parts_.labels.crossings[node.crossing()].distance;
    }
    [[nodiscard]] std::array<Relays, 2> relays_beside(const Arc& arc) const {
        return {of_site(relays_, arc.left), of_site(relays_, arc.right)};
    }

    // Whether the relays at hand agree with the distances of all ends.
    [[nodiscard]] bool split_all(const FaceArcs& found) {
        settle_vertices(found.voronoi_vertices);
        num_drawn_ = 0;
        bool are_reached = true;
        for (Index arc = found.arcs.begin; arc < found.arcs.end(); ++arc) {
            are_reached = split(arc) && are_reached;
        }
        return are_reached;
    }

    // Whether the relays at hand agree with the distances of the arc's ends.
    [[nodiscard]] bool split(Index index) {
        const Arc& arc = arcs_.arcs[index];
        const Chord ends = ends_of(arc);
        if (num_drawn_ == drawn_.size()) drawn_.emplace_back();
        DrawnArc& drawn = drawn_[num_drawn_++];
        drawn.arc = index;
        if (!conics_.begin(relays_beside(arc), ends, {distance_at(arc.tail), distance_at(arc.head)},
                           size_)) {
            keep(drawn);
            return false;
        }
        const auto conics = conics_.follow();
        if (conics.empty()) {
            keep(drawn);
            return true;
        }
        drawn.has_conics = true;
        drawn.shapes.clear();
        Vec2 from = ends.from;
        for (const ArcConics::Part& part : conics) {
            const ArcKind kind = part.conic.is_line() ? ArcKind::Line : ArcKind::Hyperbola;
            drawn.shapes.push_back({kind, part.conic, from, part.end, 0});
            from = part.end;
        }
        return true;
    }

    // Of unknown shape.
    void keep(DrawnArc& drawn) const {
        const Arc& arc = arcs_.arcs[drawn.arc];
        const Chord ends = ends_of(arc);
        drawn.has_conics = false;
        drawn.shapes.assign(1, {ArcKind::Chord, {}, ends.from, ends.to, arc.num_points});
        drawn.points.assign(1, ends.from);
        const auto inner = inner_points(arc);
        drawn.points.insert(drawn.points.end(), inner.begin(), inner.end());
        drawn.points.push_back(ends.to);
    }

    // As it was.
    [[nodiscard]] std::span<const Vec2> inner_points(const Arc& arc) const {
        return elements_of(arcs_.points, {arc.first_point, arc.num_points});
    }

    void draw(DrawnArc& drawn) const {
        if (!drawn.has_conics) return;
        drawn.points.assign(1, drawn.shapes.front().begin);
        for (ArcShape& shape : drawn.shapes) {
            const std::size_t before = drawn.points.size();
            if (shape.kind != ArcKind::Line &&
                shape.conic.most_stray(shape.begin, shape.end) > *in_.chord) {
                // With errors in the distances the ends lie beside the conic.
                const Chord on_it{shape.conic.moved_onto(shape.begin),
                                  shape.conic.moved_onto(shape.end)};
                add_inner_points(shape.conic, on_it, *in_.chord, 0, drawn.points);
            }
            shape.num_points = static_cast<Index>(drawn.points.size() - before);
            drawn.points.push_back(shape.end);
        }
    }

    static void add_inner_points(const Conic& conic, const Chord& chord, double tolerance,
                                 int depth, std::vector<Vec2>& points) {
        if (depth == most_arc_halvings || conic.most_stray(chord.from, chord.to) <= tolerance) {
            return;
        }
        const Vec2 top = conic.between(chord.from, chord.to, 0.5);
        add_inner_points(conic, {chord.from, top}, tolerance, depth + 1, points);
        points.push_back(top);
        add_inner_points(conic, {top, chord.to}, tolerance, depth + 1, points);
    }

    // Conics of distances with errors may leave the face.
    [[nodiscard]] bool any_outside() const {
        if (in_.propagation.certified_error == 0) return false;
        std::array<Vec2, 3> sides;
        for (std::size_t k = 0; k < 3; ++k) {
            sides[k] = (corners_[(k + 1) % 3] - corners_[k]).normalized();
        }
        const double slack = inside_tolerance * size_;
        const auto is_outside = [&](const Vec2& p) {
            return cross(sides[0], p - corners_[0]) < -slack ||
                   cross(sides[1], p - corners_[1]) < -slack ||
                   cross(sides[2], p - corners_[2]) < -slack;
        };
        for (std::size_t i = 0; i < num_drawn_; ++i) {
            const std::vector<Vec2>& points = drawn_[i].points;
            if (std::any_of(points.begin(), points.end(), is_outside)) return true;
        }
        return false;
    }

    [[nodiscard]] bool any_cross() {
        segments_.clear();
        for (const DrawnArc& drawn : drawn_arcs()) {
            // Such an arc does not cross itself.
            const bool is_monotone = goes_forward(drawn.points);
            const std::size_t first = segments_.size();
            for (std::size_t i = 0; i + 1 < drawn.points.size(); ++i) {
                const Chord segment{drawn.points[i], drawn.points[i + 1]};
                const auto others =
                    std::span(segments_).first(is_monotone ? first : segments_.size());
                for (const Chord& other : others) {
                    if (do_cross(segment, other)) return true;
                }
                segments_.push_back(segment);
            }
        }
        return false;
    }

    // Whether each segment goes in the direction of the whole.
    [[nodiscard]] static bool goes_forward(std::span<const Vec2> points) {
        const Vec2 whole = points.back() - points.front();
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            if (!(whole.dot(points[i + 1] - points[i]) > 0)) return false;
        }
        return true;
    }

    // False, and nothing changes: a part would be turned inside out.
    [[nodiscard]] bool change_areas(const FaceArcs& found) {
        constexpr double rounding = 1e-13;
        const std::size_t first = out_.area_changes.size();
        for (const DrawnArc& drawn : drawn_arcs()) {
            const Arc& arc = arcs_.arcs[drawn.arc];
            const Chord old = old_ends_of(arc);
            const double area =
                (doubled_area(drawn.points.front(),
                              std::span(drawn.points).subspan(1, drawn.points.size() - 2),
                              drawn.points.back()) -
                 doubled_area(old.from, inner_points(arc), old.to)) /
                2;
            out_.area_changes.push_back({part_of(found, arc.left), area});
            out_.area_changes.push_back({part_of(found, arc.right), -area});
        }
        for (const CellPart& part : elements_of(arcs_.parts, found.parts)) {
            double area = 0;
            for (const CellPart& other : elements_of(arcs_.parts, found.parts)) {
                if (other.site == part.site) area += other.area;
            }
            for (std::size_t i = first; i < out_.area_changes.size(); ++i) {
                const auto& [changed, change] = out_.area_changes[i];
                if (arcs_.parts[changed].site == part.site) area += change;
            }
            if (area >= -rounding * size_ * size_) continue;
            out_.area_changes.resize(first);
            return false;
        }
        return true;
    }

    // The first one of a site; its triangle does not matter for the sum.
    [[nodiscard]] Index part_of(const FaceArcs& found, Index site) const {
        Index part = found.parts.begin;
        while (arcs_.parts[part].site != site) ++part;
        return part;
    }

    [[nodiscard]] static double doubled_area(const Vec2& from, std::span<const Vec2> points,
                                             const Vec2& to) {
        double sum = 0;
        const Vec2* last = &from;
        for (const Vec2& point : points) {
            sum += cross(*last, point);
            last = &point;
        }
        return sum + cross(*last, to);
    }

    void store(const DrawnArc& drawn) {
        out_.shapes.insert(out_.shapes.end(), drawn.shapes.begin(), drawn.shapes.end());
        Index num_points = 0;
        if (drawn.has_conics) {
            num_points = size_of(drawn.points) - 2;
            out_.points.insert(out_.points.end(), drawn.points.begin() + 1, drawn.points.end() - 1);
            std::size_t i = 1;
            for (const ArcShape& shape : drawn.shapes) {
                for (const std::size_t end = i + shape.num_points + 1; i < end; ++i) {
                    if (i > num_points) break;
                    out_.distances.push_back(shape.conic.distance(0, drawn.points[i]));
                }
            }
        }
        out_.entries.push_back({drawn.arc, num_points, size_of(drawn.shapes), drawn.has_conics});
    }

    const StageInput& in_;
    const DiagramParts& parts_;
    const Arcs& arcs_ = parts_.arcs;
    ShapedFaces& out_;
    RelayGatherer gatherer_{in_.surface, in_.propagation, parts_.labels};
    ArcConics conics_;

    // The face at hand.
    Index face_ = 0;
    std::array<Vec2, 3> corners_;
    double size_ = 0;
    std::vector<PlanarRelay> relays_;  // By ascending site.
    std::vector<ShapedFaces::MovedVertex> vertices_;
    std::vector<DrawnArc> drawn_;  // The first num_drawn_; others are kept for their memory.
    std::size_t num_drawn_ = 0;
    std::vector<Chord> segments_;
};

void store_shapes(const ShapedFaces& found, DiagramParts& parts) {
    Index point = 0, shape = size_of(parts.shapes.shapes);
    const Index first_point = size_of(parts.arcs.points);
    for (const auto& [index, num_points, num_shapes, has_conics] : found.entries) {
        parts.shapes.of_arc[index] = {shape, num_shapes};
        shape += num_shapes;
        if (!has_conics) continue;
        parts.arcs.arcs[index].first_point = first_point + point;
        parts.arcs.arcs[index].num_points = num_points;
        point += num_points;
    }
    const auto append = [](const auto& from, auto& to) {
        to.insert(to.end(), from.begin(), from.end());
    };
    append(found.points, parts.arcs.points);
    append(found.distances, parts.arcs.point_distance);
    append(found.shapes, parts.shapes.shapes);
    for (const auto& [part, area] : found.area_changes) parts.arcs.parts[part].area += area;
    for (const auto& [vertex, position, distance] : found.moved_vertices) {
        parts.arcs.voronoi_vertices[vertex].position = position;
        parts.arcs.voronoi_vertices[vertex].distance = distance;
    }
}

}  // namespace

void shape_arcs(const StageInput& input, DiagramParts& parts) {
    const Index count = size_of(parts.arcs.faces);
    std::vector<ShapedFaces> chunks(num_chunks(count, shaped_faces_per_task));
    const auto shape_chunk = [&](Index chunk, Index begin, Index end) {
        FaceShaper shaper(input, parts, chunks[chunk]);
        Ticker ticker(input.poller);
        for (Index i = begin; i < end; ++i) {
            ticker.tick(1 +
                        parts.arcs.faces[i].arcs.count * relays_of(input.propagation, i).size());
            shaper.shape(i);
        }
    };
    parallel_chunks(count, shaped_faces_per_task, input.num_threads, shape_chunk, input.poller);
    parts.shapes.of_arc.resize(parts.arcs.arcs.size());
    for (ShapedFaces& chunk : chunks) {
        input.poller.poll();
        store_shapes(chunk, parts);
        chunk = {};
    }
}

}  // namespace agvd
