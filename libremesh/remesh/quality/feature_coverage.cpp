// Points at equal distances along the sharp edges of one mesh count as covered near the blunt edges
// of the other.
#include "remesh/quality/evaluate.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <unordered_map>

#include "agvd/core/random.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "remesh/curves/curve_network.h"

namespace remesh {
namespace {

constexpr double sharp = 40 * degree;
constexpr double blunt = 25 * degree;
constexpr double corner_turn = 45 * degree;
constexpr double acute = 30 * degree;

// In diagonals of the original.
constexpr double near = 1e-3, very_near = 2e-4, near_corner = 5e-4;
constexpr double narrow_original = 1e-6, narrow_result = 1e-9;

constexpr Index num_points = 20'000;

constexpr int most_steps = 6;  // Over narrow faces.

struct EdgeDihedral {
    Index ends[2];
    // Between the normals of the two faces, both seen from the same side of the surface for any
    // orientation, radians; pi for any other number of faces.
    double angle;
    Index num_faces;
};

// Normals of faces as seen from their edges. A narrow face has no reliable normal: it takes the one
// of the face across its longest other side, over a few such steps.
class FaceNormals {
public:
    FaceNormals(const MeshView& mesh, std::span<const EdgeSide> sides, double narrow,
                Ticker& ticker)
        : across_(sides.size(), no_index), is_forward_(sides.size()), length_(sides.size()) {
        for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
            ticker.tick();
            const double length =
                (mesh.positions[edge[0].low()] - mesh.positions[edge[0].high()]).norm();
            for (const EdgeSide& side : edge) {
                is_forward_[side.half_edge] = side.forward;
                length_[side.half_edge] = length;
            }
            if (edge.size() != 2) return;
            across_[edge[0].half_edge] = edge[1].half_edge;
            across_[edge[1].half_edge] = edge[0].half_edge;
        });
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            ticker.tick();
            const Vec3 area = doubled_normal(mesh.positions, mesh.triangles[f]);
            const double twice = area.norm();
            const double longest =
                std::max({length_[3 * f], length_[3 * f + 1], length_[3 * f + 2]});
            is_narrow_.push_back(twice <= narrow * longest);
            normals_.push_back(twice > 0 ? Vec3(area / twice) : Vec3(Vec3::Zero()));
        }
    }

    // Normal of the surface at this side, on the left of its edge from the lower vertex to the
    // higher; zero if there is none.
    [[nodiscard]] Vec3 normal(Index h) const {
        bool is_up = is_forward_[h];
        for (int step = 0; is_narrow_[h / 3] && step <= most_steps; ++step) {
            const Index exit = longest_other_side(h);
            if (exit == no_index) break;
            h = across_[exit];
            // The face across is oriented the other way.
            if (is_forward_[h] == is_forward_[exit]) is_up = !is_up;
        }
        return is_up ? normals_[h / 3] : Vec3(-normals_[h / 3]);
    }

private:
    // The longest other half-edge of the face that has exactly one face across.
    [[nodiscard]] Index longest_other_side(Index h) const {
        Index best = no_index;
        for (Index k = 3 * (h / 3); k < 3 * (h / 3) + 3; ++k) {
            if (k == h || across_[k] == no_index) continue;
            if (best == no_index || length_[k] > length_[best]) best = k;
        }
        return best;
    }

    std::vector<Index> across_;     // #H: the other side of an edge with two; otherwise no_index.
    std::vector<bool> is_forward_;  // #H.
    std::vector<double> length_;    // #H.
    std::vector<bool> is_narrow_;   // #F.
    std::vector<Vec3> normals_;     // #F.
};

// \param narrow  mesh units: a lower face takes the normal of one beside it.
std::vector<EdgeDihedral> edge_dihedrals(const MeshView& mesh, double narrow, Ticker& ticker) {
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles, ticker);
    const FaceNormals normals(mesh, sides, narrow, ticker);
    std::vector<EdgeDihedral> edges;
    for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        ticker.tick();
        double angle = std::numbers::pi;
        if (edge.size() == 2) {
            // Seen from the edge, the other face lies on the other side, so its normal is turned.
            const Vec3 a = normals.normal(edge[0].half_edge),
                       b = -normals.normal(edge[1].half_edge);
            angle = angle_between(a, b);
        }
        edges.push_back({{edge[0].low(), edge[0].high()}, angle, static_cast<Index>(edge.size())});
    });
    return edges;
}

