//! \file
//! Triangles that are edited by flips, splits and collapses. Private to remeshing.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/core/types.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh::detail {

//! Triangles and, by vertex, those around it. Half-edge 3 f + k runs from corner k of face f to the
//! next one. Faces and fans go to a journal before they change. Each edit costs O(faces around it).
class FanMesh {
public:
    struct Face {
        Triangle corner;
        //! k: a number of the caller for the edge from corner k to the next one, the same on both
        //! sides. It stays with its edge. Edges that are added inside have none: no_index.
        std::array<Index, 3> label{no_index, no_index, no_index};
        bool is_there = false;
        double quality = 0;  //!< For the caller; 0 after a flip or split, taken back with the face.

        [[nodiscard]] bool is_hard(std::size_t k) const { return label[k] != no_index; }
    };
    //! A state to which edits can be undone.
    struct Mark {
        std::size_t faces = 0, fans = 0;  // Sizes of the journals.
        Index num_faces = 0, num_vertices = 0;
    };

    //! Accepts any triangles. Edges without exactly two sides in opposite directions never flip.
    FanMesh(std::span<const Triangle> triangles, Index num_vertices, Ticker ticker = {})
        : fans_(num_vertices), is_on_rim_(num_vertices, 0) {
        faces_.reserve(triangles.size());
        for (const Triangle& t : triangles) {
            for (const Index v : t) fans_[v].push_back(num_faces());
            faces_.push_back({.corner = t, .is_there = true});
        }
        for (Index h = 0; h < 3 * num_faces(); ++h) {
            ticker.tick();
            if (twin(h) == no_index) is_on_rim_[tail(h)] = is_on_rim_[head(h)] = 1;
        }
    }

