#include "agvd/diagram/cuts.h"

#include <algorithm>
#include <limits>

#include "agvd/core/parallel.h"
#include "agvd/diagram/inside_relays.h"

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
        points_.clear();
        const auto corners = face_corners(surface_, face_);
        triangles_.assign(1, {0, 1, 2});
        for (std::size_t k = 0; k < 3; ++k) {
            points_.push_back({surface_.mesh.triangles[face_][k], corners[k]});
        }
        for (const PlacedSite& site : placed) add_site(site);
        if (triangles_.size() == 1) return;
        sides_.clear();
        for (Index k = 0; k < 3; ++k) {
            sides_.push_back({std::min(k, (k + 1) % 3), std::max(k, (k + 1) % 3), 3 * face_ + k});
        }
        out_.faces.push_back({mixed_index, static_cast<Index>(out_.triangles.size()),
                              static_cast<Index>(triangles_.size())});
        for (const auto& t : triangles_) {
            CutTriangle& triangle = out_.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                triangle.points[k] = points_[t[k]].name;
                triangle.sides[k] = find_side(t[k], t[(k + 1) % 3]);
            }
        }
    }

private:
    struct Point {
        Index name;
        Vec2 position;
    };
    struct Side {
        Index from, to;  // Of points_, from < to.
        Index name;
    };

    // Splits the triangle that holds the site in three.
    void add_site(const PlacedSite& placed) {
        if (half_edge_of(placed.point)) return;
        const Vec2 p = position_in_frame(surface_, placed.point, 3 * face_);
        if (nearest(relays_, p).site != placed.site) return;
        const std::size_t holder = find_triangle(p);
        const Triangle old = triangles_[holder];
        const auto n = static_cast<Index>(points_.size());
        const auto inner = static_cast<Index>(out_.inner_points.size());
        points_.push_back({surface_.num_vertices() + inner, p});
        out_.inner_points.push_back({face_, p, placed.site});
        triangles_[holder] = {old[0], old[1], n};
        triangles_.push_back({old[1], old[2], n});
        triangles_.push_back({old[2], old[0], n});
    }

    [[nodiscard]] Index site_of(const Point& point) const {
        return point.name < surface_.num_vertices()
                   ? labels_.point_site[point.name]
                   : out_.inner_points[point.name - surface_.num_vertices()].site;
    }

    [[nodiscard]] std::size_t find_triangle(const Vec2& p) const {
        std::size_t best = 0;
        double best_margin = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            double margin = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2& a = points_[triangles_[i][k]].position;
                const Vec2& b = points_[triangles_[i][(k + 1) % 3]].position;
                margin = std::min(margin, cross(b - a, p - a));
            }
            if (margin > best_margin) {
                best_margin = margin;
                best = i;
            }
        }
        return best;
    }

    Index find_side(Index a, Index b) {
        const Index from = std::min(a, b);
        const Index to = std::max(a, b);
        for (const Side& side : sides_) {
            if (side.from == from && side.to == to) return side.name;
        }
        const Index name = CrossingRow::first_cut + static_cast<Index>(out_.cuts.size());
        sides_.push_back({from, to, name});
        label_cut(name, points_[from], points_[to]);
        return name;
    }

    void label_cut(Index name, const Point& from, const Point& to) {
        const Vec2 chord = to.position - from.position;
        const double length = chord.norm();
        on_cut_.clear();
        for (const PlanarRelay& relay : relays_) {
            on_cut_.push_back(on_line(relay, from.position, chord / length, length));
        }
        label_envelope(on_cut_, length, site_of(from), site_of(to), scratch_, intervals_);
        const auto count = static_cast<Index>(intervals_.size()) - 1;
        const Index row = count == 0 ? no_index : static_cast<Index>(out_.rows.size());
        out_.cuts.push_back({face_, from.name, to.name, row});
        if (count == 0) return;
        out_.rows.push_back({name, static_cast<Index>(out_.crossings.size()), count});
        for (Index i = 0; i < count; ++i) {
            const Index before = intervals_[i].site;
            const Index after = intervals_[i + 1].site;
            const double at = intervals_[i].end;
            out_.crossings.push_back({at,
                                      std::max(distance_on_line(on_cut_, before, at * length),
                                               distance_on_line(on_cut_, after, at * length)),
                                      before, after});
        }
    }

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    InsideRelays inside_relays_;
    FoundCuts& out_;

    // The face at hand.
    Index face_ = 0;
    std::vector<PlanarRelay> relays_;
    std::vector<LineRelay> on_cut_;
    std::vector<Point> points_;
    std::vector<Triangle> triangles_;
    std::vector<Side> sides_;
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
