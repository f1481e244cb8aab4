// Faces, vertices and fans go to a journal before they change, so that edits can be undone in
// reverse order. Each edit first checks that the topology stays (for a collapse by the link
// condition, [dey1999]), that normals and dihedral angles change little, and that hard edges stay
// near the boundary of the surface.
#include "remesh/placement/edited_mesh.h"

#include <algorithm>

#include "remesh/placement/shape_quality.h"
#include "remesh/sites/walk.h"

namespace remesh::detail {

namespace {

// Cosine of the largest turn of a normal, and of the angle up to which every edge may be sharp.
constexpr double gentle_turn = 0.5;
// Share of the edge's length: a new vertex farther from the middle lies on another part of the
// surface.
constexpr double largest_miss = 0.35;
// Largest distance between a hard edge and the boundary that it stands for, unless it was larger
// before: as a share of the edge's length, and of the mean edge length. With the first alone edges
// reach around the tips of slots.
constexpr double largest_bend = 0.25, most_bend = 0.15;
// Most boundary edges of the surface that are compared with one hard edge.
constexpr int most_passed = 10000;

bool is_gentle(const Vec3& before, const Vec3& after) {
    return after.dot(before) > gentle_turn * after.norm() * before.norm();
}

}  // namespace

EditedMesh::EditedMesh(const Surface& surface, const PlacedMesh& mesh,
                       std::span<const Mobility> mobility, std::span<const DirectedEdge> hard)
    : surface_(surface),
      faces_(mesh.triangles.size()),
      vertices_(mesh.points.size()),
      fans_(mesh.points.size()) {
    for (Index v = 0; v < vertices_.size(); ++v) {
        vertices_[v] = {mesh.points[v], mesh.offsets[v], Vec3::Zero(), Vec3::Zero(), mobility[v]};
        locate(vertices_[v]);
    }
    for (const Triangle& t : mesh.triangles) {
        for (Index k = 0; k < 3; ++k) mean_length_ += (at(t[k]) - at(t[(k + 1) % 3])).norm();
    }
    mean_length_ /= 3 * static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
    std::vector<DirectedEdge> edges(hard.begin(), hard.end());
    for (const auto& [from, to] : hard) edges.emplace_back(to, from);
    std::sort(edges.begin(), edges.end());
    for (Index f = 0; f < faces_.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        faces_[f] = {t, {}, true, quality_of(t)};
        for (Index k = 0; k < 3; ++k) {
            fans_[t[k]].push_back(f);
            faces_[f].is_hard[k] =
                std::binary_search(edges.begin(), edges.end(), DirectedEdge(t[k], t[(k + 1) % 3]));
        }
    }
}

void EditedMesh::locate(Vertex& vertex) const {
    const auto& p = surface_.mesh.positions;
    const Triangle& t = surface_.mesh.triangles[vertex.point.face.value()];
    vertex.facing = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
    vertex.at = position(surface_.mesh.view(), vertex.point) + vertex.offset;
}

Vec3 EditedMesh::normal_of(const Triangle& t) const {
    return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
}

double EditedMesh::quality_of(const Triangle& t) const {
    const auto& [a, b, c] = t;
    const Vec3 facing = vertices_[a].facing + vertices_[b].facing + vertices_[c].facing;
    const bool is_turned = !(normal_of(t).dot(facing) > 0);
    return shape_quality(at(a), at(b), at(c)) - (is_turned ? 1 : 0);
}

double EditedMesh::worst_at(Index v) const {
    double worst = 1;
    for (const Index f : fans_[v]) worst = std::min(worst, faces_[f].quality);
    return worst;
}

void EditedMesh::put_face(Index f, const Triangle& corner, const std::array<bool, 3>& is_hard) {
    old_faces_.emplace_back(f, faces_[f]);
    faces_[f] = {corner, is_hard, true, quality_of(corner)};
}

void EditedMesh::drop_face(Index f) {
    old_faces_.emplace_back(f, faces_[f]);
    faces_[f].is_there = false;
}

void EditedMesh::put_vertex(Index v, const Vertex& vertex) {
    old_vertices_.emplace_back(v, vertices_[v]);
    vertices_[v] = vertex;
}

void EditedMesh::measure_around(Index v) {
    for (const Index f : fans_[v]) put_face(f, faces_[f].corner, faces_[f].is_hard);
}

bool EditedMesh::has_corner(Index f, Index v) const {
    const Triangle& t = faces_[f].corner;
    return t[0] == v || t[1] == v || t[2] == v;
}

std::optional<EditedMesh::Half> EditedMesh::half_edge(Index from, Index to) const {
    for (const Index f : fans_[from]) {
        const Triangle& t = faces_[f].corner;
        for (Index k = 0; k < 3; ++k) {
            if (t[k] == from && t[(k + 1) % 3] == to) return Half{f, k};
        }
    }
    return std::nullopt;
}

bool EditedMesh::are_joined(Index a, Index b) const {
    return std::any_of(fans_[a].begin(), fans_[a].end(), [&](Index f) { return has_corner(f, b); });
}

std::array<Index, 2> EditedMesh::hard_neighbours(Index v) const {
    std::array<Index, 2> found{no_index, no_index};
    for (const Index f : fans_[v]) {
        const Face& face = faces_[f];
        for (Index k = 0; k < 3; ++k) {
            if (!face.is_hard[k]) continue;
            if (face.corner[k] == v) found[1] = face.corner[(k + 1) % 3];
            if (face.corner[(k + 1) % 3] == v) found[0] = face.corner[k];
        }
    }
    return found;
}

EditedMesh::Mark EditedMesh::mark() const {
    return {old_faces_.size(), old_vertices_.size(), old_fans_.size(), num_faces(), num_vertices()};
}

void EditedMesh::take_back(const Mark& mark) {
    const auto restore = [](auto& journal, std::size_t size, auto& values) {
        while (journal.size() > size) {
            values[journal.back().first] = std::move(journal.back().second);
            journal.pop_back();
        }
    };
    restore(old_faces_, mark.faces, faces_);
    restore(old_vertices_, mark.vertices, vertices_);
    restore(old_fans_, mark.fans, fans_);
    faces_.resize(mark.num_faces);
    vertices_.resize(mark.num_vertices);
    fans_.resize(mark.num_vertices);
}

void EditedMesh::changed_since(const Mark& mark, std::vector<Index>& now,
                               std::vector<double>& before) const {
    now.clear();
    before.clear();
    std::vector<std::pair<Index, std::size_t>> first;
    for (std::size_t i = mark.faces; i < old_faces_.size(); ++i) {
        first.emplace_back(old_faces_[i].first, i);
    }
    std::sort(first.begin(), first.end());
    for (std::size_t i = 0; i < first.size(); ++i) {
        if (i > 0 && first[i].first == first[i - 1].first) continue;
        const Face& old = old_faces_[first[i].second].second;
        if (old.is_there) before.push_back(old.quality);
        if (faces_[first[i].first].is_there) now.push_back(first[i].first);
    }
}

PlacedMesh EditedMesh::result(std::vector<Index>& numbers) const {
    PlacedMesh mesh;
    numbers.clear();
    std::vector<Index> number(vertices_.size(), no_index);
    for (Index v = 0; v < vertices_.size(); ++v) {
        if (fans_[v].empty()) continue;
        number[v] = static_cast<Index>(mesh.points.size());
        numbers.push_back(v);
        mesh.points.push_back(vertices_[v].point);
        mesh.offsets.push_back(vertices_[v].offset);
    }
    for (const Face& f : faces_) {
        if (!f.is_there) continue;
        mesh.triangles.push_back({number[f.corner[0]], number[f.corner[1]], number[f.corner[2]]});
    }
    return mesh;
}

// Whether a flip would make an edge sharper than gentle_turn and than all edges of the quad were.
bool EditedMesh::folds(const std::array<Index, 4>& quad, Half first, Half second) const {
    const auto [a, b, c, d] = quad;
    const auto unit = [&](const Triangle& t) -> Vec3 { return normal_of(t).normalized(); };
    const Vec3 old_first = unit({a, b, c}), old_second = unit({b, a, d});
    const Vec3 new_first = unit({c, a, d}), new_second = unit({d, b, c});
    if (new_first.isZero() || new_second.isZero()) return true;
    double before = old_first.dot(old_second), after = new_first.dot(new_second);
    const auto compare = [&](Half side, Index k, const Vec3& old_normal, const Vec3& new_normal) {
        if (faces_[side.face].is_hard[k % 3]) return;
        const Triangle& t = faces_[side.face].corner;
        const std::optional<Half> across = half_edge(t[(k + 1) % 3], t[k % 3]);
        if (!across) return;
        const Vec3 beyond = unit(faces_[across->face].corner);
        before = std::min(before, beyond.dot(old_normal));
        after = std::min(after, beyond.dot(new_normal));
    };
    compare(first, first.k + 1, old_first, new_second);
    compare(first, first.k + 2, old_first, new_first);
    compare(second, second.k + 1, old_second, new_first);
    compare(second, second.k + 2, old_second, new_second);
    return !(after >= std::min(before, gentle_turn));
}

bool EditedMesh::flip(Index face, Index k) {
    const Half first{face, k};
    const Triangle t = faces_[face].corner;
    if (faces_[face].is_hard[k]) return false;
    const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    const std::optional<Half> second = half_edge(b, a);
    if (!second) return false;
    const Face f = faces_[face], g = faces_[second->face];
    const Index d = g.corner[(second->k + 2) % 3];
    if (c == d || are_joined(c, d)) return false;
    for (const Index v : {a, b}) {
        if (mobility(v) == Mobility::Free ? fans_[v].size() <= 3 : fans_[v].size() <= 2) {
            return false;
        }
    }
    if (folds({a, b, c, d}, first, *second)) return false;
    for (const Index v : {a, b, c, d}) log_fan(v);
    std::erase(fans_[b], face);
    std::erase(fans_[a], second->face);
    fans_[d].push_back(face);
    fans_[c].push_back(second->face);
    const auto hard_of = [](const Face& old, Index side) { return old.is_hard[side % 3]; };
    put_face(face, {c, a, d}, {hard_of(f, k + 2), hard_of(g, second->k + 1), false});
    put_face(second->face, {d, b, c}, {hard_of(g, second->k + 2), hard_of(f, k + 1), false});
    return true;
}

// Finds a point of the surface near the middle. False if walks from both ends miss it.
bool EditedMesh::find_between(Index a, Index b, bool is_hard, Vertex& vertex) const {
    vertex.mobility = is_hard ? Mobility::Boundary : Mobility::Free;
    vertex.offset = (vertices_[a].offset + vertices_[b].offset) / 2;
    const Vec3 middle = (at(a) + at(b)) / 2;
    const double most = largest_miss * (at(b) - at(a)).norm();
    const Mobility best = is_hard ? Mobility::Boundary : Mobility::Free;
    const bool takes_other = mobility(a) != best && mobility(b) == best;
    for (const Index from : {takes_other ? b : a, takes_other ? a : b}) {
        const SurfacePoint& point = vertices_[from].point;
        const Vec3 step = middle - vertex.offset - position(surface_.mesh.view(), point);
        if (is_hard) {
            const std::optional<Index> h = boundary_half_edge(surface_, point);
            if (!h) continue;
            vertex.point = walk_boundary(surface_, point, *h, step);
        } else {
            vertex.point = walk_straight(surface_, point, step).end;
        }
        locate(vertex);
        if ((vertex.at - middle).norm() <= most) return true;
    }
    return false;
}

void EditedMesh::split_side(Half side, Index vertex) {
    const Face old = faces_[side.face];
    const Index a = old.corner[side.k], b = old.corner[(side.k + 1) % 3],
                c = old.corner[(side.k + 2) % 3];
    const bool ab = old.is_hard[side.k], bc = old.is_hard[(side.k + 1) % 3],
               ca = old.is_hard[(side.k + 2) % 3];
    const Index added = num_faces();
    faces_.emplace_back();
    faces_.back().corner = {vertex, b, c};
    log_fan(b);
    log_fan(c);
    std::replace(fans_[b].begin(), fans_[b].end(), side.face, added);
    fans_[c].push_back(added);
    fans_[vertex].push_back(side.face);
    fans_[vertex].push_back(added);
    put_face(side.face, {a, vertex, c}, {ab, false, ca});
    put_face(added, {vertex, b, c}, {ab, bc, false});
}

Index EditedMesh::split(Index face, Index k) {
    const Triangle t = faces_[face].corner;
    const Index a = t[k], b = t[(k + 1) % 3];
    if (mobility(a) == Mobility::Fixed && mobility(b) == Mobility::Fixed) return no_index;
    Vertex vertex;
    if (!find_between(a, b, faces_[face].is_hard[k], vertex)) return no_index;
    const std::optional<Half> other = half_edge(b, a);
    const auto keeps_normal = [&](Half side) {
        const Triangle& corner = faces_[side.face].corner;
        const Vec3 &p = at(corner[side.k]), &q = at(corner[(side.k + 1) % 3]),
                   &r = at(corner[(side.k + 2) % 3]);
        const Vec3 before = (q - p).cross(r - p);
        return is_gentle(before, (vertex.at - p).cross(r - p)) &&
               is_gentle(before, (q - vertex.at).cross(r - vertex.at));
    };
    if (!keeps_normal({face, k}) || (other && !keeps_normal(*other))) return no_index;
    const Index added = num_vertices();
    vertices_.push_back(vertex);
    fans_.emplace_back();
    split_side({face, k}, added);
    if (other) split_side(*other, added);
    return added;
}

// The largest distance of the surface's boundary between two vertices from the edge.
double EditedMesh::bend(Index from, Index to) const {
    const std::optional<Index> first = boundary_half_edge(surface_, vertices_[from].point),
                               last = boundary_half_edge(surface_, vertices_[to].point);
    if (!first || !last) return 0;
    const Vec3 way = at(to) - at(from);
    const double square = way.squaredNorm();
    double most = 0;
    int passed = 0;
    for (Index h = *first; h != *last && passed < most_passed; ++passed) {
        const Index v = surface_.head(h);
        const Vec3 offset = surface_.mesh.positions[v] - at(from);
        const double along = square > 0 ? std::clamp(offset.dot(way) / square, 0.0, 1.0) : 0;
        most = std::max(most, (offset - along * way).norm());
        h = surface_.outgoing[v];
    }
    return most;
}

double EditedMesh::largest_bend_at(Index v) const {
    const auto [before, after] = hard_neighbours(v);
    if (before == no_index || after == no_index) return 0;
    return std::max(bend(before, v), bend(v, after));
}

bool EditedMesh::keeps_bend(Index from, Index to, double most_before) const {
    const double length = (at(to) - at(from)).norm();
    return bend(from, to) <=
           std::max(most_before, std::min(largest_bend * length, most_bend * mean_length_));
}

bool EditedMesh::may_collapse(Index gone, Index into) const {
    if (mobility(gone) == Mobility::Fixed) return false;
    std::array<Index, 2> apex{no_index, no_index};
    std::size_t num_apexes = 0;
    bool is_along = false;
    Index hard_neighbour = no_index;  // The one that is not `into`.
    std::vector<Index> ring;
    for (const Index f : fans_[gone]) {
        const Triangle& t = faces_[f].corner;
        for (Index k = 0; k < 3; ++k) {
            const Index v = t[k], w = t[(k + 1) % 3];
            if (v != gone) ring.push_back(v);
            if (v == gone || w == gone) {
                const Index other = v == gone ? w : v;
                if (!faces_[f].is_hard[k]) continue;
                if (other == into) is_along = true;
                if (other != into) hard_neighbour = other;
            }
        }
        if (!has_corner(f, into)) continue;
        for (const Index w : t) {
            if (w != gone && w != into) apex[num_apexes++] = w;
        }
    }
    if (num_apexes == 0) return false;
    if (mobility(gone) == Mobility::Boundary) {
        if (!is_along || hard_neighbour == no_index) return false;
        if (hard_neighbour == apex[0] || hard_neighbour == apex[1]) return false;
        const bool is_next = hard_neighbours(gone)[1] == into;
        if (!keeps_bend(is_next ? hard_neighbour : into, is_next ? into : hard_neighbour,
                        largest_bend_at(gone))) {
            return false;
        }
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    const auto num_common = static_cast<std::size_t>(std::count_if(
        ring.begin(), ring.end(), [&](Index w) { return w != into && are_joined(into, w); }));
    if (num_common != num_apexes) return false;
    const auto has_face = [&](Index v) {
        return std::any_of(fans_[v].begin(), fans_[v].end(), [&](Index f) {
            return has_corner(f, apex[0]) && has_corner(f, apex[1]);
        });
    };
    if (num_apexes == 2 && has_face(gone) && has_face(into)) return false;
    for (Index i = 0; i < num_apexes; ++i) {
        // An inner vertex keeps three faces.
        if (mobility(apex[i]) == Mobility::Free && fans_[apex[i]].size() <= 3) return false;
    }
    return std::all_of(fans_[gone].begin(), fans_[gone].end(), [&](Index f) {
        if (has_corner(f, into)) return true;
        Triangle moved = faces_[f].corner;
        std::replace(moved.begin(), moved.end(), gone, into);
        return is_gentle(normal_of(faces_[f].corner), normal_of(moved));
    });
}

bool EditedMesh::collapse(Index gone, Index into) {
    if (!may_collapse(gone, into)) return false;
    const std::vector<Index> fan = fans_[gone];
    // Two sides of a removed face become one edge: hard if the side at `into` is.
    std::vector<DirectedEdge> hard;
    for (const Index f : fan) {
        if (!has_corner(f, into)) continue;
        const Triangle& t = faces_[f].corner;
        for (Index k = 0; k < 3; ++k) {
            if (t[k] == gone || t[(k + 1) % 3] == gone || !faces_[f].is_hard[k]) continue;
            hard.emplace_back(t[k], t[(k + 1) % 3]);
        }
    }
    log_fan(gone);
    log_fan(into);
    fans_[gone].clear();
    for (const Index f : fan) {
        const Face old = faces_[f];
        if (!has_corner(f, into)) {
            Triangle moved = old.corner;
            std::replace(moved.begin(), moved.end(), gone, into);
            fans_[into].push_back(f);
            put_face(f, moved, old.is_hard);
            continue;
        }
        drop_face(f);
        for (const Index w : old.corner) {
            if (w == gone) continue;
            if (w != into) log_fan(w);
            std::erase(fans_[w], f);
        }
    }
    for (const auto& [from, to] : hard) {
        // The face beyond the removed one now has this edge, in the same direction.
        const std::optional<Half> side = half_edge(from, to);
        if (!side) continue;
        Face face = faces_[side->face];
        face.is_hard[side->k] = true;
        put_face(side->face, face.corner, face.is_hard);
    }
    return true;
}

bool EditedMesh::move(Index v, const Vec3& step, double gain) {
    Vertex vertex = vertices_[v];
    if (vertex.mobility == Mobility::Fixed) return false;
    if (vertex.mobility == Mobility::Boundary) {
        const std::optional<Index> h = boundary_half_edge(surface_, vertex.point);
        if (!h) return false;
        vertex.point = walk_boundary(surface_, vertex.point, *h, step);
    } else {
        const Walk walk = walk_straight(surface_, vertex.point, step);
        num_crossings_ += static_cast<std::size_t>(walk.num_crossings);
        if (walk.is_cut_off) return false;
        vertex.point = walk.end;
    }
    locate(vertex);
    const double worst = worst_at(v);
    const Vertex before = vertices_[v];
    std::vector<Vec3> normals;
    for (const Index f : fans_[v]) normals.push_back(normal_of(faces_[f].corner));
    vertices_[v] = vertex;
    bool is_better = true;
    for (std::size_t i = 0; i < normals.size() && is_better; ++i) {
        const Triangle& t = faces_[fans_[v][i]].corner;
        is_better = quality_of(t) > worst + gain && is_gentle(normals[i], normal_of(t));
    }
    if (is_better && vertex.mobility == Mobility::Boundary) {
        vertices_[v] = before;
        const double bend_before = largest_bend_at(v);
        vertices_[v] = vertex;
        const auto [previous, next] = hard_neighbours(v);
        is_better = (previous == no_index || keeps_bend(previous, v, bend_before)) &&
                    (next == no_index || keeps_bend(v, next, bend_before));
    }
    vertices_[v] = before;
    if (!is_better) return false;
    put_vertex(v, vertex);
    measure_around(v);
    return true;
}

}  // namespace remesh::detail