    [[nodiscard]] Index num_faces() const { return static_cast<Index>(faces_.size()); }
    [[nodiscard]] Index num_vertices() const { return static_cast<Index>(fans_.size()); }
    [[nodiscard]] const Face& face(Index f) const { return faces_[f]; }
    //! In no order; empty: the vertex was removed.
    [[nodiscard]] std::span<const Index> faces_at(Index v) const { return fans_[v]; }
    //! Whether the faces around did not close at the start.
    [[nodiscard]] bool is_on_rim(Index v) const { return is_on_rim_[v] != 0; }
    [[nodiscard]] static constexpr Index next(Index h) { return next_half_edge(h); }
    [[nodiscard]] static constexpr Index previous(Index h) { return previous_half_edge(h); }
    [[nodiscard]] Index tail(Index h) const { return faces_[h / 3].corner[h % 3]; }
    [[nodiscard]] Index head(Index h) const { return tail(next(h)); }
    [[nodiscard]] Index apex(Index h) const { return tail(previous(h)); }
    [[nodiscard]] Index label(Index h) const { return faces_[h / 3].label[h % 3]; }
    [[nodiscard]] bool is_hard(Index h) const { return label(h) != no_index; }
    [[nodiscard]] bool has_corner(Index f, Index v) const {
        const Triangle& t = faces_[f].corner;
        return t[0] == v || t[1] == v || t[2] == v;
    }
    [[nodiscard]] bool are_joined(Index a, Index b) const {
        return std::any_of(fans_[a].begin(), fans_[a].end(),
                           [&](Index f) { return has_corner(f, b); });
    }
    //! The first one; no_index: there is none.
    [[nodiscard]] Index half_edge(Index from, Index to) const {
        for (const Index f : fans_[from]) {
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (tail(h) == from && head(h) == to) return h;
            }
        }
        return no_index;
    }
    //! The other side of an edge; no_index unless it has just two, in opposite directions.
    [[nodiscard]] Index twin(Index h) const {
        const Index other = half_edge(head(h), tail(h));
        const auto num_sides = std::count_if(fans_[tail(h)].begin(), fans_[tail(h)].end(),
                                             [&](Index f) { return has_corner(f, head(h)); });
        return num_sides == 2 ? other : no_index;
    }
    //! The triangles that are there.
    [[nodiscard]] std::vector<Triangle> triangles() const {
        std::vector<Triangle> result;
        result.reserve(faces_.size());
        for (const Face& face : faces_) {
            if (face.is_there) result.push_back(face.corner);
        }
        return result;
    }

    //! Whether the edge has two faces and no edge joins the corners opposite to it yet.
    [[nodiscard]] bool can_flip(Index h) const {
        const Index other = twin(h);
        return other != no_index && apex(h) != apex(other) && !are_joined(apex(h), apex(other));
    }
    //! Makes faces (a, b, c) of h and (b, a, d) beyond (c, a, d) and (d, b, c).
    void flip(Index h) {
        assert(can_flip(h));
        const Index other = twin(h), f = h / 3, g = other / 3;
        const Index a = tail(h), b = head(h), c = apex(h), d = apex(other);
        for (const Index v : {a, b, c, d}) log_fan(v);
        std::erase(fans_[b], f);
        std::erase(fans_[a], g);
        fans_[d].push_back(f);
        fans_[c].push_back(g);
        const Index bc = label(next(h)), ca = label(previous(h));
        const Index ad = label(next(other)), db = label(previous(other));
        put_face(f, {{c, a, d}, {ca, ad, no_index}, true});
        put_face(g, {{d, b, c}, {db, bc, no_index}, true});
    }
    //! Divides an edge of one or two faces, and these. The halves keep the edge's label.
    //! \return the new vertex.
    Index split(Index h) {
        const Index other = twin(h), added = num_vertices();
        fans_.emplace_back();
        is_on_rim_.push_back(other == no_index ? 1 : 0);
        split_side(h, added);
        if (other != no_index) split_side(other, added);
        return added;
    }
    //! Whether an edge joins both and its collapse keeps the topology: the link condition
    //! ([dey1999]). A vertex on the rim goes along it only; the last triangle stays.
    [[nodiscard]] bool can_collapse(Index gone, Index into) const {
        std::array<Index, 2> apexes{no_index, no_index};
        std::size_t num_apexes = 0;
        for (const Index f : fans_[gone]) {
            if (!has_corner(f, into)) continue;
            if (num_apexes == 2) return false;
            for (const Index v : faces_[f].corner) {
                if (v != gone && v != into) apexes[num_apexes++] = v;
            }
        }
        if (num_apexes == 0 || (is_on_rim(gone) && num_apexes == 2)) return false;
        if (num_apexes == 1 && fans_[apexes[0]].size() == 1) return false;
        for (const Index f : fans_[gone]) {
            for (const Index v : faces_[f].corner) {
                const bool is_other = v != gone && v != into && v != apexes[0] && v != apexes[1];
                if (is_other && are_joined(into, v)) return false;
            }
        }
        const auto has_face = [&](Index v) {
            return std::any_of(fans_[v].begin(), fans_[v].end(), [&](Index f) {
                return has_corner(f, apexes[0]) && has_corner(f, apexes[1]);
            });
        };
        return num_apexes == 1 || !(has_face(gone) && has_face(into));
    }
    //! Removes `gone` and the faces at the edge. Two sides of such a face become one edge: with the
    //! label of the one at `into` or, if that has none, of the other.
    void collapse(Index gone, Index into) {
        assert(can_collapse(gone, into));
        std::vector<std::pair<std::pair<Index, Index>, Index>> labels;
        log_fan(gone);
        log_fan(into);
        for (const Index f : std::exchange(fans_[gone], {})) {
            Face face = faces_[f];
            if (!has_corner(f, into)) {
                std::replace(face.corner.begin(), face.corner.end(), gone, into);
                fans_[into].push_back(f);
                put_face(f, face);
                continue;
            }
            // The face beyond the other side lacks the label.
            const Index kept = side_opposite(f, gone), lost = side_opposite(f, into);
            if (is_hard(kept)) {
                labels.push_back({{tail(kept), head(kept)}, label(kept)});
            } else if (is_hard(lost)) {
                labels.push_back({{head(kept), tail(kept)}, label(lost)});
            }
            for (const Index v : {tail(kept), head(kept)}) {
                if (v != into) log_fan(v);
                std::erase(fans_[v], f);
            }
            face.is_there = false;
            put_face(f, face);
        }
        for (const auto& [ends, label] : labels) {
            const Index h = half_edge(ends.first, ends.second);
            if (h != no_index) put_label(h, label);
        }
    }

    //! For one side of an edge; the caller does the same for the other.
    void put_label(Index h, Index label) {
        Face face = faces_[h / 3];
        face.label[h % 3] = label;
        put_face(h / 3, face);
    }
    void put_quality(Index f, double quality) {
        Face face = faces_[f];
        face.quality = quality;
        put_face(f, face);
    }

    //! Labels both sides of edges, and empties the journal.
    //! \param edges     in one direction or both.
    //! \param label_of  label_of(from, to) of one that is there.
    template <typename LabelOf>
    void label_edges(std::span<const std::pair<Index, Index>> edges, const LabelOf& label_of) {
        std::vector<std::pair<Index, Index>> both(edges.begin(), edges.end());
        for (const auto& [from, to] : edges) both.emplace_back(to, from);
        std::sort(both.begin(), both.end());
        for (Index h = 0; h < 3 * num_faces(); ++h) {
            const Index a = tail(h), b = head(h);
            if (!std::binary_search(both.begin(), both.end(), std::pair(a, b))) continue;
            put_label(h, label_of(a, b));
        }
        forget();
    }

    [[nodiscard]] Mark mark() const {
        return {old_faces_.size(), old_fans_.size(), num_faces(), num_vertices()};
    }
    //! Undoes all edits since the mark.
    void take_back(const Mark& mark) {
        undo(old_faces_, mark.faces, faces_);
        undo(old_fans_, mark.fans, fans_);
        faces_.resize(mark.num_faces);
        fans_.resize(mark.num_vertices);
        is_on_rim_.resize(mark.num_vertices);
    }
    //! Empties the journal: no earlier edit can be taken back. Marks end.
    void forget() {
        old_faces_.clear();
        old_fans_.clear();
    }
    //! Faces changed since the mark, ascending, also those that were removed.
    [[nodiscard]] std::vector<Index> changed_since(const Mark& mark) const {
        std::vector<Index> changed;
        for (std::size_t i = mark.faces; i < old_faces_.size(); ++i) {
            changed.push_back(old_faces_[i].first);
        }
        return distinct(std::move(changed));
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

protected:
    //! Takes the last entries of a journal back, down to a size.
    template <typename Value>
    static void undo(std::vector<std::pair<Index, Value>>& journal, std::size_t size,
                     std::vector<Value>& values) {
        while (journal.size() > size) {
            values[journal.back().first] = std::move(journal.back().second);
            journal.pop_back();
        }
    }

private:
    void put_face(Index f, const Face& face) {
        old_faces_.emplace_back(f, faces_[f]);
        faces_[f] = face;
    }
    void log_fan(Index v) { old_fans_.emplace_back(v, fans_[v]); }
    [[nodiscard]] Index side_opposite(Index f, Index v) const {
        Index h = 3 * f;
        while (apex(h) != v) ++h;
        return h;
    }
    void split_side(Index h, Index vertex) {
        const Index a = tail(h), b = head(h), c = apex(h), f = h / 3, added = num_faces();
        const Index ab = label(h), bc = label(next(h)), ca = label(previous(h));
        faces_.emplace_back();
        log_fan(b);
        log_fan(c);
        std::replace(fans_[b].begin(), fans_[b].end(), f, added);
        fans_[c].push_back(added);
        fans_[vertex].push_back(f);
        fans_[vertex].push_back(added);
        put_face(f, {{a, vertex, c}, {ab, no_index, ca}, true});
        put_face(added, {{vertex, b, c}, {ab, bc, no_index}, true});
    }

    std::vector<Face> faces_;
    std::vector<std::vector<Index>> fans_;  // By vertex.
    std::vector<std::uint8_t> is_on_rim_;   // By vertex.
    std::vector<std::pair<Index, Face>> old_faces_;
    std::vector<std::pair<Index, std::vector<Index>>> old_fans_;
};

