//! \file
//! A mesh in space whose edits are taken back where they would add intersections.
#pragma once

#include <vector>

#include "remesh/dual/fan_mesh.h"
#include "remesh/placement/crossing_guard.h"

namespace remesh::detail {

//! Triangles with positions, whose edits can be undone.
class SpaceMesh : public FanMesh {
public:
    //! A state to which edits can be undone.
    struct Mark : FanMesh::Mark {
        std::size_t moves = 0;
    };

    explicit SpaceMesh(const TriangleMesh& mesh)
        : FanMesh(mesh.triangles, static_cast<Index>(mesh.positions.size())), at_(mesh.positions) {
        for (Index h = 0; h < 3 * num_faces(); ++h) mean_length_ += length(h);
        mean_length_ /= 3 * num_faces();
    }

    [[nodiscard]] const Vec3& at(Index v) const { return at_[v]; }
    [[nodiscard]] const std::vector<Vec3>& positions() const { return at_; }
    //! Of the initial edges.
    [[nodiscard]] double mean_length() const { return mean_length_; }
    [[nodiscard]] double length(Index h) const { return (at(head(h)) - at(tail(h))).norm(); }
    [[nodiscard]] std::array<Vec3, 3> corners_of(Index f) const {
        const auto& [a, b, c] = face(f).corner;
        return {at(a), at(b), at(c)};
    }
    //! Twice its area long.
    [[nodiscard]] Vec3 normal_of(Index f) const { return doubled_normal(at_, face(f).corner); }
    [[nodiscard]] MeshBox box_of(Index f) const {
        MeshBox box;
        for (const Vec3& corner : corners_of(f)) box.add(corner);
        return box;
    }

    void move(Index v, const Vec3& to) {
        moves_.emplace_back(v, at_[v]);
        at_[v] = to;
        for (const Index f : faces_at(v)) put_quality(f, 0);  // They count as changed.
    }
    //! Divides an edge, and its faces, at a point. \return the new vertex.
    Index split(Index h, const Vec3& point) {
        at_.push_back(point);
        return FanMesh::split(h);
    }
    [[nodiscard]] Mark mark() const { return {FanMesh::mark(), moves_.size()}; }
    void take_back(const Mark& mark) {
        undo(moves_, mark.moves, at_);
        FanMesh::take_back(mark);
        at_.resize(mark.num_vertices);
    }
    //! Ends all marks.
    void forget() {
        moves_.clear();
        FanMesh::forget();
    }

private:
    std::vector<Vec3> at_;  // By vertex.
    std::vector<std::pair<Index, Vec3>> moves_;
    double mean_length_ = 0;
};

//! Edits it, unless faces would intersect that did not.
class GuardedMesh {
public:
    //! Cost: O(#faces).
    explicit GuardedMesh(const TriangleMesh& mesh) : mesh_(mesh), guard_(mesh_) {}

    [[nodiscard]] const SpaceMesh& operator*() const { return mesh_; }
    [[nodiscard]] const SpaceMesh* operator->() const { return &mesh_; }

    //! \param edit  edit(SpaceMesh&). \return whether it was made. Cost: O(faces nearby).
    template <typename Edit>
    bool edit(const Edit& edit) {
        const SpaceMesh::Mark mark = mesh_.mark();
        edit(mesh_);
        const bool is_fine = guard_.accepts(mesh_.changed_since(mark));
        if (is_fine) {
            guard_.take_over();
            mesh_.forget();
        } else {
            mesh_.take_back(mark);
        }
        return is_fine;
    }
    bool move(Index v, const Vec3& to) {
        return edit([&](SpaceMesh& mesh) { mesh.move(v, to); });
    }

private:
    SpaceMesh mesh_;
    CrossingGuard<SpaceMesh> guard_;
};

}  // namespace remesh::detail
