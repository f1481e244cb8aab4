//! \file
//! A mesh on a surface, edited by flips, splits, collapses and moves that can be undone.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/glue.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/fan_mesh.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/placement/placement.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

//! Every edit keeps the topology, and chains of hard edges stay chains of hard edges. No normal
//! turns by more than 60 degrees, and no edge becomes sharper than both 60 degrees and the edges
//! around it were. Edits that would break these rules change nothing.
//!
//! The label of an edge is its curve; no_index: it lies on none. The quality of a face is its
//! shape_quality(), or how it keeps bounds (ShapeMeasure); 1 less if the face points against the
//! surface.
class EditedMesh : private FanMesh {
public:
    using FanMesh::changed_since, FanMesh::face, FanMesh::Face, FanMesh::faces_at,
        FanMesh::has_corner, FanMesh::is_on_rim, FanMesh::num_faces, FanMesh::num_vertices;

    //! A state to which edits can be undone.
    struct Mark : FanMesh::Mark {
        std::size_t vertices = 0;  // Size of the journal.
    };

    //! \param curves    outlives this.
    //! \param mobility  #V. Free ones lie on no curve.
    EditedMesh(const MeshCurves& curves, const PlacedMesh& mesh, std::span<const Mobility> mobility,
               const ShapeMeasure& shape = ShapeMeasure())
        : FanMesh(mesh.triangles, static_cast<Index>(mesh.points.size())),
          curves_(curves),
          surface_(curves.surface()),
          shape_(shape),
          vertices_(mesh.points.size()) {
        for (Index v = 0; v < vertices_.size(); ++v) {
            vertices_[v].point = mesh.points[v];
            vertices_[v].offset = mesh.offsets[v];
            vertices_[v].mobility = mobility[v];
            if (mobility[v] != Mobility::Free) {
                vertices_[v].place = curves.place_of(mesh.points[v]);
            }
            if (is_on_rim(v) && mobility[v] == Mobility::Node) {
                vertices_[v].mobility = Mobility::Fixed;
            }
            locate(vertices_[v]);
        }
        for (Index h = 0; h < 3 * num_faces(); ++h)
            mean_length_ += (at(tail(h)) - at(head(h))).norm();
        mean_length_ /= 3 * static_cast<double>(std::max<std::size_t>(mesh.triangles.size(), 1));
        label_edges(mesh.hard, [&](Index a, Index b) {
            const Index curve = curves.curve_between(vertices_[a].place, vertices_[b].place);
            return curve == no_index ? unknown_curve : curve;
        });
        for (Index f = 0; f < num_faces(); ++f) measure(f);
        forget();
    }

