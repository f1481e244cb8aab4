// The sites inside a face become points of a triangulation of it; its inner edges are the cuts,
// labelled as mesh edges are. Chunks of faces are cut in parallel and copied in order.
#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/envelope.h"
#include "agvd/diagram/face_triangulation.h"
#include "agvd/diagram/gather_relays.h"
#include "agvd/diagram/relay_tree.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// What the faces of one chunk add to the labels, counted from 0.
struct FoundCuts {
    std::vector<InnerPoint> inner_points;
    std::vector<Cut> cuts;
    std::vector<Crossing> crossings;
    std::vector<CutTriangle> triangles;
    std::vector<CutFace> faces;
};

class FaceCutter {
public:
    FaceCutter(const StageInput& input, const EdgeLabels& labels, FoundCuts& out)
        : in_(input), labels_(labels), out_(out) {}

    void cut(Index mixed_index, std::span<const PlacedSite> placed) {
        face_ = propagation_.mixed_faces[mixed_index];
        gatherer_.gather_all(mixed_index, relays_);
        tree_.build(relays_);
        points_.clear();
        const auto corners = face_corners(surface_, face_);
        triangulation_.reset(corners);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = surface_.mesh.triangles[face_][k];
            points_.push_back({{v, static_cast<Index>(k)},
                               corners[k],
                               labels_.point_site[v],
                               labels_.vertex_distance[v]});
        }
        for (const PlacedSite& site : placed) add_site(site);
        if (points_.size() > 3) append_triangles();
    }

private:
    struct Point {
        CutEnd name;
        Vec2 position;
        Index site;
        double distance;
    };

    void add_site(const PlacedSite& placed) {
        if (half_edge_of(placed.point)) return;
        const Vec2 p = position_in_frame(surface_, placed.point, 3 * face_);
        // Inside by its coordinates, but so near to a corner that the distance is rounded to 0.
        const auto first = points_.begin();
        const auto is_here = [&](const Point& corner) { return (corner.position - p).norm() == 0; };
        if (std::any_of(first, first + 3, is_here)) return;
        const double distance = least_reach(of_site(relays_, placed.site), p).distance;
        find_near(p, distance);
        if (nearest(near_, p).site != placed.site) return;
        points_.push_back(
            {{surface_.num_vertices() + size_of(out_.inner_points), 3}, p, placed.site, distance});
        out_.inner_points.push_back({p, placed.site});
        triangulation_.add(p);
    }

    // Those through which p is no farther from a site than this, and maybe some others.
    void find_near(const Vec2& p, double distance) {
        constexpr double rounding = 1e-9;
        tree_.find_near(p, distance * (1 + rounding), found_);
        near_.clear();
        for (const Index i : found_) near_.push_back(relays_[i]);
    }

    void append_triangles() {
        const auto& pieces = triangulation_.pieces();
        const Index first = size_of(out_.triangles);
        for (Index i = 0; i < pieces.size(); ++i) {
            CutTriangle triangle;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index from = pieces[i].points[k];
                const Index to = pieces[i].points[k == 2 ? 0 : k + 1];
                const Index neighbour = pieces[i].neighbours[k];
                triangle.points[k] = points_[from].name;
                if (neighbour == no_index) {
                    triangle.sides[k] = LineId::of_edge(3 * face_ + from);
                } else if (neighbour > i) {
                    triangle.sides[k] =
                        add_cut(points_[std::min(from, to)], points_[std::max(from, to)]);
                } else {
                    const auto& shared = pieces[neighbour].points;
                    const auto found = std::find(shared.begin(), shared.end(), to);
                    triangle.sides[k] =
                        out_.triangles[first + neighbour]
                            .sides[static_cast<std::size_t>(found - shared.begin())];
                }
            }
            out_.triangles.push_back(triangle);
        }
        out_.faces.push_back({face_, {first, size_of(pieces)}});
    }

    LineId add_cut(const Point& from, const Point& to) {
        const LineId name = LineId::of_cut(size_of(out_.cuts));
        const Vec2 chord = to.position - from.position;
        const double length = chord.norm();
        // No point of the cut is farther from a site than the nearer end allows; from the middle a
        // relay that wins there has half the length to go.
        find_near((from.position + to.position) / 2,
                  std::max(from.distance, to.distance) + length / 2);
        on_cut_.clear();
        for (const PlanarRelay& relay : near_) {
            on_cut_.push_back(on_line(relay, from.position, chord / length, length));
        }
        const Index begin = size_of(out_.crossings);
        label_line(on_cut_, name, {length, from.site, to.site}, scratch_, out_.crossings);
        if (in_.chord) settle_crossings(on_cut_, length, std::span(out_.crossings).subspan(begin));
        out_.cuts.push_back({face_, from.name, to.name, {begin, size_of(out_.crossings) - begin}});
        return name;
    }

    const StageInput& in_;
    const Surface& surface_ = in_.surface;
    const Propagation& propagation_ = in_.propagation;
    const EdgeLabels& labels_;
    FoundCuts& out_;
    RelayGatherer gatherer_{surface_, propagation_, labels_};

    // The face at hand.
    Index face_ = 0;
    std::vector<PlanarRelay> relays_;
    RelayTree tree_;
    std::vector<Index> found_;
    std::vector<PlanarRelay> near_;  // The relays of found_.
    std::vector<LineRelay> on_cut_;
    std::vector<Point> points_;
    FaceTriangulation triangulation_;
    EnvelopeScratch scratch_;
};

