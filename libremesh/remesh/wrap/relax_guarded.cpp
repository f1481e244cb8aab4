// Collapses leave narrow faces. Where these are, vertices move over the surface and edges are
// flipped, as long as the worst face around gets better and no faces intersect.
#include <algorithm>
#include <utility>

#include "agvd/mesh/any_mesh.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/wrap/relax_guarded.h"

namespace remesh::detail {
namespace {

constexpr int most_rounds_of_relaxation = 8;
// Cosine of 30 degrees: faces of some shape turn less, and creases stay where they are.
constexpr double least_turn = 0.8660254037844386, least_shape = 0.3;

class Relaxation {
public:
    Relaxation(GuardedMesh& mesh, const MeshView& surface, const ClosestPointTree& tree,
               std::vector<std::optional<SurfacePoint>>& moved, Ticker ticker)
        : mesh_(mesh),
          surface_(surface),
          tree_(tree),
          moved_(moved),
          ticker_(ticker),
          waits_(mesh->num_vertices(), 1) {}

    // \return whether anything has changed.
    bool run_round() {
        bool is_changed = false;
        for (Index h = 0; h < 3 * mesh_->num_faces(); ++h) {
            ticker_.tick();
            if (!mesh_->face(h / 3).is_there || mesh_->tail(h) > mesh_->head(h)) continue;
            is_changed = flip(h) || is_changed;
        }
        for (Index v = 0; v < mesh_->num_vertices(); ++v) {
            if (std::exchange(waits_[v], 0) != 0 && !mesh_->faces_at(v).empty() && move(v)) {
                is_changed = true;
                reopen(mesh_->faces_at(v));
            }
        }
        return is_changed;
    }

private:
    using Corners = std::array<Vec3, 3>;

    static double shape_of(const Corners& t) { return shape_quality(t[0], t[1], t[2]); }
    static Vec3 normal_of(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }
    static bool turns(const Corners& before, const Corners& after) {
        const Vec3 m = normal_of(before), n = normal_of(after);
        const double least = shape_of(before) < least_shape ? 0 : least_turn;
        return !(m.dot(n) > least * m.norm() * n.norm());
    }

    bool flip(Index h) {
        if (!mesh_->can_flip(h)) return false;
        const Corners f = mesh_->corners_of(h / 3), g = mesh_->corners_of(mesh_->twin(h) / 3);
        const double before = std::min(shape_of(f), shape_of(g));
        if (before > low_quality) return false;
        const Vec3 &a = mesh_->at(mesh_->tail(h)), &b = mesh_->at(mesh_->head(h)),
                   &c = mesh_->at(mesh_->apex(h)), &d = mesh_->at(mesh_->apex(mesh_->twin(h)));
        const Corners lower{c, a, d}, upper{d, b, c};
        if (std::min(shape_of(lower), shape_of(upper)) <= before) return false;
        for (const Corners& made : {lower, upper}) {
            if (turns(f, made) || turns(g, made)) return false;
        }
        if (!mesh_.edit([&](SpaceMesh& mesh) { mesh.flip(h); })) return false;
        reopen(std::array{h / 3, mesh_->twin(h) / 3});
        return true;
    }
    void reopen(std::span<const Index> faces) {
        for (const Index f : faces) {
            for (const Index v : mesh_->face(f).corner) waits_[v] = 1;
        }
    }

    // The worst shape around a vertex at a point; 0 if a face turns.
    [[nodiscard]] double worst_at(Index v, const Vec3& point) const {
        double worst = 1;
        for (const Index f : mesh_->faces_at(v)) {
            const Corners before = mesh_->corners_of(f);
            Corners after = before;
            for (std::size_t k = 0; k < 3; ++k) {
                if (mesh_->face(f).corner[k] == v) after[k] = point;
            }
            worst = std::min(worst, shape_of(after));
            if (!(worst > 0) || turns(before, after)) return 0;
        }
        return worst;
    }

    bool move(Index v) {
        Vec3 normal = Vec3::Zero(), sum = Vec3::Zero();
        double worst = 1, length = 0;
        for (const Index f : mesh_->faces_at(v)) {
            const Corners t = mesh_->corners_of(f);
            normal += normal_of(t);
            worst = std::min(worst, shape_of(t));
            for (std::size_t k = 0; k < 3; ++k) {
                if (mesh_->face(f).corner[k] != v) continue;
                sum += t[(k + 1) % 3];
                length += (t[(k + 1) % 3] - t[k]).norm();
            }
        }
        if (worst > low_quality || normal.isZero(0)) return false;
        const auto degree = static_cast<double>(mesh_->faces_at(v).size());
        const auto try_point = [&](const Vec3& to) {
            ticker_.tick(steps_of_query);
            const ClosestPoint foot = tree_.query(to);
            const Triangle& below = surface_.triangles[foot.point.face.value()];
            if (!(doubled_normal(surface_.positions, below).dot(normal) > 0)) return false;
            const double now = worst_at(v, foot.position);
            if (!(now > worst) || !mesh_.move(v, foot.position)) return false;
            worst = now;
            moved_[v] = foot.point;
            return true;
        };
        if (try_point(sum / degree) && worst > low_quality) return true;
        directions_.clear();
        add_directions(normal, directions_);
        return try_steps(directions_, length / degree,
                         [&](const Vec3& step) { return try_point(mesh_->at(v) + step); });
    }

    static constexpr std::size_t steps_of_query = 64;

    GuardedMesh& mesh_;
    const MeshView surface_;
    const ClosestPointTree& tree_;
    std::vector<std::optional<SurfacePoint>>& moved_;
    Ticker ticker_;
    std::vector<std::uint8_t> waits_;  // By vertex: 1 if a face at it has changed.
    std::vector<Vec3> directions_;
};

}  // namespace

std::vector<std::optional<SurfacePoint>> relax_guarded(GuardedMesh& mesh, const MeshView& surface,
                                                       const Progress& progress) {
    std::vector<std::optional<SurfacePoint>> moved(mesh->num_vertices());
    const ClosestPointTree tree(surface, progress);
    Poller poller(progress);
    Relaxation relaxation(mesh, surface, tree, moved, Ticker(poller));
    for (int round = 0; round < most_rounds_of_relaxation && relaxation.run_round(); ++round) {
    }
    return moved;
}

}  // namespace remesh::detail
