#include "remesh/pipeline/remesh.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/refine.h"
#include "remesh/dual/build_dual.h"
#include "remesh/repair/carry_sites.h"
#include "remesh/repair/closed_ball.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

void check_options(const RemeshOptions& options) {
    if (options.num_samples < 1) {
        throw agvd::InvalidOption("num_samples is 0; ask for at least 1");
    }
    if (options.repair_rounds < 0) {
        throw agvd::InvalidOption("repair_rounds is " + std::to_string(options.repair_rounds) +
                                  "; use 0 or more");
    }
    if (options.relax_steps < 0) {
        throw agvd::InvalidOption("relax_steps is " + std::to_string(options.relax_steps) +
                                  "; use 0 or more");
    }
    if (options.num_threads < 0) {
        throw agvd::InvalidOption("num_threads is " + std::to_string(options.num_threads) +
                                  "; use 0 (all cores) or more");
    }
}

// Longest edge that propagation gets to see, in mean spacings of the sites: the Steiner points of a
// longer one resolve no cell.
constexpr double longest_edge = 1.5;
// Rounds without fewer violations than ever before: adding sites does not help here.
constexpr int max_stalled_rounds = 8;

// Adds the time until it ends to its stage.
class StageTimer {
public:
    StageTimer(Stage stage, RemeshResult& result)
        : stage_(stage), result_(result), start_(std::chrono::steady_clock::now()) {}
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;
    ~StageTimer() {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
        auto found = std::find_if(result_.seconds.begin(), result_.seconds.end(),
                                  [&](const auto& entry) { return entry.first == stage_; });
        if (found != result_.seconds.end()) found->second += spent.count();
    }

private:
    Stage stage_;
    RemeshResult& result_;
    std::chrono::steady_clock::time_point start_;
};

class Pipeline {
public:
    Pipeline(const agvd::MeshView& mesh, const RemeshOptions& options)
        : input_(mesh), options_(options) {
        for (const Stage stage : {Stage::Clean, Stage::Sample, Stage::Relax, Stage::Propagate,
                                  Stage::Diagram, Stage::Dual}) {
            result_.seconds.emplace_back(stage, 0.0);
        }
    }

    RemeshResult run() {
        check_options(options_);
        clean();
        refine();
        place_sites();
        relax();
        build_valid_diagram();
        build_mesh();
        return std::move(result_);
    }

private:
    [[nodiscard]] agvd::Progress progress_of(Stage stage) const {
        if (!options_.progress) return {};
        return [this, stage](double fraction) { return options_.progress(stage, fraction); };
    }

    void clean() {
        const StageTimer timer(Stage::Clean, result_);
        agvd::poll(progress_of(Stage::Clean), 0);
        clean_ = clean_input(input_);
        result_.cleaned = clean_.counts;
        result_.input_topology = analyze_topology(clean_.mesh.view());
        agvd::poll(progress_of(Stage::Clean), 1);
    }

    // Edges that span several cells are split; the surface stays what it is.
    void refine() {
        const StageTimer timer(Stage::Clean, result_);
        double area = 0;
        for (const ComponentTopology& c : result_.input_topology.components) area += c.area;
        const std::size_t num_sites =
            options_.sites ? options_.sites->size() : options_.num_samples;
        const double spacing =
            std::sqrt(area / static_cast<double>(std::max<std::size_t>(num_sites, 1)));
        agvd::RefinedMesh refined =
            agvd::split_long_edges(clean_.mesh.view(), longest_edge * spacing);
        clean_.mesh = std::move(refined.mesh);
        component_.reserve(refined.face_origin.size());
        for (Index& origin : refined.face_origin) {
            component_.push_back(result_.input_topology.face_component[origin]);
            origin = clean_.face_origin[origin];
        }
        clean_.face_origin = std::move(refined.face_origin);
        result_.refined_faces = static_cast<Index>(clean_.mesh.triangles.size());
        surface_ = agvd::build_surface(clean_.mesh.view());
        if (options_.engine != agvd::Engine::Steiner || options_.relax_steps > 0) {
            layout_.emplace(surface_, options_.num_threads);
        }
    }

