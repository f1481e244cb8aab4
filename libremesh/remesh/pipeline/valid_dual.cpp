// Each round propagates, builds the diagram, finds cells that break the closed-ball property
// ([edelsbrunner1997]) or miss the boundary, and moves or adds sites there. A component whose
// faults do not decrease is given up and simplified to its first sites ([liu2023]).
#include "remesh/pipeline/valid_dual.h"

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

#include "agvd/core/random.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/dual/closed_ball.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {
namespace {

// A component is given up after so many rounds in a row without a new minimum of its faults.
constexpr int max_stalled_rounds = 3;
// A component is given up at once if more cells than this meet the boundary twice in its first
// diagram: it has strips far narrower than the spacing, and many rounds would leave some such
// cells.
constexpr std::size_t most_in_strips = 64;
// Components with faults are given up once there are max_growth times the first sites and
// always_allowed more, which the topology may need where sites are few.
constexpr std::size_t max_growth = 2;
constexpr std::size_t always_allowed = 300;

class ValidDualBuilder {
public:
    ValidDualBuilder(const Domain& domain, const PlacedSites& placed,
                     std::optional<SurfaceLayout>& layout, std::vector<SurfacePoint>& sites,
                     std::vector<bool>& is_simplified, const StageContext& context)
        : domain_(domain),
          placed_(placed),
          layout_(layout),
          surface_(domain.base()),
          components_(domain.parts->components),
          options_(context.options),
          result_(context.result),
          sites_(sites),
          given_(sites),
          faults_(components_.size()),
          has_failed_(is_simplified) {
        has_failed_.resize(components_.size(), false);
    }

    ValidDual run() {
        repair_sites();
        result_.sites_added += static_cast<Index>(reasons_.size());
        for (const SiteReason reason : reasons_) ++result_.added_because[reason];
        const StageClock clock(Stage::Dual, result_);
        poll(progress_of(Stage::Dual, options_), 0);
        build_mesh();
        poll(progress_of(Stage::Dual, options_), 1);
        return std::move(dual_);
    }

private:
    using Violations = std::vector<ClosedBallViolation>;

    // What is wrong in one component.
    struct Faults {
        std::size_t count = 0;
        std::size_t in_strips = 0;
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        int stalled_rounds = 0;
        bool gave_up = false;  // It is to be simplified.
    };

    void repair_sites() {
        const std::size_t most_sites = max_growth * given_.size() + always_allowed;
        const int most_rounds = domain_.plan ? 0 : options_.repair_rounds;
        for (bool is_first = true;; is_first = false) {
            build_diagram();
            BoundaryFixes fixes;
            if (options_.boundary == Boundary::Keep && !domain_.plan) {
                fixes =
                    find_boundary_fixes(surface_, dual_.diagram, sites_, placed_.boundary_corners);
            }
            Violations violations = find_violations();
            move_empty_sites(fixes);
            leave_failed_components(fixes, violations);
            if (is_first) find_narrow_points(violations);
            count_faults(fixes, violations);
            give_up(result_.repair_rounds >= most_rounds || sites_.size() >= most_sites);
            leave_failed_components(fixes, violations);
            if (violations.empty() && fixes.moved.empty() && fixes.added.empty()) {
                if (reset_given_up()) build_diagram();
                return;
            }
            ++result_.repair_rounds;
            apply(fixes, violations);
        }
    }

    void find_narrow_points(const Violations& violations) {
        for (const ClosedBallViolation& v : violations) {
            if (v.is_at_boundary || !v.site.is_valid()) continue;
            dual_.narrow_points.push_back(sites_[v.site.value()]);
        }
    }

    void count_faults(const BoundaryFixes& fixes, const Violations& violations) {
        for (Faults& faults : faults_) faults.count = faults.in_strips = 0;
        for (const ClosedBallViolation& v : violations) {
            Faults& faults = faults_[component_of(v)];
            ++faults.count;
            if (v.is_at_boundary) ++faults.in_strips;
        }
        for (const auto& [site, point] : fixes.moved) ++faults_[component_of(point)].count;
        for (const SurfacePoint& point : fixes.added) ++faults_[component_of(point)].count;
    }

