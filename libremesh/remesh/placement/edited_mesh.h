//! \file
//! A mesh on a surface, edited by flips, splits, collapses and moves that can be undone.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "remesh/curves/glue.h"
#include "remesh/curves/walk.h"
#include "remesh/dual/flippable_mesh.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/placement/placement.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

//! Every edit keeps the topology, and chains of hard edges stay chains of hard edges. No normal
//! turns by more than 60 degrees, and no edge becomes sharper than both 60 degrees and the edges
//! around it were. Edits that would break these rules change nothing.
//!
//! Faces, vertices and fans go to a journal before they change. A collapse checks the link
//! condition ([dey1999]).
class EditedMesh {
public:
    struct Face {
        Triangle corner;
        //! k: the curve of the edge from corner k to the next one; no_index: it lies on none.
        std::array<Index, 3> curve{no_index, no_index, no_index};
        bool is_there = false;
        double quality = 0;  //!< shape_quality(); 1 less if the face points against the surface.

        [[nodiscard]] bool is_hard(std::size_t k) const { return curve[k] != no_index; }
    };
    //! A state to which edits can be undone.
    struct Mark {
        std::size_t faces = 0, vertices = 0, fans = 0;  // Sizes of the journals.
        Index num_faces = 0, num_vertices = 0;
    };

    //! \param curves    outlives this.
    //! \param mobility  #V. Free ones lie on no curve.
    //! \param hard      edges along curves, in one direction or both: never flipped; they must
    //!                  include all edges of a single face.
    EditedMesh(const MeshCurves& curves, const PlacedMesh& mesh, std::span<const Mobility> mobility,
               std::span<const DirectedEdge> hard)
        : curves_(curves),
          surface_(curves.surface()),
          faces_(mesh.triangles.size()),
          vertices_(mesh.points.size()),
          fans_(mesh.points.size()) {
        for (Index v = 0; v < vertices_.size(); ++v) {
            vertices_[v].point = mesh.points[v];
            vertices_[v].offset = mesh.offsets[v];
            vertices_[v].mobility = mobility[v];
            if (mobility[v] != Mobility::Free) {
                vertices_[v].place = curves.place_of(mesh.points[v]);
            }
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
            faces_[f] = {t, {no_index, no_index, no_index}, true, quality_of(t)};
            for (Index k = 0; k < 3; ++k) {
                fans_[t[k]].push_back(f);
                const Index a = t[k], b = t[(k + 1) % 3];
                if (!std::binary_search(edges.begin(), edges.end(), DirectedEdge(a, b))) continue;
                faces_[f].curve[k] = curves.curve_between(vertices_[a].place, vertices_[b].place);
                if (faces_[f].curve[k] == no_index) faces_[f].curve[k] = unknown_curve;
            }
        }
        for (Index h = 0; h < 3 * num_faces(); ++h) {
            if (half_edge(head(h), tail(h)) != no_index) continue;
            for (const Index v : {tail(h), head(h)}) {
                vertices_[v].is_on_rim = true;
                if (vertices_[v].mobility == Mobility::Node) {
                    vertices_[v].mobility = Mobility::Fixed;
                }
            }
        }
    }