//! Whether a flip would make an edge there sharper than 60 degrees and than all were before, or
//! leave a face without area.
//! \param at      the position of a vertex.
//! \param counts  counts(h, twin): whether an edge around does.
template <typename At, typename Counts>
[[nodiscard]] bool flip_folds(const FanMesh& mesh, Index h, const At& at, const Counts& counts) {
    constexpr double gentle_fold = 0.5;  // Cosine.
    const auto unit = [&](const Triangle& t) -> Vec3 {
        return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized();
    };
    const Index twin = mesh.twin(h);
    const Index a = mesh.tail(h), b = mesh.head(h), c = mesh.apex(h), d = mesh.apex(twin);
    const std::array<Vec3, 2> now{unit({a, b, c}), unit({b, a, d})};
    const std::array<Vec3, 2> then{unit({c, a, d}), unit({d, b, c})};
    if (then[0].isZero() || then[1].isZero()) return true;
    double before = now[0].dot(now[1]), after = then[0].dot(then[1]);
    const std::array rim{mesh.next(h), mesh.previous(h), mesh.next(twin), mesh.previous(twin)};
    for (std::size_t i = 0; i < 4; ++i) {
        const Index across = mesh.twin(rim[i]);
        if (across == no_index || !counts(rim[i], across)) continue;
        const Vec3 beyond = unit(mesh.face(across / 3).corner);
        before = std::min(before, beyond.dot(now[i / 2]));
        after = std::min(after, beyond.dot(then[i == 0 || i == 3 ? 1 : 0]));
    }
    return !(after >= std::min(before, gentle_fold));
}

}  // namespace remesh::detail