    // Marks components as failed whose faults have not decreased for too many rounds, and after the
    // last round all components with faults.
    void give_up(bool is_last) {
        for (Index c = 0; c < faults_.size(); ++c) {
            Faults& faults = faults_[c];
            const bool is_first = faults.fewest == std::numeric_limits<std::size_t>::max();
            const bool has_strips = is_first && faults.in_strips > most_in_strips;
            faults.stalled_rounds = faults.count < faults.fewest ? 0 : faults.stalled_rounds + 1;
            faults.fewest = std::min(faults.fewest, faults.count);
            if (faults.count > 0 &&
                (is_last || has_strips || faults.stalled_rounds >= max_stalled_rounds)) {
                has_failed_[c] = faults.gave_up = true;
            }
        }
    }

    // Removes the fixes and violations of failed components: these are simplified.
    void leave_failed_components(BoundaryFixes& fixes, Violations& violations) const {
        const auto has_failed = [&](const auto& point) { return has_failed_[component_of(point)]; };
        std::erase_if(violations, has_failed);
        std::erase_if(fixes.moved, [&](const auto& move) { return has_failed(move.second); });
        std::erase_if(fixes.added, has_failed);
    }

    [[nodiscard]] Propagation propagate() const {
        PropagationOptions options = options_.propagation;
        options.num_threads = options_.num_threads;
        options.progress = progress_of(Stage::Propagate, options_);
        if (!layout_) return agvd::propagate(surface_, sites_, options);
        SurfaceLayout layout = *std::move(layout_);
        layout_.reset();
        return agvd::propagate(surface_, std::move(layout), sites_, options);
    }

    void build_diagram() {
        dual_.diagram = {};  // Frees it before the next one is built.
        Propagation propagation;
        {
            const StageClock clock(Stage::Propagate, result_);
            propagation = propagate();
            result_.certified_error = propagation.certified_error;
            result_.propagation_bytes = propagation.peak_bytes;
        }
        const StageClock clock(Stage::Diagram, result_);
        dual_.diagram = agvd::build_diagram(surface_, sites_, std::move(propagation),
                                            {.num_threads = options_.num_threads,
                                             .progress = progress_of(Stage::Diagram, options_)});
    }

    [[nodiscard]] Violations find_violations() const {
        Violations missing;  // Components that no site reaches.
        std::vector<bool> is_told = has_failed_;
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const Index component = domain_.component[f];
            const Index v = surface_.mesh.triangles[f][0];
            if (dual_.diagram.nearest_site[v].is_valid() || is_told[component]) continue;
            is_told[component] = true;
            missing.push_back({{}, {}, SiteReason::NoSite, {{FaceId(f), {1, 0, 0}}}});
        }
        if (!missing.empty()) return missing;
        return find_closed_ball_violations(surface_, dual_.diagram,
                                           progress_of(Stage::Dual, options_));
    }

    // Moves sampled sites that own nothing, as many as the count needs, to the farthest Voronoi
    // vertices of the largest cells. The dual drops given sites that own nothing.
    void move_empty_sites(BoundaryFixes& fixes) const {
        if (options_.sites) return;
        std::vector<Index> empty;
        for (Index s = 0; s < sites_.size(); ++s) {
            if (!(dual_.diagram.cell_area[s] > 0)) empty.push_back(s);
        }
        const std::size_t num_owning = sites_.size() - empty.size();
        if (empty.empty() || num_owning >= options_.num_samples) return;
        const std::vector<Index> points = points_in_largest_cells(
            dual_.diagram, std::min(empty.size(), options_.num_samples - num_owning));
        for (std::size_t i = 0; i < points.size(); ++i) {
            fixes.moved.emplace_back(empty[i], dual_.diagram.vertices[points[i]]);
        }
    }

