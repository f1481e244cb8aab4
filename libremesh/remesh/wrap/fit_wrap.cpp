// A wrap lies around its input at a distance, and cuts off edges and corners. Its vertices move to
// the nearest points of the input. Edges whose ends then lie on faces that meet at an angle are
// split where these meet: the planes below the ends give the point, as in [attene2005] and, for the
// vertices of cells, in [ju2002]. So creases become chains of edges. Other edges are flipped or
// split where the input between their ends is far from them. No step adds an intersection.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/core/portable_math.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/quality/evaluate.h"
#include "remesh/wrap/guarded_mesh.h"
#include "remesh/wrap/wrap.h"

namespace remesh::detail {
namespace {

constexpr Index queries_per_chunk = 256;
constexpr int most_rounds = 3;

// As shares of the radius. Edges farther from the input are split.
constexpr double tolerance_share = 1.0 / 40;
// Points so near each other, or to a plane, are one, or lie on it.
constexpr double same_share = 1e-5;
// Of their distance from sheets, vertices keep this share: less, and a coarse mesh of a curved
// sheet has no room for its two sides.
constexpr double sheet_share = 0.5;
// No crease is looked for farther away: where faces meet at 40 degrees balls stay as far from it.
constexpr double most_reach = 2;
// Cosines of 20, 165 and 40 degrees. Faces that meet at a smaller angle, or fold back, make no
// crease, or no corner.
constexpr double crease_cosine = 0.9396926207859084, folded_cosine = -0.9659258262890683,
                 corner_cosine = 0.766044443118978;
// A vertex goes to a crease if it is nearer to it than this share of the edge across, and to a
// corner from twice as far.
constexpr double snap_share = 0.2;

// The input below a point outside of it.
struct Foot {
    Vec3 point = Vec3::Zero();   // Of the input.
    Vec3 normal = Vec3::Zero();  // Unit vector from there to the point outside.
};

bool meet_at_angle(const Foot& a, const Foot& b) {
    const double cosine = a.normal.dot(b.normal);
    return cosine < crease_cosine && cosine > folded_cosine;
}

struct FitVertex {
    Vec3 outside;
    Foot foot;
    bool is_sharp = false;  // On a crease.
    bool stays = false;     // Off the input, as it is on a sheet, or faces would intersect.
};

class WrapFitter {
public:
    WrapFitter(const TriangleMesh& wrap, const ClosestPointTree& tree,
               const FitWrapOptions& options)
        : options_(options),
          wrap_(wrap),
          tree_(tree),
          mesh_(wrap),
          vertices_(wrap.positions.size()) {
        for_each(mesh_->num_vertices(), [&](Index v) {
            vertices_[v] = {wrap.positions[v], foot_of(wrap.positions[v])};
        });
        find_sheets();
    }

    // \param has_creases  whether edges follow creases and curved faces.
    // \return nothing if faces intersect.
    std::optional<FittedWrap> run(bool has_creases) {
        move_to_feet();
        collapse_short_edges();
        if (has_creases) follow_input();
        return move_apart() ? std::optional(result()) : std::nullopt;
    }

private:
    void follow_input() {
        for (int round = 0; round < most_rounds && split_at_creases(); ++round) {
        }
        collapse_short_edges();
        straighten();
        add_corners();
        for (int round = 0; round < most_rounds && split_far_edges(); ++round) {
        }
        straighten();
    }

    struct Edge {
        Index from, to;
        std::array<Index, 2> apexes;
        std::optional<FitVertex> split = {};
    };

    template <typename Each>
    void for_each(Index count, const Each& each) const {
        Poller poller(options_.progress);
        parallel_each(count, queries_per_chunk, options_.num_threads, each, poller);
    }
    [[nodiscard]] double tolerance() const { return tolerance_share * options_.radius; }
    [[nodiscard]] double same() const { return same_share * options_.radius; }
    [[nodiscard]] const Vec3& at(Index v) const { return mesh_->at(v); }
    [[nodiscard]] Vec3 middle_outside(Index a, Index b) const {
        return (vertices_[a].outside + vertices_[b].outside) / 2;
    }