    [[nodiscard]] const Vec3& at(Index v) const { return vertices_[v].at; }
    [[nodiscard]] FaceId face_of_surface(Index v) const { return vertices_[v].point.face; }
    [[nodiscard]] std::array<Vec3, 3> corners_of(Index f) const {
        const auto& [a, b, c] = face(f).corner;
        return {at(a), at(b), at(c)};
    }
    //! Twice its area long.
    [[nodiscard]] Vec3 normal_of(Index f) const { return normal_of(face(f).corner); }
    [[nodiscard]] MeshBox box_of(Index f) const {
        MeshBox box;
        for (const Vec3& at : corners_of(f)) box.add(at);
        return box;
    }
    //! Those that are there, ascending.
    [[nodiscard]] std::vector<Index> faces() const {
        std::vector<Index> result;
        for (Index f = 0; f < num_faces(); ++f) {
            if (face(f).is_there) result.push_back(f);
        }
        return result;
    }
    //! The quality of a face, whatever side it points to.
    [[nodiscard]] double shape_of(Index f) const {
        const double quality = face(f).quality;
        return quality < 0 ? quality + 1 : quality;
    }
    //! Of a triangle that points along the surface.
    [[nodiscard]] double quality_of_shape(const std::array<Vec3, 3>& corners) const {
        return shape_(corners[0], corners[1], corners[2]);
    }
    [[nodiscard]] bool has_bounds() const { return shape_.has_bounds(); }
    [[nodiscard]] Mobility mobility(Index v) const { return vertices_[v].mobility; }
    [[nodiscard]] double worst_at(Index v) const {
        double worst = 1;
        for (const Index f : faces_at(v)) worst = std::min(worst, face(f).quality);
        return worst;
    }
    //! The two neighbours of a vertex on a curve; no_index: there are fewer.
    [[nodiscard]] std::array<Index, 2> hard_neighbours(Index v) const {
        std::array<Index, 2> found{no_index, no_index};
        for (const Index f : faces_at(v)) {
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (!is_hard(h) || (tail(h) != v && head(h) != v)) continue;
                const Index w = tail(h) == v ? head(h) : tail(h);
                if (w == found[0]) continue;
                found[found[0] == no_index ? 0 : 1] = w;
            }
        }
        return found;
    }

    //! Flips the edge from corner k of the face to the next.
    bool flip(Index face, Index k) {
        const Index h = 3 * face + k;
        if (is_hard(h) || !can_flip(h)) return false;
        for (const Index v : {tail(h), head(h)}) {
            if (is_on_rim(v) && faces_at(v).size() == 2) return false;
        }
        if (flip_folds(
                *this, h, [&](Index v) { return at(v); },
                [&](Index side, Index twin) { return !is_hard(side) && !is_sliver(twin / 3); })) {
            return false;
        }
        const Index other = twin(h) / 3;
        FanMesh::flip(h);
        measure(face);
        measure(other);
        return true;
    }
    //! Splits the edge from corner k of the face to the next.
    //! \param share  of the edge before the new vertex; brought into [0.2, 0.8].
    //! \return the new vertex; no_index if the edge cannot be split.
    Index split(Index face, Index k, double share = 0.5) {
        const Index h = 3 * face + k, a = tail(h), b = head(h);
        if (mobility(a) == Mobility::Fixed && mobility(b) == Mobility::Fixed) return no_index;
        Vertex vertex;
        if (!find_between(a, b, std::clamp(share, 0.2, 0.8), label(h), vertex)) return no_index;
        const Index other = twin(h);
        const auto keeps_normal = [&](Index side) {
            const Vec3 &p = at(tail(side)), &q = at(head(side)), &r = at(apex(side));
            const Vec3 before = (q - p).cross(r - p);
            return is_gentle(side / 3, before, (vertex.at - p).cross(r - p)) &&
                   is_gentle(side / 3, before, (q - vertex.at).cross(r - vertex.at));
        };
        if (!keeps_normal(h) || (other != no_index && !keeps_normal(other))) return no_index;
        vertices_.push_back(vertex);
        const Index added = FanMesh::split(h);
        measure_around(added);
        return added;
    }
    //! Collapses the edge between two vertices: removes `gone`; `into` stays in place.
    bool collapse(Index gone, Index into) {
        if (!may_collapse(gone, into)) return false;
        if (mobility(gone) == Mobility::Node) detach_curves(gone, into);
        const std::vector<Index> around(faces_at(gone).begin(), faces_at(gone).end());
        FanMesh::collapse(gone, into);
        for (const Index f : around) {
            if (face(f).is_there) measure(f);
        }
        return true;
    }
    //! Moves a vertex along the surface if the worst face around it gets better by more than
    //! `gain`. Does not if its walk is cut off.
    bool move(Index v, const Vec3& step, double gain) {
        Vertex vertex = vertices_[v];
        if (vertex.mobility >= Mobility::Node) return false;
        const Index worst_face = worst_face_at(v);
        const double worst = face(worst_face).quality;
        // Most steps do not even help in the plane, without a walk, and not the worst face.
        if (!is_better(worst_face, v, vertex.at + step, worst + gain) ||
            !all_better(v, vertex.at + step, worst + gain)) {
            return false;
        }
        if (vertex.mobility == Mobility::Boundary) {
            if (vertex.place.curve == no_index) return false;
            const std::optional<CurvePlace> place = curves_.moved(vertex.place, step);
            if (!place) return false;
            vertex.place = *place;
            vertex.point = curves_.point(place->curve, place->along);
        } else {
            const Walk walk = walk_straight(surface_, vertex.point, step);
            num_crossings_ += static_cast<std::size_t>(walk.num_crossings);
            if (walk.is_cut_off) return false;
            vertex.point = walk.end;
        }
        const bool is_on_curve = vertex.mobility == Mobility::Boundary;
        const double bend_before = is_on_curve ? largest_bend_at(v) : 0;
        return replace(v, vertex, [&] {
            return std::all_of(
                       faces_at(v).begin(), faces_at(v).end(),
                       [&](Index f) { return quality_of(face(f).corner) > worst + gain; }) &&
                   (!is_on_curve || keeps_bend_at(v, bend_before));
        });
    }
    //! Puts a vertex off its point of the surface. Its triangles may get worse.
    bool put_offset(Index v, const Vec3& offset) {
        if (mobility(v) >= Mobility::Node) return false;
        Vertex vertex = vertices_[v];
        vertex.offset = offset;
        return replace(v, vertex, [] { return true; });
    }
    //! The way from a vertex's point of the surface to its position.
    [[nodiscard]] const Vec3& offset(Index v) const { return vertices_[v].offset; }
    //! Edges of the surface that all calls of `move` together crossed: their cost.
    [[nodiscard]] std::size_t num_crossings() const { return num_crossings_; }

    //! Of the initial edges.
    [[nodiscard]] double mean_length() const { return mean_length_; }

    [[nodiscard]] Mark mark() const { return {FanMesh::mark(), old_vertices_.size()}; }
    void take_back(const Mark& mark) {
        undo(old_vertices_, mark.vertices, vertices_);
        FanMesh::take_back(mark);
        vertices_.resize(mark.num_vertices);
    }

    //! The mesh without removed faces and vertices. Its hard edges come once for each side.
    //! \param[out] numbers  by vertex of the result: its number here.
    [[nodiscard]] PlacedMesh result(std::vector<Index>& numbers) const {
        PlacedMesh mesh{{}, {}, triangles()};
        numbers = drop_unused(num_vertices(), mesh.triangles);
        for (const Index v : numbers) {
            mesh.points.push_back(vertices_[v].point);
            mesh.offsets.push_back(vertices_[v].offset);
        }
        for (Index h = 0; h < 3 * num_faces(); ++h) {
            if (!face(h / 3).is_there || !is_hard(h)) continue;
            mesh.hard.emplace_back(rank_of(numbers, tail(h)), rank_of(numbers, head(h)));
        }
        return mesh;
    }