    // Moves sites, and adds the sites of each violation whose cells no other change of this round
    // concerns.
    void apply(const BoundaryFixes& fixes, const Violations& violations) {
        std::vector<bool> is_concerned(sites_.size(), false);
        for (const auto& [site, point] : fixes.moved) {
            sites_[site] = point;
            is_concerned[site] = true;
        }
        result_.sites_moved += static_cast<Index>(fixes.moved.size());
        new_positions_.clear();
        for (const SurfacePoint& point : fixes.added) add(point, SiteReason::BoundaryCorner);
        for (const ClosedBallViolation& violation : violations) {
            bool is_free = true;
            for (const SiteId site : {violation.site, violation.other}) {
                if (!site.is_valid()) continue;
                is_free = is_free && !is_concerned[site.value()];
                is_concerned[site.value()] = true;
            }
            if (!is_free) continue;
            for (const SurfacePoint& point : violation.remedies) add(point, violation.reason);
        }
    }

    void add(const SurfacePoint& point, SiteReason reason) {
        if (!new_positions_.insert(position(surface_.mesh.view(), point)).second) return;
        sites_.push_back(point);
        reasons_.push_back(reason);
    }

    // In components that were given up: moves sites back, drops added sites, and gives the corners
    // of the boundary a site. False if that changes nothing.
    bool reset_given_up() {
        const auto gave_up = [&](const SurfacePoint& site) {
            return faults_[component_of(site)].gave_up;
        };
        bool is_changed = false;
        for (Index s = 0; s < given_.size(); ++s) {
            if (!gave_up(given_[s]) || !gave_up(sites_[s])) continue;
            is_changed = is_changed || key_of(surface_, sites_[s]) != key_of(surface_, given_[s]);
            sites_[s] = given_[s];
        }
        std::size_t num_left = given_.size();
        for (std::size_t s = given_.size(); s < sites_.size(); ++s) {
            const SiteReason reason = reasons_[s - given_.size()];
            if (gave_up(sites_[s])) continue;
            sites_[num_left] = sites_[s];
            reasons_[num_left++ - given_.size()] = reason;
        }
        is_changed = is_changed || num_left < sites_.size();
        sites_.resize(num_left);
        reasons_.resize(num_left - given_.size());
        return add_corners() || is_changed;
    }

    bool add_corners() {
        std::vector<bool> has_site(surface_.num_vertices(), false);
        for (const SurfacePoint& site : sites_) {
            if (const auto v = vertex_of(surface_, site)) has_site[*v] = true;
        }
        new_positions_.clear();
        for (const Index v : placed_.boundary_corners) {
            const SurfacePoint corner = point_at(surface_, v);
            if (has_site[v] || !faults_[component_of(corner)].gave_up) continue;
            add(corner, SiteReason::BoundaryCorner);
        }
        return !new_positions_.empty();
    }

    [[nodiscard]] Index component_of(const SurfacePoint& point) const {
        return domain_.component[point.face.value()];
    }
    [[nodiscard]] Index component_of(const ClosedBallViolation& violation) const {
        return component_of(violation.site.is_valid() ? sites_[violation.site.value()]
                                                      : violation.remedies.front());
    }

    // Vertices in the order of their sites, then those of simplified components.
    void build_mesh() {
        const std::vector<std::vector<Triangle>> triangles = triangles_of_components();
        std::vector<bool> has_vertex(sites_.size(), false);
        for (Index c = 0; c < triangles.size(); ++c) {
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
            dual_.points.push_back(sites_[s]);
        }
        const auto num_failed = std::count(has_failed_.begin(), has_failed_.end(), true);
        result_.components_simplified = static_cast<Index>(num_failed);
        // By component that is to be simplified: faces, ascending, and sites, one at each position.
        std::vector<std::vector<Index>> faces(components_.size()), sites(components_.size());
        if (num_failed > 0) find_parts(faces, sites);
        for (Index c = 0; c < triangles.size(); ++c) {
            if (has_failed_[c]) {
                append_simplified(faces[c], sites[c]);
                continue;
            }
            for (const auto& [i, j, k] : triangles[c]) {
                dual_.triangles.push_back({number[i], number[j], number[k]});
            }
        }
    }

