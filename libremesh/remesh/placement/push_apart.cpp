// Where two sheets are nearer to each other than triangles sag, their faces intersect though their
// vertices do not. Such vertices move off the surface, away from the other sheet.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/placement.h"

namespace remesh {
namespace {

using detail::CrossingGuard;
using detail::EditedMesh;
using detail::Mobility;

// A step, in mean edge lengths. It is halved where it parts no faces, down to the least.
constexpr double first_step = 0.03, least_step = 0.002;
constexpr int most_steps = 30;
// The other sheet is looked for in these depths, in edge lengths: from a point below the surface
// it is nearer than the vertex, by this share of the depth.
constexpr std::array depths{0.5, 0.125, 1.0 / 32, 1.0 / 128};
constexpr double clearly_nearer = 0.9;
// Cosine of the normals of two sheets, whatever their sides: at least this.
constexpr double least_cosine = 0.5;

class SheetPush {
public:
    SheetPush(EditedMesh& mesh, const Surface& surface, Mobility most, Ticker& ticker)
        : mesh_(mesh),
          most_(most),
          surface_(surface),
          tree_(surface.mesh),
          guard_(mesh),
          ticker_(ticker) {}

    void run(std::vector<Index> faces) {
        double step = first_step;
        for (int i = 0; i < most_steps && step > least_step; ++i) {
            std::erase_if(faces, [&](Index f) { return guard_.face_through(f) == no_index; });
            const EditedMesh::Mark before = mesh_.mark();
            for (const Index v : corners_of(faces)) push(v, step * mesh_.mean_length());
            const std::vector<Index> changed = mesh_.changed_since(before);
            if (changed.empty()) return;
            if (guard_.accepts(changed) && guard_.growth() < 0) {
                guard_.take_over();
                faces.insert(faces.end(), changed.begin(), changed.end());
                faces = distinct(std::move(faces));
            } else {
                mesh_.take_back(before);
                step /= 2;
            }
        }
    }

private:
    [[nodiscard]] std::vector<Index> corners_of(std::span<const Index> faces) const {
        std::vector<Index> corners;
        for (const Index f : faces) {
            const Triangle& t = mesh_.face(f).corner;
            corners.insert(corners.end(), t.begin(), t.end());
        }
        return distinct(std::move(corners));
    }
    void push(Index v, double step) {
        ticker_.tick(100);
        if (mesh_.mobility(v) > most_ || mesh_.is_on_rim(v)) return;
        const auto [away, is_new] = away_.try_emplace(v, Vec3::Zero());
        if (is_new) away->second = find_way(v);
        if (away->second.isZero(0)) return;
        (void)mesh_.put_offset(v, mesh_.offset(v) + step * away->second);
    }
    // A unit vector away from the nearest other sheet; zero if there is none.
    [[nodiscard]] Vec3 find_way(Index v) const {
        const Vec3 at = mesh_.at(v) - mesh_.offset(v);
        Vec3 normal = Vec3::Zero(), way = normal;
        double length = 0;
        for (const Index f : mesh_.faces_at(v)) {
            normal += mesh_.normal_of(f);
            length = std::max(length, detail::longest_edge_of(mesh_.corners_of(f)));
        }
        normal.normalize();
        double least = infinity;
        for (const Vec3& side : {normal, Vec3(-normal)}) {
            for (const double depth : depths) {
                const ClosestPoint nearest = tree_.query(at + depth * length * side);
                if (!(std::sqrt(nearest.distance_sq) < clearly_nearer * depth * length)) continue;
                const Vec3 other =
                    doubled_normal(surface_.mesh.positions,
                                   surface_.mesh.triangles[nearest.point.face.value()])
                        .normalized();
                if (!(std::abs(other.dot(normal)) >= least_cosine)) continue;
                const double gap = (nearest.position - at).norm();
                if (gap < least) way = -side;
                least = std::min(least, gap);
                break;
            }
        }
        return way;
    }

    EditedMesh& mesh_;
    const Mobility most_;  // Of vertices that move.
    const Surface& surface_;
    const ClosestPointTree tree_;
    CrossingGuard<EditedMesh> guard_;
    Ticker& ticker_;
    std::map<Index, Vec3> away_;  // By vertex: see find_way().
};

}  // namespace

bool push_apart(const detail::MeshCurves& curves, std::span<const Mobility> mobility,
                std::span<const std::pair<Index, Index>> pairs, Mobility most, PlacedMesh& mesh,
                const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    EditedMesh edited(curves, mesh, mobility);
    const EditedMesh::Mark start = edited.mark();
    std::vector<Index> faces;
    for (const auto& [f, g] : pairs) faces.insert(faces.end(), {f, g});
    SheetPush(edited, curves.whole(), most, ticker).run(distinct(std::move(faces)));
    for (Index v = 0; v < mesh.offsets.size(); ++v) mesh.offsets[v] = edited.offset(v);
    return edited.mark().faces > start.faces;
}

}  // namespace remesh