private:
    // Cosine of the largest turn of a normal.
    static constexpr double gentle_turn = 0.5;
    // Nodes are merged along edges shorter than this, in mean lengths.
    static constexpr double short_edge = 0.35;
    static constexpr double sliver_quality = 0.1;  // An angle of 5 degrees.
    // In mean lengths: collapses make no longer slivers, which could reach far off the surface.
    static constexpr double longest_of_sliver = 2;
    // Share of the edge's length: a new vertex farther from the middle lies on another part of the
    // surface.
    static constexpr double largest_miss = 0.35;
    // Largest distance between a hard edge and the boundary that it stands for, unless it was
    // larger before: as a share of the edge's length, and of the mean edge length. With the first
    // alone edges reach around the tips of slots.
    static constexpr double largest_bend = 0.25, most_bend = 0.15;
    // Of an edge whose curve is not found: it stays as it is.
    static constexpr Index unknown_curve = no_index - 1;

    // Whether a triangle may take the place of a face. The normal of a sliver tells nothing.
    [[nodiscard]] bool is_gentle(Index f, const Vec3& before, const Vec3& after) const {
        return is_sliver(f) || after.dot(before) > gentle_turn * after.norm() * before.norm();
    }
    [[nodiscard]] bool is_sliver(Index f) const { return shape_of(f) < sliver_quality; }

    struct Vertex {
        SurfacePoint point;
        Vec3 offset = Vec3::Zero(), at = offset;
        Vec3 facing = offset;  // Zero where the surface may have several normals.
        Mobility mobility = Mobility::Free;
        CurvePlace place = {};
    };
    void locate(Vertex& vertex) const {
        vertex.facing =
            curves_.is_sharp(vertex.place) ? Vec3(Vec3::Zero()) : facing_at(surface_, vertex.point);
        vertex.at = position(surface_.mesh.view(), vertex.point) + vertex.offset;
    }
    [[nodiscard]] double longest_edge_of(const Triangle& t) const {
        return detail::longest_edge_of({at(t[0]), at(t[1]), at(t[2])});
    }
    [[nodiscard]] double quality_of(const Triangle& t) const {
        const auto& [a, b, c] = t;
        const Vec3 facing = vertices_[a].facing + vertices_[b].facing + vertices_[c].facing;
        const bool is_turned = normal_of(t).dot(facing) < 0;
        return shape_(at(a), at(b), at(c)) - (is_turned ? 1 : 0);
    }
    [[nodiscard]] Index worst_face_at(Index v) const {
        return *std::ranges::min_element(faces_at(v), {}, [&](Index f) { return face(f).quality; });
    }
    // Whether a face has a better shape with a corner at a position.
    [[nodiscard]] bool is_better(Index f, Index v, const Vec3& position, double than) const {
        const auto& [a, b, c] = face(f).corner;
        return shape_(a == v ? position : at(a), b == v ? position : at(b),
                      c == v ? position : at(c)) > than;
    }
    [[nodiscard]] bool all_better(Index v, const Vec3& position, double than) const {
        return std::all_of(faces_at(v).begin(), faces_at(v).end(),
                           [&](Index f) { return is_better(f, v, position, than); });
    }
    [[nodiscard]] Vec3 normal_of(const Triangle& t) const {
        return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    }
    // Unless a normal would turn too far (a sliver's may), or `is_fine`, which sees the mesh with
    // the vertex there, says no.
    template <typename Check>
    bool replace(Index v, Vertex vertex, const Check& is_fine) {
        locate(vertex);
        std::vector<Vec3> normals;
        for (const Index f : faces_at(v)) normals.push_back(normal_of(f));
        std::swap(vertices_[v], vertex);
        bool is_kept = is_fine();
        for (std::size_t i = 0; i < normals.size() && is_kept; ++i) {
            const Index f = faces_at(v)[i];
            is_kept = is_gentle(f, normals[i], normal_of(f));
        }
        std::swap(vertices_[v], vertex);
        if (!is_kept) return false;
        put_vertex(v, vertex);
        measure_around(v);
        return true;
    }
    void put_vertex(Index v, const Vertex& vertex) {
        old_vertices_.emplace_back(v, vertices_[v]);
        vertices_[v] = vertex;
    }
    void measure(Index f) { put_quality(f, quality_of(face(f).corner)); }
    void measure_around(Index v) {
        for (const Index f : faces_at(v)) measure(f);
    }
    // Before a node is merged with another vertex: its curves end there now, which the network does
    // not know. Their edges there keep their ends.
    void detach_curves(Index node, Index into) {
        for (const Index f : faces_at(node)) {
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (!is_hard(h) || apex(h) == node) continue;
                put_label(h, unknown_curve);
                pin(tail(h) == node ? head(h) : tail(h));
            }
        }
        pin(into);
    }
    void pin(Index v) {
        if (mobility(v) >= Mobility::Node) return;
        Vertex vertex = vertices_[v];
        vertex.mobility = is_on_rim(v) ? Mobility::Fixed : Mobility::Node;
        put_vertex(v, vertex);
    }
    [[nodiscard]] bool may_collapse(Index gone, Index into) const {
        if (mobility(gone) == Mobility::Fixed) return false;
        if (mobility(gone) == Mobility::Node &&
            (at(into) - at(gone)).norm() > short_edge * mean_length_) {
            return false;
        }
        if (!can_collapse(gone, into)) return false;
        if (mobility(gone) == Mobility::Boundary && !may_leave_boundary(gone, into)) return false;
        return std::all_of(faces_at(gone).begin(), faces_at(gone).end(), [&](Index f) {
            if (has_corner(f, into)) return true;
            Triangle moved = face(f).corner;
            std::replace(moved.begin(), moved.end(), gone, into);
            return is_gentle(f, normal_of(f), normal_of(moved)) &&
                   (!is_sliver(f) ||
                    longest_edge_of(moved) <= std::max(longest_edge_of(face(f).corner),
                                                       longest_of_sliver * mean_length_));
        });
    }
    // For a vertex on a curve: whether it goes along it, no triangle of the rim alone would be
    // left, and the curve stays as near as it was.
    [[nodiscard]] bool may_leave_boundary(Index gone, Index into) const {
        const auto [before, after] = hard_neighbours(gone);
        if (before == no_index || after == no_index) return false;
        if (into != before && into != after) return false;
        const bool is_ear = is_on_rim(gone) && faces_at(gone).size() == 1;
        return !is_ear &&
               keeps_bend(vertices_[gone].place.curve, before, after, largest_bend_at(gone));
    }
    // Finds a point of the surface, or of a curve, near one of an edge. False if walks from both
    // ends miss it.
    [[nodiscard]] bool find_between(Index a, Index b, double share, Index curve,
                                    Vertex& vertex) const {
        vertex.offset = vertices_[a].offset + share * (vertices_[b].offset - vertices_[a].offset);
        const Vec3 wanted = at(a) + share * (at(b) - at(a));
        const double most = largest_miss * (at(b) - at(a)).norm();
        double nearest = most;
        Vertex tried = vertex;
        const auto keep_if_nearer = [&] {
            locate(tried);
            const double miss = (tried.at - wanted).norm();
            if (!(miss < nearest)) return;
            nearest = miss;
            vertex = tried;
        };
        if (curve != no_index) {
            if (curve == unknown_curve) return false;
            tried.mobility = Mobility::Boundary;
            const auto [from, to] = curves_.interval(curve, vertices_[a].place, vertices_[b].place);
            // Where the curve bends, the same share of its arc may be far from there.
            for (const double arc : {share, 0.5, 0.35, 0.65, 0.2, 0.8}) {
                tried.place = {curve, from + arc * (to - from), no_index};
                tried.point = curves_.point(curve, tried.place.along);
                keep_if_nearer();
            }
            return nearest < most;
        }
        // Walks from one end may leave its face on the wrong side.
        const bool takes_other = !vertices_[a].place.is_free() && vertices_[b].place.is_free();
        for (const Index from : {takes_other ? b : a, takes_other ? a : b}) {
            const SurfacePoint& point = vertices_[from].point;
            const Vec3 step = wanted - vertex.offset - position(surface_.mesh.view(), point);
            tried.point = walk_straight(surface_, point, step).end;
            keep_if_nearer();
        }
        return nearest < most;
    }
    // The largest distance of a curve between two vertices from the edge.
    [[nodiscard]] double bend(Index curve, Index from, Index to) const {
        if (curve == no_index || curve == unknown_curve) return 0;
        return curves_.bend(curve,
                            curves_.interval(curve, vertices_[from].place, vertices_[to].place),
                            at(from), at(to));
    }
    // At a vertex of a curve.
    [[nodiscard]] double largest_bend_at(Index v) const {
        const auto [before, after] = hard_neighbours(v);
        if (before == no_index || after == no_index) return 0;
        const Index curve = vertices_[v].place.curve;
        return std::max(bend(curve, before, v), bend(curve, v, after));
    }
    [[nodiscard]] bool keeps_bend(Index curve, Index from, Index to, double most_before) const {
        const double length = (at(to) - at(from)).norm();
        return bend(curve, from, to) <=
               std::max(most_before, std::min(largest_bend * length, most_bend * mean_length_));
    }

    // Of both edges at a vertex on a curve.
    [[nodiscard]] bool keeps_bend_at(Index v, double most_before) const {
        const Index curve = vertices_[v].place.curve;
        const auto [before, after] = hard_neighbours(v);
        return (before == no_index || keeps_bend(curve, before, v, most_before)) &&
               (after == no_index || keeps_bend(curve, v, after, most_before));
    }

    const MeshCurves& curves_;
    const Surface& surface_;
    const ShapeMeasure shape_;
    double mean_length_ = 0;
    std::size_t num_crossings_ = 0;
    std::vector<Vertex> vertices_;  // By vertex.
    std::vector<std::pair<Index, Vertex>> old_vertices_;
};

}  // namespace remesh::detail
