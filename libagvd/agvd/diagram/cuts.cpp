#include "agvd/diagram/cuts.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/face_triangulation.h"
#include "agvd/diagram/inside_relays.h"
#include "agvd/diagram/relay_tree.h"

namespace agvd {
namespace {

// What the faces of one chunk add to the labels, numbered as if it were the first.
struct FoundCuts {
    std::vector<InnerPoint> inner_points;
    std::vector<Cut> cuts;
    std::vector<CrossingRow> rows;
    std::vector<Crossing> crossings;
    std::vector<CutTriangle> triangles;
    std::vector<CutFace> faces;
};

class FaceCutter {
public:
    FaceCutter(const Surface& surface, const Propagation& propagation, const RelayGroups& groups,
               const EdgeLabels& labels, FoundCuts& out)
        : surface_(surface),
          propagation_(propagation),
          labels_(labels),
          inside_relays_(surface, propagation, groups, labels),
          out_(out) {}

    void cut(Index mixed_index, std::span<const PlacedSite> placed) {
        face_ = propagation_.mixed_faces[mixed_index];
        inside_relays_.gather_all(mixed_index, relays_);
        tree_.build(relays_);
        points_.clear();
        const auto corners = face_corners(surface_, face_);
        triangulation_.reset(corners);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = surface_.mesh.triangles[face_][k];
            points_.push_back({v, corners[k], labels_.point_site[v], labels_.vertex_distance[v]});
        }
        for (const PlacedSite& site : placed) add_site(site);
        if (points_.size() > 3) append_triangles(mixed_index);
    }

private:
    struct Point {
        Index name;
        Vec2 position;
        Index site;
        double distance;
    };

    void add_site(const PlacedSite& placed) {
        if (half_edge_of(placed.point)) return;
        const Vec2 p = position_in_frame(surface_, placed.point, 3 * face_);
        const double distance = least_reach(of_site(relays_, placed.site), p).distance;
        find_near(p, distance);
        if (nearest(near_, p).site != placed.site) return;
        const auto inner = static_cast<Index>(out_.inner_points.size());
        points_.push_back({surface_.num_vertices() + inner, p, placed.site, distance});
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

    void append_triangles(Index mixed_index) {
        const auto& pieces = triangulation_.pieces();
        const auto first = static_cast<Index>(out_.triangles.size());
        out_.faces.push_back({mixed_index, first, static_cast<Index>(pieces.size())});
        for (Index i = 0; i < pieces.size(); ++i) {
            CutTriangle triangle;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index from = pieces[i].points[k];
                const Index to = pieces[i].points[k == 2 ? 0 : k + 1];
                const Index beside = pieces[i].beside[k];
                triangle.points[k] = points_[from].name;
                if (beside == no_index) {
                    triangle.sides[k] = 3 * face_ + from;
                } else if (beside > i) {
                    triangle.sides[k] = add_cut(std::min(from, to), std::max(from, to));
                } else {
                    const auto& shared = pieces[beside].points;
                    const auto place = std::find(shared.begin(), shared.end(), to);
                    triangle.sides[k] =
                        out_.triangles[first + beside].sides[place - shared.begin()];
                }
            }
            out_.triangles.push_back(triangle);
        }
    }

    Index add_cut(Index from, Index to) {
        const Index name = CrossingRow::first_cut + static_cast<Index>(out_.cuts.size());
        label_cut(name, points_[from], points_[to]);
        return name;
    }

    void label_cut(Index name, const Point& from, const Point& to) {
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
        Crossing single{0, 0, from.site, to.site};
        if (from.site != to.site &&
            find_single_crossing(on_cut_, length, from.site, to.site, single.at, single.distance)) {
            single.at /= length;
            append_row(name, from, to, {&single, 1});
            return;
        }
        label_envelope(on_cut_, length, from.site, to.site, scratch_, intervals_);
        crossings_.clear();
        for (std::size_t i = 0; i + 1 < intervals_.size(); ++i) {
            const Index before = intervals_[i].site;
            const Index after = intervals_[i + 1].site;
            const double at = intervals_[i].end;
            crossings_.push_back({at,
                                  std::max(distance_on_line(on_cut_, before, at * length),
                                           distance_on_line(on_cut_, after, at * length)),
                                  before, after});
        }
        append_row(name, from, to, crossings_);
    }