    [[nodiscard]] Index num_faces() const { return static_cast<Index>(faces_.size()); }
    [[nodiscard]] Index num_vertices() const { return static_cast<Index>(vertices_.size()); }
    [[nodiscard]] const Face& face(Index f) const { return faces_[f]; }
    //! In no order; empty: the vertex was removed.
    [[nodiscard]] std::span<const Index> faces_at(Index v) const { return fans_[v]; }
    [[nodiscard]] const Vec3& at(Index v) const { return vertices_[v].at; }
    [[nodiscard]] FaceId face_of_surface(Index v) const { return vertices_[v].point.face; }
    [[nodiscard]] std::array<Vec3, 3> corners_of(Index f) const {
        const auto& [a, b, c] = faces_[f].corner;
        return {at(a), at(b), at(c)};
    }
    [[nodiscard]] MeshBox box_of(Index f) const {
        MeshBox box;
        for (const Vec3& at : corners_of(f)) box.add(at);
        return box;
    }
    [[nodiscard]] Mobility mobility(Index v) const { return vertices_[v].mobility; }
    [[nodiscard]] double worst_at(Index v) const {
        double worst = 1;
        for (const Index f : fans_[v]) worst = std::min(worst, faces_[f].quality);
        return worst;
    }
    //! The two neighbours of a vertex on a curve; no_index: there are fewer.
    [[nodiscard]] std::array<Index, 2> hard_neighbours(Index v) const {
        std::array<Index, 2> found{no_index, no_index};
        for (const Index f : fans_[v]) {
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
        if (is_hard(h)) return false;
        const Index a = tail(h), b = head(h), c = apex(h), twin = half_edge(b, a);
        if (twin == no_index) return false;
        const Index d = apex(twin);
        if (c == d || are_joined(c, d)) return false;
        for (const Index v : {a, b}) {
            if (fans_[v].size() <= least_faces(v)) return false;
        }
        if (folds(h, twin)) return false;
        for (const Index v : {a, b, c, d}) log_fan(v);
        std::erase(fans_[b], face);
        std::erase(fans_[a], twin / 3);
        fans_[d].push_back(face);
        fans_[c].push_back(twin / 3);
        const Index bc = curve_of(Surface::next(h)), ca = curve_of(Surface::previous(h));
        const Index ad = curve_of(Surface::next(twin)), db = curve_of(Surface::previous(twin));
        put_face(face, {c, a, d}, {ca, ad, no_index});
        put_face(twin / 3, {d, b, c}, {db, bc, no_index});
        return true;
    }
    //! \return the new vertex, near the middle of that edge; no_index if it cannot be split.
    Index split(Index face, Index k) {
        const Index h = 3 * face + k, a = tail(h), b = head(h);
        if (mobility(a) == Mobility::Fixed && mobility(b) == Mobility::Fixed) return no_index;
        Vertex vertex;
        if (!find_between(a, b, curve_of(h), vertex)) return no_index;
        const Index twin = half_edge(b, a);
        vertex.is_on_rim = twin == no_index;
        const auto keeps_normal = [&](Index side) {
            const Vec3 &p = at(tail(side)), &q = at(head(side)), &r = at(apex(side));
            const Vec3 before = (q - p).cross(r - p);
            return is_gentle(side / 3, before, (vertex.at - p).cross(r - p)) &&
                   is_gentle(side / 3, before, (q - vertex.at).cross(r - vertex.at));
        };
        if (!keeps_normal(h) || (twin != no_index && !keeps_normal(twin))) return no_index;
        const Index added = num_vertices();
        vertices_.push_back(vertex);
        fans_.emplace_back();
        split_side(h, added);
        if (twin != no_index) split_side(twin, added);
        return added;
    }
    //! Collapses the edge between two vertices: removes `gone`; `into` stays in place.
    bool collapse(Index gone, Index into) {
        if (!may_collapse(gone, into)) return false;
        if (mobility(gone) == Mobility::Node) detach_curves(gone, into);
        const std::vector<Index> fan = fans_[gone];
        // Two sides of a removed face become one edge: hard if one of them is, with the curve of
        // that at `into` if both are.
        std::vector<std::pair<DirectedEdge, Index>> hard;
        log_fan(gone);
        log_fan(into);
        fans_[gone].clear();
        for (const Index f : fan) {
            const Face old = faces_[f];
            if (!has_corner(f, into)) {
                Triangle moved = old.corner;
                std::replace(moved.begin(), moved.end(), gone, into);
                fans_[into].push_back(f);
                put_face(f, moved, old.curve);
                continue;
            }
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (apex(h) == gone && is_hard(h)) {
                    hard.push_back({{tail(h), head(h)}, curve_of(h)});
                }
                const Index other = tail(h) == gone ? Surface::next(h) : Surface::previous(h);
                if (apex(h) == into && is_hard(h) && !is_hard(other)) {
                    hard.push_back(
                        {{tail(h) == gone ? into : tail(h), head(h) == gone ? into : head(h)},
                         curve_of(h)});
                }
            }
            drop_face(f);
            for (const Index w : old.corner) {
                if (w == gone) continue;
                if (w != into) log_fan(w);
                std::erase(fans_[w], f);
            }
        }
        for (const auto& [ends, curve] : hard) {
            // A face beyond the removed one has this edge, in the same direction.
            const Index h = half_edge(ends.first, ends.second);
            if (h == no_index) continue;
            Face face = faces_[h / 3];
            face.curve[h % 3] = curve;
            put_face(h / 3, face.corner, face.curve);
        }
        return true;
    }
    //! Moves a vertex along the surface if the worst face around it gets better by more than
    //! `gain`. Does not if its walk is cut off.
    bool move(Index v, const Vec3& step, double gain) {
        Vertex vertex = vertices_[v];
        if (vertex.mobility >= Mobility::Node) return false;
        const Index worst_face = worst_face_at(v);
        const double worst = faces_[worst_face].quality;
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
        locate(vertex);
        const Vertex before = vertices_[v];
        std::vector<Vec3> normals;
        for (const Index f : fans_[v]) normals.push_back(normal_of(faces_[f].corner));
        vertices_[v] = vertex;
        bool helps = true;
        for (std::size_t i = 0; i < normals.size() && helps; ++i) {
            const Triangle& t = faces_[fans_[v][i]].corner;
            helps =
                quality_of(t) > worst + gain && is_gentle(fans_[v][i], normals[i], normal_of(t));
        }
        if (helps && vertex.mobility == Mobility::Boundary) {
            vertices_[v] = before;
            const double bend_before = largest_bend_at(v);
            vertices_[v] = vertex;
            const auto [previous, next] = hard_neighbours(v);
            const Index curve = vertex.place.curve;
            helps = (previous == no_index || keeps_bend(curve, previous, v, bend_before)) &&
                    (next == no_index || keeps_bend(curve, v, next, bend_before));
        }
        vertices_[v] = before;
        if (!helps) return false;
        put_vertex(v, vertex);
        measure_around(v);
        return true;
    }
    //! Edges of the surface that all calls of `move` together crossed: their cost.
    [[nodiscard]] std::size_t num_crossings() const { return num_crossings_; }

