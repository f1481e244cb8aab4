// A tree of boxes that halves the faces at the median of their centres. Ties go to the lowest
// face: sides are measured from the lower end, so that all faces give the same bits.
#include "agvd/mesh/closest_point.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "agvd/core/error.h"

namespace agvd {
namespace {

constexpr Index leaf_size = 2;

// Boxes are wider than their triangles by this share of the largest coordinate, so that points on
// edges, which carry rounding errors, are inside and ties are found.
constexpr double padding_share = 1e-15;

// Of a needle: the square of twice its area over the fourth power of its length.
constexpr double needle = 1e-8;
// A point with a barycentric coordinate below this may lie on the side.
constexpr double near_side = 1e-6;

bool comes_before(const Vec3& a, const Vec3& b) {
    return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

bool is_nearer(const ClosestPoint& point, const ClosestPoint& other) {
    return std::tie(point.distance_sq, point.point.face) <
           std::tie(other.distance_sq, other.point.face);
}

void take_nearer(ClosestPoint& best, const ClosestPoint& other) {
    if (is_nearer(other, best)) best = other;
}

// From the lower end.
ClosestPoint closest_point_on_side(const std::array<Vec3, 3>& corners, FaceId face, std::size_t k,
                                   const Vec3& query) {
    std::size_t from = k, to = (k + 1) % 3;
    if (comes_before(corners[to], corners[from])) std::swap(from, to);
    const Vec3& start = corners[from];
    const Vec3 along = corners[to] - start;
    const double length_sq = along.squaredNorm();
    const double t =
        length_sq > 0 ? std::clamp(along.dot(query - start) / length_sq, 0.0, 1.0) : 0.0;
    ClosestPoint result{{face, {0, 0, 0}}, t == 1 ? corners[to] : Vec3(start + t * along), 0};
    result.point.barycentric[from] = 1 - t;
    result.point.barycentric[to] = t;
    result.distance_sq = (query - result.position).squaredNorm();
    return result;
}

double box_distance_sq(const Vec3& low, const Vec3& high, const Vec3& query) {
    return (low - query).cwiseMax(query - high).cwiseMax(0.0).squaredNorm();
}

}  // namespace

ClosestPoint closest_point_on_triangle(const std::array<Vec3, 3>& corners, FaceId face,
                                       const Vec3& query) {
    const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0], w = query - corners[0];
    const Vec3 normal = u.cross(v);
    const double normal_sq = normal.squaredNorm();
    const double scale = 1 / normal_sq;
    const double b1 = w.cross(v).dot(normal) * scale;
    const double b2 = u.cross(w).dot(normal) * scale;
    const std::array<double, 3> b{1 - b1 - b2, b1, b2};
    // In a needle the foot of the perpendicular is inaccurate, so all sides are tested. Elsewhere
    // only the sides are tested that the foot lies beyond, or nearly beyond.
    const double longest_sq = std::max(u.squaredNorm(), v.squaredNorm());
    const bool is_needle = !(normal_sq > needle * longest_sq * longest_sq);
    ClosestPoint best;
    best.distance_sq = infinity;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!is_needle && b[(k + 2) % 3] > near_side) continue;
        take_nearer(best, closest_point_on_side(corners, face, k, query));
    }
    if (b[0] > 0 && b[1] > 0 && b[2] > 0) {  // False for NaN, when there is no area.
        const Vec3 foot = b[0] * corners[0] + b[1] * corners[1] + b[2] * corners[2];
        take_nearer(best, {{face, b}, foot, (query - foot).squaredNorm()});
    }
    return best;
}

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a, from = point - a;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0;
    return (from - t * along).norm();
}