    void append_row(Index name, const Point& from, const Point& to,
                    std::span<const Crossing> crossings) {
        const bool has_one_label = crossings.empty();
        out_.cuts.push_back({face_, from.name, to.name,
                             has_one_label ? no_index : static_cast<Index>(out_.rows.size())});
        if (has_one_label) return;
        out_.rows.push_back({name, static_cast<Index>(out_.crossings.size()),
                             static_cast<Index>(crossings.size())});
        out_.crossings.insert(out_.crossings.end(), crossings.begin(), crossings.end());
    }

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    InsideRelays inside_relays_;
    FoundCuts& out_;

    // The face at hand.
    Index face_ = 0;
    std::vector<PlanarRelay> relays_;
    RelayTree tree_;
    std::vector<Index> found_;
    std::vector<PlanarRelay> near_;  // Those found.
    std::vector<LineRelay> on_cut_;
    std::vector<Point> points_;
    FaceTriangulation triangulation_;
    std::vector<Crossing> crossings_;
    std::vector<LabelInterval> intervals_;
    EnvelopeScratch scratch_;
};

// Renumbers.
void append_cuts(const FoundCuts& found, Index num_vertices, EdgeLabels& labels) {
    const auto first_inner = static_cast<Index>(labels.inner_points.size());
    const auto first_cut = static_cast<Index>(labels.cuts.size());
    const auto first_row = static_cast<Index>(labels.rows.size());
    const auto first_crossing = static_cast<Index>(labels.crossings.size());
    const auto first_triangle = static_cast<Index>(labels.cut_triangles.size());
    const auto point = [&](Index name) { return name < num_vertices ? name : name + first_inner; };
    for (const InnerPoint& inner : found.inner_points) {
        labels.point_site.push_back(inner.site);
        labels.inner_points.push_back(inner);
    }
    for (const Cut& cut : found.cuts) {
        const Index row = cut.row == no_index ? no_index : cut.row + first_row;
        labels.cuts.push_back({cut.face, point(cut.from), point(cut.to), row});
    }
    for (const CrossingRow& row : found.rows) {
        labels.rows.push_back({row.edge + first_cut, row.begin + first_crossing, row.count});
    }
    labels.crossings.insert(labels.crossings.end(), found.crossings.begin(), found.crossings.end());
    for (CutTriangle triangle : found.triangles) {
        for (Index& name : triangle.points) name = point(name);
        for (Index& side : triangle.sides) {
            if (side >= CrossingRow::first_cut) side += first_cut;
        }
        labels.cut_triangles.push_back(triangle);
    }
    for (const CutFace& face : found.faces) {
        labels.cut_faces.push_back(
            {face.mixed_index, face.first_triangle + first_triangle, face.num_triangles});
    }
}

}  // namespace

void cut_faces(const Surface& surface, const Propagation& propagation,
               const SitePlacement& placement, const RelayGroups& groups, int num_threads,
               EdgeLabels& labels) {
    if (placement.is_empty()) return;
    constexpr Index grain = 512;
    const auto num_mixed = static_cast<Index>(propagation.mixed_faces.size());
    std::vector<FoundCuts> found(num_chunks(num_mixed, grain));
    parallel_chunks(num_mixed, grain, num_threads, [&](Index chunk, Index begin, Index end) {
        FaceCutter cutter(surface, propagation, groups, labels, found[chunk]);
        for (Index i = begin; i < end; ++i) {
            const auto placed = placement.in_face(propagation.mixed_faces[i]);
            if (!placed.empty()) cutter.cut(i, placed);
        }
    });
    for (const FoundCuts& part : found) append_cuts(part, surface.num_vertices(), labels);
}

}  // namespace agvd