    void place_sites() {
        const StageTimer timer(Stage::Sample, result_);
        if (options_.sites) {
            sites_ = to_cleaned(*options_.sites, input_, clean_);
        } else if (!is_coarse_to_fine()) {
            sites_ = sample_sites(surface_, sampling());
        }
    }
    [[nodiscard]] SamplingOptions sampling() const {
        return {.num_samples = options_.num_samples,
                .init = options_.init,
                .seed = options_.seed,
                .num_threads = options_.num_threads,
                .progress = progress_of(Stage::Sample)};
    }
    // Relaxation samples by itself.
    [[nodiscard]] bool is_coarse_to_fine() const {
        return !options_.sites && options_.init == Init::BlueNoise && options_.relax_steps > 0;
    }

    void relax() {
        const bool keeps = options_.sites && options_.keep_sites;
        if (options_.relax_steps == 0 || keeps) return;
        const StageTimer timer(Stage::Relax, result_);
        const RelaxOptions relax{.steps = options_.relax_steps,
                                 .num_threads = options_.num_threads,
                                 .progress = progress_of(Stage::Relax)};
        RelaxResult relaxed = is_coarse_to_fine()
                                  ? sample_relaxed_sites(surface_, *layout_, sampling(), relax)
                                  : relax_sites(surface_, *layout_, std::move(sites_), relax);
        sites_ = std::move(relaxed.sites);
        result_.relaxation = std::move(relaxed.levels);
    }

    // Propagates and checks the closed-ball property, adding sites until it holds.
    void build_valid_diagram() {
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        int stalled_rounds = 0;
        while (true) {
            build_diagram();
            std::vector<ClosedBallViolation> violations = find_missing_sites();
            if (violations.empty()) violations = find_closed_ball_violations(surface_, diagram_);
            if (violations.empty()) return;
            stalled_rounds = violations.size() < fewest ? 0 : stalled_rounds + 1;
            fewest = std::min(fewest, violations.size());
            if (result_.repair_rounds == options_.repair_rounds ||
                stalled_rounds == max_stalled_rounds) {
                give_up(violations);
            }
            ++result_.repair_rounds;
            add_sites(violations);
        }
    }

    void build_diagram() {
        agvd::Propagation propagation;
        {
            const StageTimer timer(Stage::Propagate, result_);
            const agvd::PropagationOptions options{.engine = options_.engine,
                                                   .max_error = options_.max_error,
                                                   .steiner_points = options_.steiner_points,
                                                   .lambda = options_.lambda,
                                                   .num_threads = options_.num_threads,
                                                   .progress = progress_of(Stage::Propagate)};
            propagation = layout_ ? agvd::propagate(surface_, *layout_, sites_, options)
                                  : agvd::propagate(surface_, sites_, options);
            result_.certified_error = propagation.certified_error;
            result_.propagation_bytes = propagation.peak_bytes;
        }
        const StageTimer timer(Stage::Diagram, result_);
        diagram_ = agvd::build_diagram(
            surface_, sites_, propagation,
            {.num_threads = options_.num_threads, .progress = progress_of(Stage::Diagram)});
    }