    [[nodiscard]] Foot foot_of(const Vec3& outside) const {
        const Vec3 point = tree_.query(outside).position;
        return {point, (outside - point).normalized()};
    }

    // Vertices of walls so thin that their sides would meet on the input, or nearly.
    void find_sheets() {
        const double offset = wrap_offset * options_.radius;
        const ClosestPointTree surface(wrap_, options_.progress);
        for_each(mesh_->num_vertices(), [&](Index v) {
            const Foot& foot = vertices_[v].foot;
            const ClosestPoint other = surface.query(foot.point - offset * foot.normal);
            vertices_[v].stays = other.distance_sq < offset * offset / 4 &&
                                 foot_of(other.position).normal.dot(foot.normal) < folded_cosine;
        });
    }

    void move_to_feet() {
        std::vector<Index> waiting;
        for (Index v = 0; v < vertices_.size(); ++v) {
            if (!vertices_[v].stays) waiting.push_back(v);
        }
        for (int round = 0; round < most_rounds && !waiting.empty(); ++round) {
            std::erase_if(waiting, [&](Index v) { return mesh_.move(v, vertices_[v].foot.point); });
        }
        for (Index v = 0; v < vertices_.size(); ++v) {
            const Vec3& foot = vertices_[v].foot.point;
            if (vertices_[v].stays) mesh_.move(v, foot + sheet_share * (at(v) - foot));
        }
        for (const Index v : waiting) vertices_[v].stays = true;
    }

    // The point near `start` where the faces below two points outside meet. Each step looks at the
    // faces nearer to it; they are there if it lies on their planes.
    [[nodiscard]] std::optional<Foot> crease_point(Foot a, Foot b, const Vec3& start) const {
        constexpr int most_steps = 5;
        const double probe = wrap_offset / 2 * options_.radius;
        Vec3 x = start;
        for (int step = 0; step < most_steps; ++step) {
            if (!meet_at_angle(a, b)) return std::nullopt;
            const double cosine = a.normal.dot(b.normal), det = 1 - cosine * cosine;
            const double to_a = a.normal.dot(a.point - x), to_b = b.normal.dot(b.point - x);
            x += (to_a - cosine * to_b) / det * a.normal + (to_b - cosine * to_a) / det * b.normal;
            if ((x - start).norm() > most_reach * options_.radius) return std::nullopt;
            const Vec3 above = x + probe * (a.normal + b.normal).normalized();
            const auto nearer = [&](const Foot& foot) {
                const Vec3 along = foot.point - x;
                const double length = along.norm();
                return foot_of(length > 0 ? Vec3(above + std::min(1.0, 2 * probe / length) * along)
                                          : above);
            };
            a = nearer(a);
            b = nearer(b);
            const double off =
                std::max(std::abs(a.normal.dot(a.point - x)), std::abs(b.normal.dot(b.point - x)));
            if (off < (step + 1 < most_steps ? same() : tolerance() / 4)) {
                return Foot{x, (a.normal + b.normal).normalized()};
            }
        }
        return std::nullopt;
    }

    // Those between vertices on the input.
    [[nodiscard]] std::vector<Edge> edges() const {
        std::vector<Edge> result;
        for (Index h = 0; h < 3 * mesh_->num_faces(); ++h) {
            const Index a = mesh_->tail(h), b = mesh_->head(h);
            if (!mesh_->face(h / 3).is_there || a > b) continue;
            if (vertices_[a].stays || vertices_[b].stays) continue;
            result.push_back({a, b, {mesh_->apex(h), mesh_->apex(mesh_->twin(h))}});
        }
        return result;
    }

