//! \file
//! Proves that an edited mesh and an input are near each other. Private to keep_distance().
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "agvd/core/parallel.h"
#include "remesh/placement/changed_faces.h"
#include "remesh/placement/far_points.h"

namespace remesh::detail {

//! Remembers which faces of both surfaces are proved: later only those that changed, and those of
//! the input beside them, are looked at.
class DistanceProof {
public:
    //! \param mesh, input, poller  outlive this.
    //! \param num_threads  >= 0; 0: all cores.
    DistanceProof(const EditedMesh& mesh, const SearchedMesh& input, double limit, int num_threads,
                  Poller& poller)
        : mesh_(mesh),
          input_(input),
          limit_(limit),
          num_threads_(num_threads),
          poller_(poller),
          is_open_(input.mesh.triangles.size(), 1) {}

    //! \return in each face that is too far a point; empty: all of both surfaces is near enough.
    [[nodiscard]] std::vector<FarPair> run() {
        std::vector<FarPair> all;
        std::vector<Index> changed;
        const TriangleMesh gone = take_changes(changed);
        if (!gone.triangles.empty()) open_beside(gone);
        const TriangleMesh edited = mesh_of(mesh_, changed);
        for (const auto& [i, far] :
             find_far_faces(edited.view(), input_, limit_, num_threads_, poller_)) {
            all.push_back({changed[i], far.at, far.nearest.position, false});
            seen_[changed[i]].reset();  // It is looked at again.
        }
        const std::vector<Index> faces = mesh_.faces();
        const TriangleMesh mesh = mesh_of(mesh_, faces);
        const ClosestPointTree tree(mesh.view(), poller_.progress());
        std::vector<Index> open;
        std::vector<Triangle> triangles;
        for (Index f = 0; f < is_open_.size(); ++f) {
            if (is_open_[f] == 0) continue;
            open.push_back(f);
            triangles.push_back(input_.mesh.triangles[f]);
            is_open_[f] = 0;
        }
        for (const auto& [i, far] :
             find_far_faces({input_.mesh.positions, triangles}, {mesh.view(), tree}, limit_,
                            num_threads_, poller_)) {
            is_open_[open[i]] = 1;
            all.push_back(
                {faces[far.nearest.point.face.value()], far.nearest.position, far.at, true});
        }
        return all;
    }

private:
    // \param[out] changed  the faces that are not as they were seen last.
    // \return what was there in place of them.
    TriangleMesh take_changes(std::vector<Index>& changed) {
        std::vector<std::array<Vec3, 3>> gone;
        seen_.resize(mesh_.num_faces());
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            std::optional<std::array<Vec3, 3>> now;
            if (mesh_.face(f).is_there) now = mesh_.corners_of(f);
            if (now == seen_[f]) continue;
            if (now) changed.push_back(f);
            if (seen_[f]) gone.push_back(*seen_[f]);
            seen_[f] = now;
        }
        return mesh_of(gone);
    }
    // Opens the faces of the input that faces which are gone may have been near enough to.
    void open_beside(const TriangleMesh& gone) {
        const ClosestPointTree tree(gone.view(), poller_.progress());
        parallel_each(
            static_cast<Index>(is_open_.size()), face_grain, num_threads_,
            [&](Index f) {
                const auto corners = corners_of(input_.mesh, f);
                const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
                double radius = 0;
                for (const Vec3& corner : corners) {
                    radius = std::max(radius, (corner - middle).norm());
                }
                if (tree.is_within(middle, radius + limit_)) is_open_[f] = 1;
            },
            poller_);
    }

    static constexpr Index face_grain = 1024;

    const EditedMesh& mesh_;
    SearchedMesh input_;
    double limit_;
    int num_threads_;
    Poller& poller_;
    // By face: its corners at the last proof; unset: it was not there, or not near enough.
    std::vector<std::optional<std::array<Vec3, 3>>> seen_;
    std::vector<std::uint8_t> is_open_;  // By face of the input: 1 if it is not proved.
};

}  // namespace remesh::detail