    //! Of the initial edges.
    [[nodiscard]] double mean_length() const { return mean_length_; }

    [[nodiscard]] Mark mark() const {
        return {old_faces_.size(), old_vertices_.size(), old_fans_.size(), num_faces(),
                num_vertices()};
    }
    void take_back(const Mark& mark) {
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
    //! Faces changed since the mark, each once, also those that were removed.
    [[nodiscard]] std::vector<Index> changed_since(const Mark& mark) const {
        std::vector<Index> changed;
        for (std::size_t i = mark.faces; i < old_faces_.size(); ++i) {
            changed.push_back(old_faces_[i].first);
        }
        std::sort(changed.begin(), changed.end());
        changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
        return changed;
    }
    //! \param[out] now     the changed faces that exist now.
    //! \param[out] before  the old qualities of those that existed at the mark.
    void changed_since(const Mark& mark, std::vector<Index>& now,
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

    //! The mesh without removed faces and vertices.
    //! \param[out] numbers  by vertex of the result: its number here.
    [[nodiscard]] PlacedMesh result(std::vector<Index>& numbers) const {
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
            mesh.triangles.push_back(
                {number[f.corner[0]], number[f.corner[1]], number[f.corner[2]]});
        }
        return mesh;
    }

private:
    // Cosine of the largest turn of a normal.
    static constexpr double gentle_turn = 0.5;
    // Nodes are merged along edges shorter than this, in mean lengths.
    static constexpr double short_edge = 0.35;
    static constexpr double sliver_quality = 0.1;  // An angle of 5 degrees.
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
    [[nodiscard]] bool is_sliver(Index f) const {
        const double quality = faces_[f].quality;
        return (quality < 0 ? quality + 1 : quality) < sliver_quality;
    }

    struct Vertex {
        SurfacePoint point;
        Vec3 offset = Vec3::Zero(), at = offset;
        Vec3 facing = offset;  // Zero where the surface may have several normals.
        Mobility mobility = Mobility::Free;
        CurvePlace place = {};
        bool is_on_rim = false;  // Of the mesh.
    };
    void locate(Vertex& vertex) const {
        vertex.facing =
            curves_.is_sharp(vertex.place) ? Vec3(Vec3::Zero()) : facing_at(surface_, vertex.point);
        vertex.at = position(surface_.mesh.view(), vertex.point) + vertex.offset;
    }
    [[nodiscard]] double quality_of(const Triangle& t) const {
        const auto& [a, b, c] = t;
        const Vec3 facing = vertices_[a].facing + vertices_[b].facing + vertices_[c].facing;
        const bool is_turned = normal_of(t).dot(facing) < 0;
        return shape_quality(at(a), at(b), at(c)) - (is_turned ? 1 : 0);
    }
    [[nodiscard]] Index worst_face_at(Index v) const {
        return *std::min_element(fans_[v].begin(), fans_[v].end(), [&](Index f, Index g) {
            return faces_[f].quality < faces_[g].quality;
        });
    }
    // Whether a face has a better shape with a corner at a position.
    [[nodiscard]] bool is_better(Index f, Index v, const Vec3& position, double than) const {
        const auto& [a, b, c] = faces_[f].corner;
        return shape_quality(a == v ? position : at(a), b == v ? position : at(b),
                             c == v ? position : at(c)) > than;
    }
    [[nodiscard]] bool all_better(Index v, const Vec3& position, double than) const {
        return std::all_of(fans_[v].begin(), fans_[v].end(),
                           [&](Index f) { return is_better(f, v, position, than); });
    }
    [[nodiscard]] Vec3 normal_of(const Triangle& t) const {
        return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    }
    void put_face(Index f, const Triangle& corner, const std::array<Index, 3>& curve) {
        old_faces_.emplace_back(f, faces_[f]);
        faces_[f] = {corner, curve, true, quality_of(corner)};
    }
    void drop_face(Index f) {
        old_faces_.emplace_back(f, faces_[f]);
        faces_[f].is_there = false;
    }
    void put_vertex(Index v, const Vertex& vertex) {
        old_vertices_.emplace_back(v, vertices_[v]);
        vertices_[v] = vertex;
    }
    void log_fan(Index v) { old_fans_.emplace_back(v, fans_[v]); }
    void measure_around(Index v) {
        for (const Index f : fans_[v]) put_face(f, faces_[f].corner, faces_[f].curve);
    }
    [[nodiscard]] bool has_corner(Index f, Index v) const {
        const Triangle& t = faces_[f].corner;
        return t[0] == v || t[1] == v || t[2] == v;
    }
    // Half-edges are numbered as in Surface.
    [[nodiscard]] Index tail(Index h) const { return faces_[h / 3].corner[h % 3]; }
    [[nodiscard]] Index head(Index h) const { return tail(Surface::next(h)); }
    [[nodiscard]] Index apex(Index h) const { return tail(Surface::previous(h)); }
    [[nodiscard]] Index curve_of(Index h) const { return faces_[h / 3].curve[h % 3]; }
    [[nodiscard]] bool is_hard(Index h) const { return curve_of(h) != no_index; }
    // No vertex may have fewer.
    [[nodiscard]] std::size_t least_faces(Index v) const { return vertices_[v].is_on_rim ? 2 : 3; }
    // no_index: there is none.
    [[nodiscard]] Index half_edge(Index from, Index to) const {
        for (const Index f : fans_[from]) {
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (tail(h) == from && head(h) == to) return h;
            }
        }
        return no_index;
    }
    [[nodiscard]] bool are_joined(Index a, Index b) const {
        return std::any_of(fans_[a].begin(), fans_[a].end(),
                           [&](Index f) { return has_corner(f, b); });
    }
    [[nodiscard]] bool folds(Index h, Index twin) const {
        const std::array rim{Surface::next(h), Surface::previous(h), Surface::next(twin),
                             Surface::previous(twin)};
        const auto unit = [&](const Triangle& t) -> Vec3 { return normal_of(t).normalized(); };
        return flip_folds({tail(h), head(h), apex(h), apex(twin)}, unit,
                          [&](std::size_t i) -> std::optional<Vec3> {
                              if (is_hard(rim[i])) return std::nullopt;
                              const Index across = half_edge(head(rim[i]), tail(rim[i]));
                              if (across == no_index || is_sliver(across / 3)) return std::nullopt;
                              return unit(faces_[across / 3].corner);
                          });
    }
    // Before a node is merged with another vertex: its curves end there now, which the network does
    // not know. Their edges there keep their ends.
    void detach_curves(Index node, Index into) {
        for (const Index f : std::vector<Index>(fans_[node])) {
            Face face = faces_[f];
            for (Index k = 0; k < 3; ++k) {
                const Index a = face.corner[k], b = face.corner[(k + 1) % 3];
                if (!face.is_hard(k) || (a != node && b != node)) continue;
                face.curve[k] = unknown_curve;
                pin(a == node ? b : a);
            }
            put_face(f, face.corner, face.curve);
        }
        pin(into);
    }
    void pin(Index v) {
        if (mobility(v) >= Mobility::Node) return;
        Vertex vertex = vertices_[v];
        vertex.mobility = vertex.is_on_rim ? Mobility::Fixed : Mobility::Node;
        put_vertex(v, vertex);
    }
    [[nodiscard]] bool may_collapse(Index gone, Index into) const {
        if (mobility(gone) == Mobility::Fixed) return false;
        if (mobility(gone) == Mobility::Node &&
            (at(into) - at(gone)).norm() > short_edge * mean_length_) {
            return false;
        }
        std::array<Index, 2> apexes{no_index, no_index};
        std::size_t num_apexes = 0;
        std::vector<Index> ring;
        for (const Index f : fans_[gone]) {
            for (const Index v : faces_[f].corner) {
                if (v == gone) continue;
                ring.push_back(v);
                if (v != into && has_corner(f, into)) apexes[num_apexes++] = v;
            }
        }
        if (num_apexes == 0) return false;
        if (mobility(gone) == Mobility::Boundary && !may_leave_boundary(gone, into, apexes)) {
            return false;
        }
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        const auto num_common = static_cast<std::size_t>(std::count_if(
            ring.begin(), ring.end(), [&](Index w) { return w != into && are_joined(into, w); }));
        if (num_common != num_apexes) return false;
        const auto has_face = [&](Index v) {
            return std::any_of(fans_[v].begin(), fans_[v].end(), [&](Index f) {
                return has_corner(f, apexes[0]) && has_corner(f, apexes[1]);
            });
        };
        if (num_apexes == 2 && has_face(gone) && has_face(into)) return false;
        for (Index i = 0; i < num_apexes; ++i) {
            // An inner vertex keeps three faces.
            const Index v = apexes[i];
            if (!vertices_[v].is_on_rim && fans_[v].size() <= least_faces(v)) return false;
        }
        return std::all_of(fans_[gone].begin(), fans_[gone].end(), [&](Index f) {
            if (has_corner(f, into)) return true;
            Triangle moved = faces_[f].corner;
            std::replace(moved.begin(), moved.end(), gone, into);
            return is_gentle(f, normal_of(faces_[f].corner), normal_of(moved));
        });
    }
    // For a vertex on a curve: whether it goes along it, no triangle of the rim alone would be
    // left, and the curve stays as near as it was.
    [[nodiscard]] bool may_leave_boundary(Index gone, Index into,
                                          const std::array<Index, 2>& apexes) const {
        const auto [before, after] = hard_neighbours(gone);
        if (before == no_index || after == no_index) return false;
        if (into != before && into != after) return false;
        const Index other = into == after ? before : after;
        const bool is_ear = other == apexes[0] || other == apexes[1];
        return !(is_ear && vertices_[gone].is_on_rim) &&
               keeps_bend(vertices_[gone].place.curve, before, after, largest_bend_at(gone));
    }
    // Finds a point of the surface, or of a curve, near the middle. False if walks from both ends
    // miss it.
    [[nodiscard]] bool find_between(Index a, Index b, Index curve, Vertex& vertex) const {
        vertex.offset = (vertices_[a].offset + vertices_[b].offset) / 2;
        const Vec3 middle = (at(a) + at(b)) / 2;
        const double most = largest_miss * (at(b) - at(a)).norm();
        if (curve != no_index) {
            if (curve == unknown_curve) return false;
            vertex.mobility = Mobility::Boundary;
            const auto [from, to] = curves_.interval(curve, vertices_[a].place, vertices_[b].place);
            // Where the curve bends, the middle of its arc may be far from that of the edge.
            double nearest = most;
            Vertex tried = vertex;
            for (const double share : {0.5, 0.35, 0.65, 0.2, 0.8}) {
                tried.place = {curve, from + share * (to - from), no_index};
                tried.point = curves_.point(curve, tried.place.along);
                locate(tried);
                const double miss = (tried.at - middle).norm();
                if (!(miss < nearest)) continue;
                nearest = miss;
                vertex = tried;
            }
            return nearest < most;
        }
        const bool takes_other = !vertices_[a].place.is_free() && vertices_[b].place.is_free();
        for (const Index from : {takes_other ? b : a, takes_other ? a : b}) {
            const SurfacePoint& point = vertices_[from].point;
            const Vec3 step = middle - vertex.offset - position(surface_.mesh.view(), point);
            vertex.point = walk_straight(surface_, point, step).end;
            locate(vertex);
            if ((vertex.at - middle).norm() <= most) return true;
        }
        return false;
    }
    void split_side(Index h, Index vertex) {
        const Index a = tail(h), b = head(h), c = apex(h), face = h / 3, added = num_faces();
        const Index ab = curve_of(h), bc = curve_of(Surface::next(h)),
                    ca = curve_of(Surface::previous(h));
        faces_.push_back({{vertex, b, c}});
        log_fan(b);
        log_fan(c);
        std::replace(fans_[b].begin(), fans_[b].end(), face, added);
        fans_[c].push_back(added);
        fans_[vertex].push_back(face);
        fans_[vertex].push_back(added);
        put_face(face, {a, vertex, c}, {ab, no_index, ca});
        put_face(added, {vertex, b, c}, {ab, bc, no_index});
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

    const MeshCurves& curves_;
    const Surface& surface_;
    double mean_length_ = 0;
    std::size_t num_crossings_ = 0;
    std::vector<Face> faces_;
    std::vector<Vertex> vertices_;          // By vertex.
    std::vector<std::vector<Index>> fans_;  // By vertex: its faces.
    std::vector<std::pair<Index, Face>> old_faces_;
    std::vector<std::pair<Index, Vertex>> old_vertices_;
    std::vector<std::pair<Index, std::vector<Index>>> old_fans_;
};

}  // namespace remesh::detail