    // \return whether there were any.
    bool split_at_creases() {
        std::vector<Edge> all = edges();
        for (const Edge& edge : all) {
            FitVertex &u = vertices_[edge.from], &v = vertices_[edge.to];
            if (!meet_at_angle(u.foot, v.foot)) continue;
            u.is_sharp = u.is_sharp || is_on_plane(u.foot, v.foot);
            v.is_sharp = v.is_sharp || is_on_plane(v.foot, u.foot);
        }
        for_each(static_cast<Index>(all.size()), [&](Index i) { find_crease(all[i]); });
        move_to_creases(all);
        return split(all);
    }
    bool split_far_edges() {
        std::vector<Edge> all = edges();
        for_each(static_cast<Index>(all.size()), [&](Index i) { find_split(all[i]); });
        return split(all);
    }
    // \return whether there were any.
    bool split(const std::vector<Edge>& all) {
        bool is_split = false;
        for (const Edge& edge : all) {
            if (!edge.split) continue;
            const bool is_made = mesh_.edit([&](SpaceMesh& mesh) {
                mesh.split(mesh.half_edge(edge.from, edge.to), edge.split->foot.point);
            });
            if (is_made) vertices_.push_back(*edge.split);
            is_split = is_split || is_made;
        }
        return is_split;
    }

    [[nodiscard]] bool is_on_plane(const Foot& a, const Foot& plane) const {
        return std::abs(plane.normal.dot(a.point - plane.point)) < same();
    }

    // Between the faces below the ends.
    void find_crease(Edge& edge) const {
        const FitVertex &u = vertices_[edge.from], &v = vertices_[edge.to];
        if (u.is_sharp || v.is_sharp || !meet_at_angle(u.foot, v.foot)) return;
        // Where a straight line over both faces crosses it: points along it keep their order.
        const double above_u = std::abs(u.foot.normal.dot(v.foot.point - u.foot.point));
        const double above_v = std::abs(v.foot.normal.dot(u.foot.point - v.foot.point));
        const Vec3 start = (above_u * u.foot.point + above_v * v.foot.point) / (above_u + above_v);
        if (const auto x = crease_point(u.foot, v.foot, start)) {
            edge.split = FitVertex{middle_outside(edge.from, edge.to), *x, true};
        }
    }

    // The nearer ends of edges across creases.
    void move_to_creases(std::vector<Edge>& all) {
        std::vector<std::pair<double, const Edge*>> nearest(vertices_.size(), {infinity, nullptr});
        for (const Edge& edge : all) {
            if (!edge.split) continue;
            const double reach = snap_share * (at(edge.from) - at(edge.to)).norm();
            for (const Index v : {edge.from, edge.to}) {
                const double distance = (edge.split->foot.point - at(v)).norm();
                if (distance < std::min(reach, nearest[v].first)) nearest[v] = {distance, &edge};
            }
        }
        for (Index v = 0; v < nearest.size(); ++v) {
            if (nearest[v].second == nullptr) continue;
            const Foot& foot = nearest[v].second->split->foot;
            if (!mesh_.move(v, foot.point)) continue;
            vertices_[v].foot = foot;
            vertices_[v].is_sharp = true;
        }
        for (Edge& edge : all) {
            if (vertices_[edge.from].is_sharp || vertices_[edge.to].is_sharp) edge.split.reset();
        }
    }

    // Where a crease bends between its vertices, or a face between others.
    void find_split(Edge& edge) const {
        const FitVertex &u = vertices_[edge.from], &v = vertices_[edge.to];
        const Vec3 outside = middle_outside(edge.from, edge.to);
        const Vec3 middle = (at(edge.from) + at(edge.to)) / 2;
        const double most = (at(edge.from) - at(edge.to)).norm() / 2;
        if (u.is_sharp && v.is_sharp) {
            constexpr double aside = 0.3;
            const auto beside = [&](Index apex) {
                return foot_of(outside + aside * (vertices_[apex].outside - outside));
            };
            const auto x = crease_point(beside(edge.apexes[0]), beside(edge.apexes[1]), middle);
            if (!x) return;
            const double far = distance_to_segment(x->point, at(edge.from), at(edge.to));
            if (far > tolerance() && far < most / 2) edge.split = FitVertex{outside, *x, true};
            return;
        }
        const Foot x = foot_of(outside);
        for (const FitVertex* end : {&u, &v}) {
            if (!end->is_sharp && end->foot.normal.dot(x.normal) < crease_cosine) return;
        }
        const double far = std::abs(x.normal.dot(x.point - middle));
        if (far > tolerance() && (x.point - middle).norm() < most) {
            edge.split = FitVertex{outside, x};
        }
    }