    // Components that no given site reaches.
    [[nodiscard]] std::vector<ClosedBallViolation> find_missing_sites() const {
        std::vector<ClosedBallViolation> missing;
        std::vector<bool> is_told(result_.input_topology.components.size(), false);
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const Index component = component_[f];
            const Index v = clean_.mesh.triangles[f][0];
            if (diagram_.nearest_site[v].is_valid() || is_told[component]) continue;
            is_told[component] = true;
            missing.push_back({{}, {}, "a component has no site", {agvd::FaceId(f), {1, 0, 0}}});
        }
        return missing;
    }

    // One site for each violation whose cells and place no other new site of this round concerns.
    void add_sites(const std::vector<ClosedBallViolation>& violations) {
        std::vector<bool> is_concerned(sites_.size(), false);
        const std::size_t first_new = sites_.size();
        for (const ClosedBallViolation& violation : violations) {
            const Vec3 place = position(clean_.mesh.view(), violation.remedy);
            bool is_free = std::none_of(
                sites_.begin() + static_cast<std::ptrdiff_t>(first_new), sites_.end(),
                [&](const SurfacePoint& s) { return position(clean_.mesh.view(), s) == place; });
            for (const agvd::SiteId site : {violation.site, violation.other}) {
                if (!site.is_valid()) continue;
                is_free = is_free && !is_concerned[site.value()];
                is_concerned[site.value()] = true;
            }
            if (!is_free) continue;
            sites_.push_back(violation.remedy);
            ++result_.sites_added;
        }
    }

    [[noreturn]] void give_up(const std::vector<ClosedBallViolation>& violations) const {
        constexpr std::size_t max_named = 5;
        std::string text = "the topology was not reached in " +
                           std::to_string(result_.repair_rounds) + " rounds of adding sites";
        for (std::size_t i = 0; i < std::min(max_named, violations.size()); ++i) {
            const ClosedBallViolation& v = violations[i];
            text += i == 0 ? ": " : "; ";
            if (v.site.is_valid()) text += "cell " + std::to_string(v.site.value()) + " ";
            text += v.reason;
            if (v.other.is_valid()) text += " cell " + std::to_string(v.other.value());
        }
        if (violations.size() > max_named) {
            text += "; and " + std::to_string(violations.size() - max_named) + " more";
        }
        throw agvd::ConstraintUnmet(text + "; ask for more samples, for example " +
                                    std::to_string(2 * sites_.size()));
    }

    void build_mesh() {
        const StageTimer timer(Stage::Dual, result_);
        agvd::poll(progress_of(Stage::Dual), 0);
        result_.mesh.triangles = build_dual(surface_, diagram_);
        std::vector<Index> new_index(sites_.size(), agvd::no_index);
        for (const agvd::Triangle& t : result_.mesh.triangles) {
            for (const Index s : t) new_index[s] = 0;
        }
        std::vector<SurfacePoint> kept;
        for (Index s = 0; s < sites_.size(); ++s) {
            if (new_index[s] == agvd::no_index) continue;
            new_index[s] = static_cast<Index>(kept.size());
            kept.push_back(sites_[s]);
            result_.mesh.positions.push_back(position(clean_.mesh.view(), sites_[s]));
        }
        for (agvd::Triangle& t : result_.mesh.triangles) {
            for (Index& s : t) s = new_index[s];
        }
        result_.sites_dropped = static_cast<Index>(sites_.size() - kept.size());
        result_.sites = to_original(kept, input_, clean_);
        check_mesh();
        agvd::poll(progress_of(Stage::Dual), 1);
    }

    // The closed-ball property implies this; nothing leaves unchecked all the same.
    void check_mesh() const {
        const Topology topology = analyze_topology(result_.mesh.view());
        if (!topology.is_manifold || !topology.is_oriented ||
            !same_topology(topology, result_.input_topology)) {
            throw agvd::ConstraintUnmet(
                "the dual of these sites is no manifold of the input's topology; ask for more "
                "samples, for example " +
                std::to_string(2 * sites_.size()));
        }
    }

    agvd::MeshView input_;
    const RemeshOptions& options_;
    RemeshResult result_;
    CleanResult clean_;             // Cleaned, then refined.
    std::vector<Index> component_;  // #F of it.
    Surface surface_;
    std::optional<agvd::SurfaceLayout> layout_;
    std::vector<SurfacePoint> sites_;
    agvd::Diagram diagram_;
};

}  // namespace

const char* stage_name(Stage stage) {
    switch (stage) {
        case Stage::Clean:
            return "clean";
        case Stage::Sample:
            return "sample";
        case Stage::Relax:
            return "relax";
        case Stage::Propagate:
            return "propagate";
        case Stage::Diagram:
            return "diagram";
        case Stage::Dual:
            return "dual";
    }
    return "unknown";
}

RemeshResult remesh(const agvd::MeshView& mesh, const RemeshOptions& options) {
    return Pipeline(mesh, options).run();
}

}  // namespace remesh
