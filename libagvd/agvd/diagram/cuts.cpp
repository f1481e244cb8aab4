// The sites inside a face become points of a triangulation that begins with its corners; its inner
// edges are the cuts. A cut is labelled as a mesh edge is, by the relays that can reach it. Chunks
// of faces are cut in parallel into lists of their own; then the lists are copied into the labels
// in order.
#include "agvd/diagram/cuts.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/face_triangulation.h"
#include "agvd/diagram/inside_relays.h"
#include "agvd/diagram/label_line.h"
#include "agvd/diagram/relay_tree.h"

namespace agvd {
namespace {

// What the faces of one chunk add to the labels. Blocks are in these lists; the points and cuts of
// each face are counted from 0.
struct FoundCuts {
    std::vector<InnerPoint> inner_points;
    std::vector<Cut> cuts;
    std::vector<Crossing> crossings;
    std::vector<CutTriangle> triangles;
    std::vector<CutFace> faces;
};

class FaceCutter {
public:
    FaceCutter(const Surface& surface, const Propagation& propagation, const EdgeLabels& labels,
               FoundCuts& out)
        : surface_(surface),
          propagation_(propagation),
          labels_(labels),
          inside_relays_(surface, propagation, labels),
          out_(out) {}

    void cut(Index mixed_index, std::span<const PlacedSite> placed) {
        face_ = propagation_.mixed_faces[mixed_index];
        inside_relays_.gather_all(mixed_index, relays_);
        tree_.build(relays_);
        points_.clear();
        cut_ = {face_, block_from(out_.inner_points), block_from(out_.cuts),
                block_from(out_.triangles)};
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
            {{surface_.num_vertices() + cut_.inner_points.count++, 3}, p, placed.site, distance});
        out_.inner_points.push_back({face_, p, placed.site});
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
        const Index first = cut_.triangles.begin;
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
                    triangle.sides[k] = add_cut(std::min(from, to), std::max(from, to));
                } else {
                    const auto& shared = pieces[neighbour].points;
                    const auto place = std::find(shared.begin(), shared.end(), to);
                    triangle.sides[k] =
                        out_.triangles[first + neighbour]
                            .sides[static_cast<std::size_t>(place - shared.begin())];
                }
            }
            out_.triangles.push_back(triangle);
        }
        cut_.triangles.count = static_cast<Index>(pieces.size());
        out_.faces.push_back(cut_);
    }

    LineId add_cut(Index from, Index to) {
        const LineId name = LineId::of_cut(cut_.cuts.count++);
        label_cut(name, points_[from], points_[to]);
        return name;
    }

    void label_cut(LineId name, const Point& from, const Point& to) {
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
        Block row = block_from(out_.crossings);
        label_line(on_cut_, name, {length, from.site, to.site}, scratch_, out_.crossings);
        row.count = static_cast<Index>(out_.crossings.size()) - row.begin;
        out_.cuts.push_back({face_, from.name, to.name, row});
    }

    template <typename T>
    static Block block_from(const std::vector<T>& elements) {
        return {static_cast<Index>(elements.size()), 0};
    }

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    InsideRelays inside_relays_;
    FoundCuts& out_;

    // The face at hand.
    Index face_ = 0;
    CutFace cut_{};
    std::vector<PlanarRelay> relays_;
    RelayTree tree_;
    std::vector<Index> found_;
    std::vector<PlanarRelay> near_;  // Those found.
    std::vector<LineRelay> on_cut_;
    std::vector<Point> points_;
    FaceTriangulation triangulation_;
    LineScratch scratch_;
};

// The elements of a block, to be changed.
template <typename T>
std::vector<T> copy_of(const std::vector<T>& elements, const Block& block) {
    return {elements.begin() + block.begin, elements.begin() + block.end()};
}

// Adds a face's cuts to the labels, with indices into these.
CutFace add_cut_face(const FoundCuts& found, const CutFace& cut, Index num_vertices,
                     EdgeLabels& labels) {
    const auto inner_points = copy_of(found.inner_points, cut.inner_points);
    auto cuts = copy_of(found.cuts, cut.cuts);
    auto triangles = copy_of(found.triangles, cut.triangles);
    CutFace result{cut.face, labels.inner_points.add(inner_points), labels.cuts.add(cuts), {}};
    const auto point = [&](Index name) {
        return name < num_vertices ? name : name + result.inner_points.begin;
    };
    const auto side = [&](LineId line) {
        return line.is_cut() ? LineId::of_cut(line.cut() + result.cuts.begin) : line;
    };
    for (Cut& c : labels.cuts[result.cuts]) {
        c.from.point = point(c.from.point);
        c.to.point = point(c.to.point);
        auto crossings = copy_of(found.crossings, c.row);
        for (Crossing& crossing : crossings) crossing.line = side(crossing.line);
        c.row = labels.crossings.add(crossings);
    }
    for (CutTriangle& triangle : triangles) {
        for (CutEnd& end : triangle.points) end.point = point(end.point);
        for (LineId& line : triangle.sides) line = side(line);
    }
    result.triangles = labels.cut_triangles.add(triangles);
    labels.point_site.resize(num_vertices + labels.inner_points.size(), no_index);
    for (Index i = 0; i < inner_points.size(); ++i) {
        labels.point_site[num_vertices + result.inner_points.begin + i] = inner_points[i].site;
    }
    return result;
}

void count_cuts(const CutFace& face, DiagramParts& parts) {
    const EdgeLabels& labels = parts.labels;
    for (const InnerPoint& point : labels.inner_points[face.inner_points]) {
        parts.tally.count_inner_point(point);
    }
    for (const Cut& cut : labels.cuts[face.cuts]) {
        parts.tally.count_cut(labels.crossings[cut.row], labels.point_site[cut.to.point], 1);
    }
}

}  // namespace

void cut_faces(const StageInput& input, std::span<const Index> mixed, DiagramParts& parts) {
    if (input.placement.is_empty()) return;
    constexpr Index grain = 512;
    EdgeLabels& labels = parts.labels;
    const auto count = static_cast<Index>(mixed.size());
    std::vector<FoundCuts> found(num_chunks(count, grain));
    const auto cut_chunk = [&](Index chunk, Index begin, Index end) {
        FaceCutter cutter(input.surface, input.propagation, labels, found[chunk]);
        Ticker ticker(input.poller);
        for (Index i = begin; i < end; ++i) {
            const auto placed = input.placement.in_face(input.propagation.mixed_faces[mixed[i]]);
            if (!placed.empty()) cutter.cut(mixed[i], placed);
            ticker.tick(1 + relays_of(input.propagation, mixed[i]).size() * placed.size());
        }
    };
    parallel_chunks(count, grain, input.num_threads, cut_chunk, input.poller);
    const auto num_before = static_cast<std::ptrdiff_t>(labels.cut_faces.size());
    for (const FoundCuts& part : found) {
        input.poller.poll();
        for (const CutFace& cut : part.faces) {
            labels.cut_faces.push_back(
                add_cut_face(part, cut, input.surface.num_vertices(), labels));
            count_cuts(labels.cut_faces.back(), parts);
        }
    }
    std::inplace_merge(labels.cut_faces.begin(), labels.cut_faces.begin() + num_before,
                       labels.cut_faces.end(),
                       [](const CutFace& a, const CutFace& b) { return a.face < b.face; });
}

}  // namespace agvd