    // Where three faces meet: the nearest vertex goes there, or an edge is split.
    void add_corners() {
        std::vector<Foot> below(mesh_->num_faces());
        for_each(mesh_->num_faces(), [&](Index f) {
            const auto& [a, b, c] = mesh_->face(f).corner;
            below[f] =
                foot_of((vertices_[a].outside + vertices_[b].outside + vertices_[c].outside) / 3);
        });
        std::vector<std::optional<Vec3>> found(mesh_->num_faces());
        for_each(mesh_->num_faces(), [&](Index f) { found[f] = corner_near(f, below); });
        std::vector<Vec3> corners;
        for (Index f = 0; f < found.size(); ++f) {
            if (!found[f]) continue;
            const auto is_here = [&](const Vec3& x) {
                return (x - *found[f]).norm() < tolerance();
            };
            if (std::any_of(corners.begin(), corners.end(), is_here)) continue;
            corners.push_back(*found[f]);
            add_corner(f, *found[f]);
        }
    }
    void add_corner(Index f, const Vec3& x) {
        std::vector<Index> faces;
        for (const Index v : mesh_->face(f).corner) {
            faces.insert(faces.end(), mesh_->faces_at(v).begin(), mesh_->faces_at(v).end());
        }
        Index near = no_index, across = no_index;
        double least = infinity, nearest = infinity;
        for (const Index g : distinct(std::move(faces))) {
            for (Index h = 3 * g; h < 3 * g + 3; ++h) {
                const Index v = mesh_->tail(h);
                if (const double far = (at(v) - x).norm(); far < nearest) nearest = far, near = v;
                const double far = distance_to_segment(x, at(v), at(mesh_->head(h)));
                if (far < least) least = far, across = h;
            }
        }
        if (nearest < same()) return;
        const double length = mesh_->length(across);
        const FitVertex corner{
            middle_outside(mesh_->tail(across), mesh_->head(across)), {x, Vec3::Zero()}, true};
        const auto move_from = [&](double reach) {
            const bool is_moved = nearest < reach && mesh_.move(near, x);
            if (is_moved) vertices_[near] = {vertices_[near].outside, corner.foot, true};
            return is_moved;
        };
        if (move_from(2 * snap_share * length)) return;
        if (mesh_.edit([&](SpaceMesh& mesh) { mesh.split(across, x); })) {
            vertices_.push_back(corner);
        } else {
            move_from(length);
        }
    }

