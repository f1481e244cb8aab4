#include "remesh/pipeline/valid_dual.h"

#include <algorithm>
#include <limits>

#include "remesh/dual/build_dual.h"
#include "remesh/pipeline/stage_clock.h"
#include "remesh/quality/topology.h"
#include "remesh/repair/boundary_cells.h"
#include "remesh/repair/closed_ball.h"
#include "remesh/repair/farthest_corner.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Triangle;
using agvd::Vec3;

// Rounds without fewer violations than ever before: adding sites does not help here.
constexpr int max_stalled_rounds = 3;
// Sites may grow to this many times the first ones, and what topology may need of a few, before a
// component's own faces are the better start.
constexpr std::size_t max_growth = 2;
constexpr std::size_t always_allowed = 300;

class ValidDualBuilder {
public:
    ValidDualBuilder(const Ground& ground, std::vector<SurfacePoint>& sites,
                     const RemeshOptions& options, RemeshResult& result)
        : ground_(ground),
          surface_(ground.surface),
          sites_(sites),
          options_(options),
          result_(result),
          most_sites_(max_growth * sites.size() + always_allowed),
          has_failed_(ground.components.size(), false) {}

    ValidDual run() {
        mend_sites();
        const StageClock clock(Stage::Dual, result_);
        agvd::poll(progress_of(Stage::Dual, options_), 0);
        build_mesh();
        agvd::poll(progress_of(Stage::Dual, options_), 1);
        return std::move(dual_);
    }

private:
    void mend_sites() {
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        int stalled_rounds = 0;
        while (true) {
            build_diagram();
            BoundaryFixes fixes;
            if (options_.boundary == Boundary::Keep) {
                fixes = find_boundary_fixes(surface_, dual_.diagram, sites_, ground_.corners);
            }
            std::vector<ClosedBallViolation> violations = find_violations();
            move_empty_sites(fixes);
            const std::size_t num_faults =
                violations.size() + fixes.moved.size() + fixes.added.size();
            if (num_faults == 0) return;
            stalled_rounds = num_faults < fewest ? 0 : stalled_rounds + 1;
            fewest = std::min(fewest, num_faults);
            if (result_.repair_rounds >= options_.repair_rounds ||
                stalled_rounds == max_stalled_rounds || sites_.size() >= most_sites_) {
                name_failed_components(fixes, violations);
                return;
            }
            ++result_.repair_rounds;
            apply(fixes, violations);
        }
    }

    void build_diagram() {
        agvd::Propagation propagation;
        {
            const StageClock clock(Stage::Propagate, result_);
            propagation = agvd::propagate(surface_, ground_.layout, sites_,
                                          {.engine = options_.engine,
                                           .max_error = options_.max_error,
                                           .steiner_points = options_.steiner_points,
                                           .lambda = options_.lambda,
                                           .num_threads = options_.num_threads,
                                           .progress = progress_of(Stage::Propagate, options_)});
            result_.certified_error = propagation.certified_error;
            result_.propagation_bytes = propagation.peak_bytes;
        }
        const StageClock clock(Stage::Diagram, result_);
        dual_.diagram = agvd::build_diagram(surface_, sites_, propagation,
                                            {.num_threads = options_.num_threads,
                                             .progress = progress_of(Stage::Diagram, options_)});
    }

    [[nodiscard]] std::vector<ClosedBallViolation> find_violations() const {
        std::vector<ClosedBallViolation> found = find_missing_sites();
        if (found.empty()) {
            found = find_closed_ball_violations(surface_, dual_.diagram,
                                                progress_of(Stage::Dual, options_));
        }
        return found;
    }