// Adds the cuts of a chunk to the labels, with indices into these.
void add_cuts(FoundCuts& found, EdgeLabels& labels) {
    const auto first_point = size_of(labels.inner_points);
    const auto first_cut = size_of(labels.cuts);
    const auto first_crossing = size_of(labels.crossings);
    const auto first_triangle = size_of(labels.cut_triangles);
    const auto move_end = [&](CutEnd& end) {
        if (end.corner == 3) end.point += first_point;
    };
    const auto move_line = [&](LineId& line) {
        if (line.is_cut()) line = LineId::of_cut(line.cut() + first_cut);
    };
    for (const InnerPoint& point : found.inner_points) {
        labels.inner_points.push_back(point);
        labels.point_site.push_back(point.site);
    }
    for (Cut& cut : found.cuts) {
        move_end(cut.from);
        move_end(cut.to);
        cut.row.begin += first_crossing;
        labels.cuts.push_back(cut);
    }
    for (Crossing& crossing : found.crossings) {
        move_line(crossing.line);
        labels.crossings.push_back(crossing);
    }
    for (CutTriangle& triangle : found.triangles) {
        std::for_each(triangle.points.begin(), triangle.points.end(), move_end);
        std::for_each(triangle.sides.begin(), triangle.sides.end(), move_line);
        labels.cut_triangles.push_back(triangle);
    }
    const auto before = static_cast<std::ptrdiff_t>(labels.cut_faces.size());
    for (CutFace& face : found.faces) {
        face.triangles.begin += first_triangle;
        labels.cut_faces.push_back(face);
    }
    std::inplace_merge(labels.cut_faces.begin(), labels.cut_faces.begin() + before,
                       labels.cut_faces.end(),
                       [](const CutFace& a, const CutFace& b) { return a.face < b.face; });
}

}  // namespace

void cut_faces(const StageInput& input, std::span<const Index> positions, EdgeLabels& labels) {
    if (input.placement.is_empty()) return;
    constexpr Index grain = 512;
    const auto count = static_cast<Index>(positions.size());
    std::vector<FoundCuts> found(num_chunks(count, grain));
    const auto cut_chunk = [&](Index chunk, Index begin, Index end) {
        FaceCutter cutter(input, labels, found[chunk]);
        Ticker ticker(input.poller);
        for (Index i = begin; i < end; ++i) {
            const Index position = positions[i];
            const auto placed = input.placement.in_face(input.propagation.mixed_faces[position]);
            if (!placed.empty()) cutter.cut(position, placed);
            ticker.tick(1 + relays_of(input.propagation, position).size() * placed.size());
        }
    };
    parallel_chunks(count, grain, input.num_threads, cut_chunk, input.poller);
    for (FoundCuts& part : found) {
        input.poller.poll();
        add_cuts(part, labels);
    }
}

}  // namespace agvd