ClosestPointTree::ClosestPointTree(const MeshView& mesh, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    if (num_faces == 0) {
        throw InvalidInput("the mesh has no face; check that the file holds a surface");
    }
    std::vector<Vec3> centers(num_faces);
    for (Index f = 0; f < num_faces; ++f) {
        const auto [a, b, c] = corners_of(mesh, f);
        centers[f] = (a + b + c) / 3;
    }
    std::vector<Index> faces(num_faces);
    std::iota(faces.begin(), faces.end(), Index{0});
    nodes_.reserve(num_faces);
    build(centers, faces, 0, num_faces, ticker);

    corners_.reserve(num_faces);
    face_.reserve(num_faces);
    for (const Index face : faces) {
        corners_.push_back(corners_of(mesh, face));
        face_.emplace_back(face);
    }
    // Children follow their node, so in a backward loop they are done before it.
    const Node& root = nodes_.front();
    for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
        ticker.tick();
        if (node->right != 0) {
            const Node& first = *(&*node + 1);
            node->low = first.low.cwiseMin(nodes_[node->right].low);
            node->high = first.high.cwiseMax(nodes_[node->right].high);
            continue;
        }
        node->low = node->high = corners_[node->begin][0];
        for (Index slot = node->begin; slot < node->end; ++slot) {
            for (const Vec3& corner : corners_[slot]) {
                node->low = node->low.cwiseMin(corner);
                node->high = node->high.cwiseMax(corner);
            }
        }
    }
    const double padding =
        padding_share * root.low.cwiseAbs().cwiseMax(root.high.cwiseAbs()).maxCoeff();
    for (Node& node : nodes_) {
        node.low.array() -= padding;
        node.high.array() += padding;
    }
}

void ClosestPointTree::build(const std::vector<Vec3>& centers, std::vector<Index>& faces,
                             Index begin, Index end, Ticker& ticker) {
    ticker.tick();
    const auto self = static_cast<Index>(nodes_.size());
    nodes_.push_back({.begin = begin, .end = end});
    if (end - begin <= leaf_size) return;
    Vec3 low = centers[faces[begin]], high = low;
    for (Index i = begin; i < end; ++i) {
        low = low.cwiseMin(centers[faces[i]]);
        high = high.cwiseMax(centers[faces[i]]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(faces.begin() + begin, faces.begin() + middle, faces.begin() + end,
                     [&](Index a, Index b) {
                         ticker.tick();
                         return std::tie(centers[a][axis], a) < std::tie(centers[b][axis], b);
                     });
    build(centers, faces, begin, middle, ticker);
    nodes_[self].right = static_cast<Index>(nodes_.size());
    build(centers, faces, middle, end, ticker);
}

ClosestPoint ClosestPointTree::query(const Vec3& point) const {
    Index hint = 0;
    return query(point, hint);
}

ClosestPoint ClosestPointTree::query(const Vec3& point, Index& hint) const {
    Found best{closest_point_on_triangle(corners_[hint], face_[hint], point), hint};
    search(point, infinity, -infinity, best);
    hint = best.slot;
    return best.nearest;
}

bool ClosestPointTree::is_within(const Vec3& point, double distance) const {
    const double most_sq = distance * distance;
    Found best;
    best.nearest.distance_sq = infinity;
    search(point, most_sq, most_sq, best);
    return best.nearest.distance_sq <= most_sq;
}

void ClosestPointTree::take_nearer(Index slot, const Vec3& point, Found& best) const {
    const ClosestPoint here = closest_point_on_triangle(corners_[slot], face_[slot], point);
    if (is_nearer(here, best.nearest)) best = {here, slot};
}

// Finds what is nearer than `best`, among points no farther than `most_sq`, up to the first no
// farther than `enough_sq`.
void ClosestPointTree::search(const Vec3& point, double most_sq, double enough_sq,
                              Found& best) const {
    const auto distance_sq = [&](Index node) {
        return box_distance_sq(nodes_[node].low, nodes_[node].high, point);
    };
    struct Waiting {
        double distance_sq;
        Index node;
    };
    std::array<Waiting, 64> stack;  // One per level; halving keeps it below 32.
    std::size_t waiting = 0;
    stack[waiting++] = {distance_sq(0), 0};
    while (waiting > 0 && best.nearest.distance_sq > enough_sq) {
        const auto [distance, self] = stack[--waiting];
        // An equally near box may hold a lower face.
        if (distance > std::min(most_sq, best.nearest.distance_sq)) continue;
        const Node& node = nodes_[self];
        if (node.right == 0) {
            for (Index slot = node.begin; slot < node.end; ++slot) {
                take_nearer(slot, point, best);
            }
            continue;
        }
        Waiting near{distance_sq(self + 1), self + 1};
        Waiting far{distance_sq(node.right), node.right};
        if (far.distance_sq < near.distance_sq) std::swap(near, far);
        stack[waiting++] = far;
        stack[waiting++] = near;
    }
}

}  // namespace agvd