    // Of sites. Marks components as failed whose triangles have another topology or boundary.
    std::vector<std::vector<Triangle>> triangles_of_components() {
        std::vector<std::vector<Triangle>> triangles(components_.size());
        const auto part_of = [&](Index site) { return component_of(sites_[site]); };
        for (const Triangle& t :
             build_dual(surface_, dual_.diagram, progress_at(Stage::Dual, options_, 0))) {
            triangles[part_of(t[0])].push_back(t);
        }
        const auto chain =
            chain_by_part(placed_.chain, static_cast<Index>(components_.size()), part_of);
        for (Index c = 0; c < triangles.size(); ++c) {
            if (!chain[c].empty()) close_rim(chain[c], triangles[c]);
            has_failed_[c] = has_failed_[c] || !has_right_topology(triangles[c], components_[c]) ||
                             (!placed_.chain.empty() && rim_of(triangles[c]) != chain[c]);
        }
        return triangles;
    }

    // False for polygons of the dual without a valid diagonal.
    [[nodiscard]] bool has_right_topology(std::span<const Triangle> triangles,
                                          const ComponentTopology& wanted) const {
        std::vector<Index> used;
        for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        TriangleMesh mesh{{}, {triangles.begin(), triangles.end()}};
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

    void find_parts(std::vector<std::vector<Index>>& faces,
                    std::vector<std::vector<Index>>& sites) const {
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const Index component = domain_.component[f];
            if (has_failed_[component]) faces[component].push_back(f);
        }
        for (const Index s : distinct_points(surface_, sites_)) {
            const Index component = component_of(sites_[s]);
            if (has_failed_[component]) sites[component].push_back(s);
        }
    }

    // Appends a component, simplified to its sites and the extra vertices that must stay.
    void append_simplified(std::span<const Index> faces, std::span<const Index> sites) {
        const auto first = static_cast<Index>(dual_.points.size());
        std::vector<SurfacePoint> points = take(sites_, sites);
        dual_.site.insert(dual_.site.end(), sites.begin(), sites.end());
        SimplifiedMesh part = placed_.chain.empty() ? simplify(surface_, faces, points)
                                                    : simplify_patch(surface_, faces, points);
        if (domain_.has_locked()) free_rim(surface_, points, part);
        points.insert(points.end(), part.extra.begin(), part.extra.end());
        dual_.points.insert(dual_.points.end(), points.begin(), points.end());
        dual_.site.resize(dual_.points.size(), no_index);
        for (const auto& [i, j, k] : part.triangles) {
            dual_.triangles.push_back({i + first, j + first, k + first});
        }
    }

    const Domain& domain_;
    const PlacedSites& placed_;
    std::optional<SurfaceLayout>& layout_;
    const Surface& surface_;  // On which cells lie.
    const std::vector<ComponentTopology>& components_;
    const RemeshOptions& options_;
    RemeshResult& result_;
    std::vector<SurfacePoint>& sites_;
    const std::vector<SurfacePoint> given_;                 // The sites before repair.
    std::vector<SiteReason> reasons_;                       // Of the added sites.
    std::vector<Faults> faults_;                            // By component.
    std::vector<bool>& has_failed_;                         // By component.
    std::unordered_set<Vec3, PositionHash> new_positions_;  // Of sites added in this round.
    ValidDual dual_;
};

}  // namespace

ValidDual build_valid_dual(const Domain& domain, const PlacedSites& placed,
                           std::optional<SurfaceLayout>& layout, std::vector<SurfacePoint>& sites,
                           std::vector<bool>& is_simplified, const StageContext& context) {
    return ValidDualBuilder(domain, placed, layout, sites, is_simplified, context).run();
}

}  // namespace remesh::detail