// The mesh without copies: vertices with equal coordinates are one, faces that repeat a vertex or
// another face are dropped.
TriangleMesh without_copies(const MeshView& mesh, Ticker& ticker) {
    TriangleMesh result;
    std::unordered_map<Vec3, Index, PositionHash> indices;
    std::vector<Index> index_of(mesh.positions.size(), no_index);
    std::vector<std::pair<Triangle, Index>> faces;  // Sorted corners, face.
    std::vector<Triangle> kept;
    for (const Triangle& t : mesh.triangles) {
        ticker.tick(8);
        Triangle face;
        for (std::size_t k = 0; k < 3; ++k) {
            Index& index = index_of[t[k]];
            if (index == no_index) {
                const auto [it, is_new] = indices.try_emplace(
                    mesh.positions[t[k]], static_cast<Index>(result.positions.size()));
                if (is_new) result.positions.push_back(mesh.positions[t[k]]);
                index = it->second;
            }
            face[k] = index;
        }
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        Triangle corners = face;
        std::sort(corners.begin(), corners.end());
        faces.emplace_back(corners, static_cast<Index>(kept.size()));
        kept.push_back(face);
    }
    sort_ticked(faces, ticker, std::less<>());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        ticker.tick();
        if (i > 0 && faces[i].first == faces[i - 1].first) continue;
        result.triangles.push_back(kept[faces[i].second]);
    }
    return result;
}

enum class BoundaryEdges { Counts, DoesNot };

// A mesh without copies, and its edges.
struct Edges {
    TriangleMesh mesh;
    std::vector<EdgeDihedral> all;

    // Calls use(end, end) for edges above an angle.
    template <typename Use>
    void for_each_above(double angle, BoundaryEdges boundary, const Use& use) const {
        for (const EdgeDihedral& e : all) {
            const bool is_above =
                e.num_faces == 1 ? boundary == BoundaryEdges::Counts : e.angle > angle;
            if (is_above) use(e.ends[0], e.ends[1]);
        }
    }
    [[nodiscard]] double sharp_length() const {
        double sum = 0;
        for_each_above(sharp, BoundaryEdges::DoesNot, [&](Index a, Index b) {
            sum += (mesh.positions[b] - mesh.positions[a]).norm();
        });
        return sum;
    }
};

// Points at equal distances along all sharp edges, one edge after the other.
std::vector<Vec3> points_on_sharp(const Edges& edges, double length, Ticker& ticker) {
    const double step = length / num_points;
    std::vector<Vec3> points;
    double before = 0;  // Length of the edges before this one.
    edges.for_each_above(sharp, BoundaryEdges::DoesNot, [&](Index from, Index to) {
        ticker.tick();
        const Vec3 &a = edges.mesh.positions[from], &b = edges.mesh.positions[to];
        const double here = (b - a).norm();
        while (points.size() < num_points) {
            const double along = (static_cast<double>(points.size()) + 0.5) * step - before;
            if (along > here) break;
            points.push_back(a + along / here * (b - a));
        }
        before += here;
    });
    return points;
}

// Tells which points lie near some segments.
class NearSegments {
public:
    // A point if both ends are equal.
    void add(const Vec3& a, const Vec3& b) {
        const auto first = static_cast<Index>(segments_.positions.size());
        segments_.positions.insert(segments_.positions.end(), {a, b});
        segments_.triangles.push_back({first, first + 1, first + 1});
    }
    // After all were added. Cost: O(n log n).
    void finish(Poller& poller) {
        if (!segments_.triangles.empty()) tree_.emplace(segments_.view(), poller.progress());
    }
    [[nodiscard]] bool has_near(const Vec3& point, double distance, Ticker& ticker) const {
        ticker.tick(64);  // Steps of a query.
        return tree_ && tree_->is_within(point, distance);
    }
    [[nodiscard]] Index count_near(const std::vector<Vec3>& points, double distance,
                                   Ticker& ticker) const {
        return static_cast<Index>(std::ranges::count_if(
            points, [&](const Vec3& p) { return has_near(p, distance, ticker); }));
    }

private:
    TriangleMesh segments_;  // As triangles without area.
    std::optional<ClosestPointTree> tree_;
};

NearSegments blunt_edges(const Edges& edges, BoundaryEdges boundary, Poller& poller) {
    NearSegments segments;
    edges.for_each_above(blunt, boundary, [&](Index a, Index b) {
        segments.add(edges.mesh.positions[a], edges.mesh.positions[b]);
    });
    segments.finish(poller);
    return segments;
}