    // Of the faces of the input below those around a face.
    [[nodiscard]] std::optional<Vec3> corner_near(Index f, std::span<const Foot> below) const {
        const Triangle& t = mesh_->face(f).corner;
        const Vec3 middle = (at(t[0]) + at(t[1]) + at(t[2])) / 3;
        std::vector<Index> around;
        double reach = 0;
        for (const Index v : t) {
            if (vertices_[v].stays) return std::nullopt;
            reach = std::max(reach, (at(v) - middle).norm());
            around.insert(around.end(), mesh_->faces_at(v).begin(), mesh_->faces_at(v).end());
        }
        around = distinct(std::move(around));
        // Those that most others are like come first: normals at edges are between those of faces.
        const auto num_like = [&](Index g) {
            return std::count_if(around.begin(), around.end(), [&](Index other) {
                return below[g].normal.dot(below[other].normal) > crease_cosine;
            });
        };
        std::vector<std::pair<std::ptrdiff_t, Index>> order;
        for (const Index g : around) order.emplace_back(-num_like(g), g);
        std::sort(order.begin(), order.end());
        std::vector<Foot> planes;
        for (const auto& [count, g] : order) {
            const auto is_like = [&, g = g](const Foot& plane) {
                return plane.normal.dot(below[g].normal) > corner_cosine;
            };
            if (std::none_of(planes.begin(), planes.end(), is_like)) planes.push_back(below[g]);
        }
        constexpr double least_volume = 0.2;  // Between the normals.
        double best = least_volume;
        Vec3 x = Vec3::Constant(infinity);
        for (std::size_t i = 0; i < planes.size(); ++i) {
            for (std::size_t j = i + 1; j < planes.size(); ++j) {
                for (std::size_t k = j + 1; k < planes.size(); ++k) {
                    const Foot &a = planes[i], &b = planes[j], &c = planes[k];
                    const Vec3 ab = a.normal.cross(b.normal);
                    const double volume = ab.dot(c.normal);
                    if (std::abs(volume) < best) continue;
                    best = std::abs(volume);
                    x = (a.normal.dot(a.point) * b.normal.cross(c.normal) +
                         b.normal.dot(b.point) * c.normal.cross(a.normal) +
                         c.normal.dot(c.point) * ab) /
                        volume;
                }
            }
        }
        if (!((x - middle).norm() < 2 * reach) || !tree_.is_within(x, tolerance() / 4)) {
            return std::nullopt;
        }
        return x;
    }

    // The length of an edge times the angle by which the surface turns there: their sum is least
    // where edges follow the creases ([dyn2001]). A face without area turns most.
    [[nodiscard]] double turn(const Triangle& left, const Triangle& right, Index a, Index b) const {
        const Vec3 m = doubled_normal(mesh_->positions(), left),
                   n = doubled_normal(mesh_->positions(), right);
        const double sine = m.cross(n).norm(), cosine = m.dot(n);
        const bool has_area = m.squaredNorm() > 0 && n.squaredNorm() > 0;
        return (at(a) - at(b)).norm() *
               (has_area ? portable::atan2(sine, cosine) : std::numbers::pi);
    }
    void straighten() {
        constexpr int most_passes = 10;
        constexpr double least_gain = 0.01;  // Times the tolerance.
        // Vertices near which an edge was flipped in the last pass: gains are others there.
        std::vector<std::uint8_t> is_new(mesh_->num_vertices(), 1), is_next;
        bool is_changed = true;
        for (int pass = 0; pass < most_passes && std::exchange(is_changed, false); ++pass) {
            is_next.assign(mesh_->num_vertices(), 0);
            for (Index h = 0; h < 3 * mesh_->num_faces(); ++h) {
                const Index a = mesh_->tail(h), b = mesh_->head(h);
                if (!mesh_->face(h / 3).is_there || a > b) continue;
                const Index twin = mesh_->half_edge(b, a);
                const std::array quad{a, b, mesh_->apex(h), mesh_->apex(twin)};
                const auto is_awake = [&](Index v) { return is_new[v] != 0 || is_next[v] != 0; };
                if (std::ranges::none_of(quad, is_awake)) continue;
                if (gain_of_flip(h) > least_gain * tolerance() &&
                    mesh_.edit([&](SpaceMesh& mesh) { mesh.flip(h); })) {
                    for (const Index v : quad) is_next[v] = 1;
                    is_changed = true;
                }
            }
            is_new.swap(is_next);
        }
    }
    [[nodiscard]] double gain_of_flip(Index h) const {
        if (!mesh_->can_flip(h)) return 0;
        const Index twin = mesh_->twin(h), a = mesh_->tail(h), b = mesh_->head(h),
                    c = mesh_->apex(h), d = mesh_->apex(twin);
        const Triangle left{a, b, c}, right{b, a, d}, lower{c, a, d}, upper{d, b, c};
        const auto beyond = [&](Index from, Index to) {
            return mesh_->face(mesh_->half_edge(to, from) / 3).corner;
        };
        const Triangle bc = beyond(b, c), ca = beyond(c, a), ad = beyond(a, d), db = beyond(d, b);
        return turn(left, right, a, b) + turn(left, bc, b, c) + turn(left, ca, c, a) +
               turn(right, ad, a, d) + turn(right, db, d, b) - turn(lower, upper, c, d) -
               turn(upper, bc, b, c) - turn(lower, ca, c, a) - turn(lower, ad, a, d) -
               turn(upper, db, d, b);
    }