    // Components that no site reaches.
    [[nodiscard]] std::vector<ClosedBallViolation> find_missing_sites() const {
        std::vector<ClosedBallViolation> missing;
        std::vector<bool> is_told(ground_.components.size(), false);
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const Index component = ground_.component[f];
            const Index v = surface_.mesh.triangles[f][0];
            if (dual_.diagram.nearest_site[v].is_valid() || is_told[component]) continue;
            is_told[component] = true;
            missing.push_back({{}, {}, "no site on a component", {{agvd::FaceId(f), {1, 0, 0}}}});
        }
        return missing;
    }

    // Sampled sites that own nothing, as far as the count needs them, go where large cells reach
    // farthest. Given ones are dropped by the dual.
    void move_empty_sites(BoundaryFixes& fixes) const {
        if (options_.sites) return;
        const std::vector<double>& area = dual_.diagram.cell_area;
        std::vector<Index> empty, owning;
        for (Index s = 0; s < sites_.size(); ++s) (area[s] > 0 ? owning : empty).push_back(s);
        if (owning.size() >= options_.num_samples) return;
        empty.resize(std::min<std::size_t>(empty.size(), options_.num_samples - owning.size()));
        std::stable_sort(owning.begin(), owning.end(),
                         [&](Index a, Index b) { return area[a] > area[b]; });
        const std::vector<Index> corner = farthest_corners(dual_.diagram);
        std::erase_if(owning, [&](Index s) { return corner[s] == no_index; });
        for (std::size_t i = 0; i < std::min(empty.size(), owning.size()); ++i) {
            fixes.moved.emplace_back(empty[i], dual_.diagram.vertices[corner[owning[i]]]);
        }
    }

    // Moves, and new sites for each violation whose cells no other change of this round concerns.
    void apply(const BoundaryFixes& fixes, const std::vector<ClosedBallViolation>& violations) {
        std::vector<bool> is_concerned(sites_.size(), false);
        for (const auto& [site, place] : fixes.moved) {
            sites_[site] = place;
            is_concerned[site] = true;
        }
        result_.sites_moved += static_cast<Index>(fixes.moved.size());
        first_new_ = sites_.size();
        for (const SurfacePoint& place : fixes.added) add(place, "a corner of the boundary");
        for (const ClosedBallViolation& violation : violations) {
            bool is_free = true;
            for (const agvd::SiteId site : {violation.site, violation.other}) {
                if (!site.is_valid()) continue;
                is_free = is_free && !is_concerned[site.value()];
                is_concerned[site.value()] = true;
            }
            if (!is_free) continue;
            for (const SurfacePoint& place : violation.remedies) add(place, violation.reason);
        }
    }

    void add(const SurfacePoint& place, const char* reason) {
        const agvd::MeshView mesh = surface_.mesh.view();
        const Vec3 where = position(mesh, place);
        const bool is_there =
            std::any_of(sites_.begin() + static_cast<std::ptrdiff_t>(first_new_), sites_.end(),
                        [&](const SurfacePoint& site) { return position(mesh, site) == where; });
        if (is_there) return;
        sites_.push_back(place);
        ++result_.sites_added;
        ++result_.added_because[reason];
    }

    [[nodiscard]] Index component_of(const SurfacePoint& point) const {
        return ground_.component[point.face.value()];
    }

    void name_failed_components(const BoundaryFixes& fixes,
                                const std::vector<ClosedBallViolation>& violations) {
        for (const ClosedBallViolation& v : violations) {
            for (const SurfacePoint& place : v.remedies) has_failed_[component_of(place)] = true;
        }
        for (const auto& [site, place] : fixes.moved) has_failed_[component_of(place)] = true;
        for (const SurfacePoint& place : fixes.added) has_failed_[component_of(place)] = true;
    }

    // Vertices in the order of their sites, then those of components from faces.
    void build_mesh() {
        std::vector<std::vector<Triangle>> triangles(ground_.components.size());
        const agvd::Progress progress = progress_of(Stage::Dual, options_);
        for (const Triangle& t :
             build_dual(surface_, dual_.diagram, agvd::within(progress, 0, 0))) {
            triangles[component_of(sites_[t[0]])].push_back(t);
        }
        std::vector<bool> has_vertex(sites_.size(), false);
        for (Index c = 0; c < triangles.size(); ++c) {
            has_failed_[c] =
                has_failed_[c] || !has_right_topology(triangles[c], ground_.components[c]);
            if (has_failed_[c]) continue;
            for (const Triangle& t : triangles[c]) {
                for (const Index site : t) has_vertex[site] = true;
            }
        }
        std::vector<Index> number(sites_.size(), no_index);
        for (Index s = 0; s < sites_.size(); ++s) {
            if (!has_vertex[s]) continue;
            number[s] = static_cast<Index>(dual_.site.size());
            dual_.site.push_back(s);
            dual_.mesh.points.push_back(sites_[s]);
        }
        for (Index c = 0; c < triangles.size(); ++c) {
            if (has_failed_[c]) {
                append_own_faces(c);
                continue;
            }
            for (const auto& [i, j, k] : triangles[c]) {
                dual_.mesh.triangles.push_back({number[i], number[j], number[k]});
            }
        }
    }

    // The closed-ball property implies it, but for polygons of the dual that leave no diagonal.
    [[nodiscard]] bool has_right_topology(std::span<const Triangle> triangles,
                                          const ComponentTopology& wanted) const {
        std::vector<Index> used;
        for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        agvd::TriangleMesh mesh{{}, {triangles.begin(), triangles.end()}};
        for (const Index site : used) {
            mesh.positions.push_back(position(surface_.mesh.view(), sites_[site]));
        }
        for (Triangle& t : mesh.triangles) {
            for (Index& v : t) {
                v = static_cast<Index>(std::lower_bound(used.begin(), used.end(), v) -
                                       used.begin());
            }
        }
        const Topology topology = analyze_topology(mesh.view());
        return topology.is_manifold && topology.is_oriented && topology.components.size() == 1 &&
               topology.components[0].same_type(wanted);
    }

    // With as many vertices as the component has sites, or more.
    void append_own_faces(Index component) {
        std::vector<Index> faces;
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            if (ground_.component[f] == component) faces.push_back(f);
        }
        const auto num_sites = std::count_if(
            sites_.begin(), sites_.end(),
            [&](const SurfacePoint& site) { return component_of(site) == component; });
        const SurfaceMesh part = component_mesh(surface_, faces, static_cast<Index>(num_sites),
                                                progress_of(Stage::Dual, options_));
        const auto first = static_cast<Index>(dual_.mesh.points.size());
        dual_.mesh.points.insert(dual_.mesh.points.end(), part.points.begin(), part.points.end());
        dual_.site.resize(dual_.mesh.points.size(), no_index);
        for (const auto& [i, j, k] : part.triangles) {
            dual_.mesh.triangles.push_back({i + first, j + first, k + first});
        }
        ++result_.components_from_faces;
    }

    const Ground& ground_;
    const Surface& surface_;
    std::vector<SurfacePoint>& sites_;
    const RemeshOptions& options_;
    RemeshResult& result_;
    const std::size_t most_sites_;
    std::size_t first_new_ = 0;     // Of this round.
    std::vector<bool> has_failed_;  // By component.
    ValidDual dual_;
};

}  // namespace

ValidDual build_valid_dual(const Ground& ground, std::vector<SurfacePoint>& sites,
                           const RemeshOptions& options, RemeshResult& result) {
    return ValidDualBuilder(ground, sites, options, result).run();
}

}  // namespace remesh::detail