NearSegments points_of(const std::vector<Vec3>& points, Poller& poller) {
    NearSegments segments;
    for (const Vec3& p : points) segments.add(p, p);
    segments.finish(poller);
    return segments;
}

struct Corners {
    std::vector<Vec3> all, acute;
};

Corners corners_of(const Edges& edges, Ticker& ticker) {
    const auto& p = edges.mesh.positions;
    std::vector<std::pair<Index, Index>> ends;  // (vertex, neighbour).
    edges.for_each_above(sharp, BoundaryEdges::Counts, [&](Index a, Index b) {
        ends.emplace_back(a, b);
        ends.emplace_back(b, a);
    });
    sort_ticked(ends, ticker, std::less<>());
    Corners corners;
    for (std::size_t i = 0, j = 0; i < ends.size(); i = j) {
        while (j < ends.size() && ends[j].first == ends[i].first) ++j;
        const Vec3& here = p[ends[i].first];
        bool is_corner = j - i > 2;
        if (j - i == 2) {
            const Vec3 in = here - p[ends[i].second], out = p[ends[i + 1].second] - here;
            is_corner = angle_between(in, out) > corner_turn;
        }
        if (!is_corner) continue;
        corners.all.push_back(here);
        double least = acute;
        for (std::size_t k = i; k < j; ++k) {
            for (std::size_t l = i; l < k; ++l) {
                const Vec3 first = p[ends[k].second] - here, second = p[ends[l].second] - here;
                least = std::min(least, angle_between(first, second));
            }
        }
        if (least < acute) corners.acute.push_back(here);
    }
    return corners;
}

// The smallest angle of triangles without a vertex near any of the points.
double min_angle_off(const NearSegments& points, const TriangleMesh& mesh, double reach,
                     Ticker& ticker) {
    const auto is_near = [&](Index v) { return points.has_near(mesh.positions[v], reach, ticker); };
    double least = std::numbers::pi;
    for (const Triangle& t : mesh.triangles) {
        ticker.tick();
        if (std::any_of(t.begin(), t.end(), is_near)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& here = mesh.positions[t[k]];
            least = std::min(least, angle_between(mesh.positions[t[(k + 1) % 3]] - here,
                                                  mesh.positions[t[(k + 2) % 3]] - here));
        }
    }
    return least;
}

}  // namespace

std::optional<FeatureCoverage> feature_coverage(const MeshView& original, const MeshView& result,
                                                const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    Edges before{without_copies(original, ticker), {}};
    MeshBox box;
    for (const Vec3& p : before.mesh.positions) box.add(p);
    const double diagonal = box.is_empty() ? 0 : (box.high - box.low).norm();
    before.all = edge_dihedrals(before.mesh.view(), narrow_original * diagonal, ticker);
    FeatureCoverage coverage{.length = before.sharp_length(), .diagonal = diagonal};
    const Corners corners = corners_of(before, ticker);
    if (coverage.length == 0 && corners.all.empty()) return std::nullopt;
    Edges after{without_copies(result, ticker), {}};
    after.all = edge_dihedrals(after.mesh.view(), narrow_result * diagonal, ticker);
    coverage.result_length = after.sharp_length();
    if (coverage.length > 0) {
        const std::vector<Vec3> points = points_on_sharp(before, coverage.length, ticker);
        const NearSegments edges = blunt_edges(after, BoundaryEdges::DoesNot, poller);
        const auto share_near = [&](double distance) {
            return edges.count_near(points, distance * diagonal, ticker) /
                   static_cast<double>(points.size());
        };
        coverage.covered = share_near(near);
        coverage.covered_closely = share_near(very_near);
    }
    if (coverage.result_length > 0) {
        const std::vector<Vec3> points = points_on_sharp(after, coverage.result_length, ticker);
        const NearSegments edges = blunt_edges(before, BoundaryEdges::Counts, poller);
        coverage.false_share = 1 - edges.count_near(points, near * diagonal, ticker) /
                                       static_cast<double>(points.size());
    }
    const double reach = near_corner * diagonal;
    coverage.corners = static_cast<Index>(corners.all.size());
    coverage.corners_kept =
        points_of(after.mesh.positions, poller).count_near(corners.all, reach, ticker);
    coverage.acute_corners = static_cast<Index>(corners.acute.size());
    coverage.min_angle_elsewhere =
        min_angle_off(points_of(corners.acute, poller), after.mesh, reach, ticker);
    return coverage;
}

}  // namespace remesh