    // Edges without a length, at corners.
    void collapse_short_edges() {
        const double least = tolerance() / 10;
        for (Index h = 0; h < 3 * mesh_->num_faces(); ++h) {
            if (!mesh_->face(h / 3).is_there || mesh_->length(h) > least) continue;
            const Index a = mesh_->tail(h), b = mesh_->head(h);
            if (!collapse(a, b)) collapse(b, a);
        }
    }
    bool collapse(Index gone, Index into) {
        return mesh_->can_collapse(gone, into) &&
               mesh_.edit([&](SpaceMesh& mesh) { mesh.collapse(gone, into); });
    }

    // Vertices of faces that touch, or intersect by rounding: a little towards the outside, then
    // more.
    // \return whether there are none any more.
    bool move_apart() {
        // The last time nothing moves.
        for (const double share : {1e-6, 1e-4, 0.01, 0.1, 0.5, 0.0}) {
            const TriangleMesh mesh = triangles();
            const auto pairs =
                find_self_intersections(mesh, options_.num_threads, options_.progress);
            if (!pairs || pairs->empty()) return true;
            std::vector<Index> crossing;
            for (const auto& [f, g] : *pairs) {
                for (const Index face : {f, g}) {
                    const Triangle& t = mesh.triangles[face];
                    if (!collapse_shortest(t)) crossing.insert(crossing.end(), t.begin(), t.end());
                }
            }
            for (const Index v : distinct(std::move(crossing))) {
                mesh_.move(v, at(v) + share * (vertices_[v].outside - at(v)));
            }
        }
        return false;
    }

    // If that edge is shorter than what counts as far.
    bool collapse_shortest(const Triangle& t) {
        std::size_t k = 0;
        const auto length = [&](std::size_t i) { return (at(t[i]) - at(t[(i + 1) % 3])).norm(); };
        for (std::size_t i = 1; i < 3; ++i) {
            if (length(i) < length(k)) k = i;
        }
        const Index a = t[k], b = t[(k + 1) % 3];
        return length(k) < tolerance() && (collapse(a, b) || collapse(b, a));
    }

    [[nodiscard]] TriangleMesh triangles() const {
        return {mesh_->positions(), mesh_->triangles()};
    }

    [[nodiscard]] FittedWrap result() const {
        FittedWrap fitted{triangles(), {}, 0};
        std::vector<Triangle>& triangles = fitted.mesh.triangles;
        double all = 0;
        for (const Triangle& t : triangles) {
            const double area = doubled_normal(fitted.mesh.positions, t).norm();
            all += area;
            const bool stays =
                std::any_of(t.begin(), t.end(), [&](Index v) { return vertices_[v].stays; });
            if (stays) fitted.sheets += area;
        }
        fitted.sheets /= all;
        const std::vector<Index> used = drop_unused(mesh_->num_vertices(), triangles);
        fitted.mesh.positions = take(fitted.mesh.positions, used);
        for (const Index v : used) fitted.outside.push_back(vertices_[v].outside);
        return fitted;
    }

    FitWrapOptions options_;
    const TriangleMesh& wrap_;
    const ClosestPointTree& tree_;
    GuardedMesh mesh_;
    std::vector<FitVertex> vertices_;
};

}  // namespace

FittedWrap fit_wrap(const TriangleMesh& wrap, const ClosestPointTree& tree,
                    const FitWrapOptions& options) {
    for (const bool has_creases : {true, false}) {
        if (auto fitted = WrapFitter(wrap, tree, options).run(has_creases)) return *fitted;
    }
    return {wrap, wrap.positions, 1};
}

}  // namespace remesh::detail
