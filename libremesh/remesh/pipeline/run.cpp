#include "remesh/pipeline/run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "agvd/core/poller.h"
#include "agvd/mesh/distinct_points.h"
#include "agvd/mesh/point_faces.h"
#include "remesh/clean/carry_edges.h"
#include "remesh/clean/carry_sites.h"
#include "remesh/clean/drop_components.h"
#include "remesh/features/close_rim.h"
#include "remesh/features/glue.h"
#include "remesh/features/weld_sheets.h"
#include "remesh/guarantee/farthest_corner.h"
#include "remesh/pipeline/stage_clock.h"
#include "remesh/pipeline/valid_dual.h"
#include "remesh/placement/fit_curves.h"
#include "remesh/placement/fit_vertices.h"
#include "remesh/placement/improve_shape.h"
#include "remesh/placement/mend_shape.h"
#include "remesh/quality/self_intersections.h"
#include "remesh/relax/relax_network.h"
#include "remesh/sampling/boundary_curves.h"
#include "remesh/sampling/given_network.h"
#include "remesh/sampling/minimum_samples.h"
#include "remesh/simplify/reduce_vertices.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

// Creases are looked for at the spacing of so many sites where there are fewer: small parts are to
// keep theirs, and what the sites are too few for is told.
constexpr std::size_t least_scale = 300;
// Of the spacing: lengths not above this are rounding.
constexpr double rounding = 1e-10;
// In spacings. Shorter ones are specks on a scan: cells would have to wind around them, and five of
// them on nefertiti cost .013 of the mean quality.
constexpr double least_junction = 2;
// In spacings: given sites this near to a curve go onto it where they are relaxed. Vertices of an
// earlier result, which were fitted, stand up to .05 off.
constexpr double on_curve = 0.1;
// Rounds of putting vertices back onto the surface there.
constexpr int max_unfits = 4;
// Rounds of mending thinned components with fewer vertices that may move.
constexpr int max_mended = 2;

using CrossingFaces = std::optional<std::vector<std::pair<Index, Index>>>;

class Pipeline {
public:
    Pipeline(const agvd::MeshView& mesh, agvd::TriangleMesh* owned, const RemeshOptions& options,
             int most_mends, const KeptCurves& kept)
        : input_(mesh),
          owned_input_(owned),
          options_(options),
          most_mends_(most_mends),
          kept_(kept) {
        for (const Stage stage :
             {Stage::Clean, Stage::Sample, Stage::Relax, Stage::Propagate, Stage::Diagram,
              Stage::Dual, Stage::Delaunay, Stage::Place, Stage::Check}) {
            result_.seconds.emplace_back(stage, 0.0);
        }
    }

    RemeshResult run() {
        try {
            clean();
            triangulate();
            place_sites();
            relax();
            drop_duplicates();
            build_mesh();
            mend_thinned();
            check_mesh();
        } catch (const TooFewSamples&) {
            give_input_back();
            throw;
        } catch (const NetworkFailed&) {
            give_input_back();
            throw;
        }
        if (plan_) give_input_back();
        if (!clean_.face_origin.empty()) clean_.mesh = surface().mesh;
        result_.sites = to_original(result_.sites, input_, clean_);
        return std::move(result_);
    }

private:
    void clean() {
        const StageClock clock(Stage::Clean, result_);
        const agvd::Progress progress = progress_of(Stage::Clean, options_);
        agvd::poll(progress, 0);
        clean_ = clean_input(input_, options_.num_threads, agvd::within(progress, 0, 0));
        result_.cleaned = clean_.counts;
        const agvd::Progress half = agvd::within(progress, 0.5, 0.5);
        result_.input_topology =
            clean_.connectivity.twin.empty()
                ? analyze_topology(clean_.mesh.view(), half)
                : analyze_topology(clean_.mesh.view(), clean_.connectivity, half);
        if (options_.drop_components > 0) {
            result_.components_dropped =
                drop_components(clean_, result_.input_topology, options_.drop_components);
            if (result_.components_dropped > 0) {
                result_.input_topology = analyze_topology(clean_.mesh.view(), half);
            }
        }
        // Nothing was repaired or dropped where connectivity is known.
        if (!clean_.connectivity.twin.empty() && !needs_input()) forget_input();
        agvd::poll(progress, 1);
    }

    // What nothing has changed is had once: in the cleaned mesh.
    void forget_input() {
        std::vector<Index>().swap(clean_.vertex_origin);
        std::vector<Index>().swap(clean_.face_origin);
        if (owned_input_ == nullptr) return;
        *owned_input_ = {};
        input_ = {};
        is_input_gone_ = true;
    }

    // For another run.
    void give_input_back() {
        if (is_input_gone_) *owned_input_ = surface().mesh;
    }

    // Where edges span several cells, the intrinsic triangulation has vertices of its own.
    void triangulate() {
        const StageClock clock(Stage::Clean, result_);
        const agvd::Progress all = progress_of(Stage::Clean, options_);
        const agvd::Progress progress = agvd::within(all, 1, 1);
        Surface surface = build_input_surface(progress);
        spacing_ =
            mean_spacing(surface, options_.sites ? options_.sites->size() : options_.num_samples);
        find_features(surface, progress);
        if (plan_) {
            uncut_ = std::move(surface);
            prepared_.emplace(plan_->cut.surface, spacing_, options_.num_threads, progress);
        } else {
            prepared_.emplace(std::move(surface), spacing_, options_.num_threads, progress);
        }
        component_ = parts_of_base(prepared_->base, topology().face_component, progress);
        result_.refined_faces = base().num_faces();
    }

    // Where there are creases or junctions, all that follows sees a surface that is cut along them.
    void find_features(const Surface& surface, const agvd::Progress& progress) {
        JunctionSet junctions = find_junctions(surface, clean_.vertex_origin);
        junctions.in_result = options_.junctions;
        result_.junctions.edges = static_cast<Index>(junctions.edges.size());
        result_.junctions.apart_edges = result_.junctions.edges;
        const bool has_junctions =
            !options_.sites && options_.boundary == Boundary::Keep && kept_.has_junctions;
        if (!has_junctions) junctions = {};
        if (options_.junctions == Junctions::Apart) {
            drop_short_junctions(surface, least_junction * spacing_, junctions);
        }
        if (!wants_creases() && junctions.empty()) return;
        std::vector<std::uint8_t> is_crease = creases_with_given(surface, progress);
        take_plan(options_.sites ? plan_with_given(surface, std::move(is_crease), progress)
                                 : plan_network(surface, std::move(is_crease), options_.num_samples,
                                                std::move(junctions), kept_.drop_share,
                                                options_.num_threads, progress),
                  progress);
    }

    NetworkPlan plan_with_given(const Surface& surface, std::vector<std::uint8_t> is_crease,
                                const agvd::Progress& progress) {
        const std::vector<SurfacePoint> sites = to_cleaned(*options_.sites, input_, clean_);
        GivenNetwork given =
            plan_given_network(surface, std::move(is_crease),
                               agvd::points_of(sites, agvd::distinct_points(surface, sites)),
                               {.spacing = spacing_,
                                .tolerance = is_relaxed() ? on_curve : site_rounding,
                                .drop_share = kept_.drop_share,
                                .num_threads = options_.num_threads,
                                .progress = progress});
        result_.features.uncarried_curves = given.dropped_curves;
        curves_ = std::move(given.curves);
        sites_ = std::move(given.inner);
        given_number_.clear();
        for (const Index group : groups_of_copies(curves_)) {
            given_number_.push_back(given.of_group[group]);
        }
        given_number_.insert(given_number_.end(), given.of_inner.begin(), given.of_inner.end());
        return std::move(given.plan);
    }

    void take_plan(NetworkPlan plan, const agvd::Progress& progress) {
        FeatureCounts& counts = result_.features;
        counts.curves = static_cast<Index>(plan.network.curves.size());
        counts.nodes = static_cast<Index>(plan.network.nodes.size());
        counts.length = plan.length;
        counts.dropped_length = plan.dropped_length;
        counts.samples_for_all = plan.sites_for_all;
        result_.junctions.samples_for_all = plan.sites_for_junctions;
        if (plan.network.curves.empty()) return;
        result_.junctions.apart_edges -= static_cast<Index>(plan.junctions.edges.size());
        result_.junctions.curves = static_cast<Index>(
            std::count_if(plan.network.curves.begin(), plan.network.curves.end(),
                          [](const Curve& curve) { return curve.is_junction(); }));
        plan_ = std::move(plan);
        // Indices do not tell of a cut along one edge alone: both sides have the same ends.
        const Surface& cut = plan_->cut.surface;
        patches_ = analyze_topology(cut.mesh.view(), {cut.twin, cut.outgoing}, progress);
    }

    [[nodiscard]] bool wants_creases() const {
        return options_.features != Features::Off || !options_.feature_edges.empty() ||
               !options_.face_labels.empty();
    }

    [[nodiscard]] std::vector<std::uint8_t> creases_with_given(
        const Surface& surface, const agvd::Progress& progress) const {
        std::vector<std::uint8_t> is_crease(surface.num_edges(), 0);
        if (options_.features != Features::Off) {
            is_crease = find_creases(
                surface, {.angle = options_.feature_angle,
                          .spacing = std::min(spacing_, mean_spacing(surface, least_scale)),
                          .is_automatic = options_.features == Features::Auto,
                          .num_threads = options_.num_threads,
                          .progress = progress});
        }
        const auto add = [&](const std::vector<std::uint8_t>& is_given) {
            for (std::size_t e = 0; e < is_given.size(); ++e) is_crease[e] |= is_given[e];
        };
        if (!options_.feature_edges.empty()) {
            add(carry_edges(options_.feature_edges, input_, clean_, surface));
        }
        if (!options_.face_labels.empty()) {
            add(find_label_borders(options_.face_labels, clean_, surface));
        }
        return is_crease;
    }

    // What was given in terms of the input is carried over to the cleaned mesh later.
    [[nodiscard]] bool needs_input() const {
        return options_.sites || !options_.feature_edges.empty() || !options_.face_labels.empty();
    }

    // What cleaning has found is handed on. The mesh moves, unless it is still needed there.
    Surface build_input_surface(const agvd::Progress& progress) {
        agvd::TriangleMesh mesh = needs_input() ? clean_.mesh : std::exchange(clean_.mesh, {});
        return clean_.connectivity.twin.empty()
                   ? agvd::build_surface(mesh.view(), options_.num_threads, progress)
                   : agvd::build_surface(std::move(mesh), std::move(clean_.connectivity),
                                         options_.num_threads, progress);
    }

    // The cleaned mesh.
    [[nodiscard]] const Surface& surface() const { return plan_ ? uncut_ : prepared_->input(); }

    // Of the surface, cut along the creases if there are any.
    [[nodiscard]] const Topology& topology() const {
        return plan_ ? patches_ : result_.input_topology;
    }

    // What propagation runs on.
    [[nodiscard]] const Surface& base() const { return prepared_->base.surface(); }

    void place_sites() {
        const StageClock clock(Stage::Sample, result_);
        if (options_.sites) {
            if (!plan_) sites_ = to_cleaned(*options_.sites, input_, clean_);
        } else {
            if (!plan_ && !is_coarse_to_fine()) sites_ = sample_sites(surface(), sampling());
        }
        if (options_.boundary == Boundary::Keep && !plan_) {
            for (const std::vector<Index>& loop : agvd::boundary_loops(surface())) {
                const std::vector<Index> corners = find_corners(surface(), loop, spacing_);
                corners_.insert(corners_.end(), corners.begin(), corners.end());
            }
            std::sort(corners_.begin(), corners_.end());
        }
    }

    [[nodiscard]] SamplingOptions sampling() const {
        Index needed = 0;  // Fewer are reached from there, if at all.
        for (const ComponentTopology& c : result_.input_topology.components) {
            needed += minimum_samples(c.genus, c.boundary_loops);
        }
        return {.num_samples = std::max(options_.num_samples, needed),
                .init = options_.init,
                .boundary = options_.boundary,
                .seed = options_.seed,
                .num_threads = options_.num_threads,
                .progress = progress_of(Stage::Sample, options_)};
    }

    // Relaxation samples by itself.
    [[nodiscard]] bool is_coarse_to_fine() const {
        return !options_.sites && options_.init == Init::BlueNoise && options_.relax_steps > 0;
    }

    void relax() {
        if (plan_) return relax_network();
        if (!is_relaxed()) return;
        const StageClock clock(Stage::Relax, result_);
        const RelaxOptions relax{.steps = options_.relax_steps,
                                 .boundary = options_.boundary,
                                 .corners = corners_,
                                 .num_threads = options_.num_threads,
                                 .progress = progress_of(Stage::Relax, options_)};
        RelaxResult relaxed = is_coarse_to_fine()
                                  ? sample_relaxed_sites(*prepared_, sampling(), relax)
                                  : relax_sites(*prepared_, std::move(sites_), relax);
        sites_ = std::move(relaxed.sites);
        result_.relaxation = std::move(relaxed.levels);
    }

    void relax_network() {
        const StageClock clock(Stage::Relax, result_);
        SamplingOptions exactly = sampling();
        exactly.num_samples = options_.num_samples;
        const RelaxOptions relax{.steps = is_relaxed() ? options_.relax_steps : 0,
                                 .num_threads = options_.num_threads,
                                 .progress = progress_of(Stage::Relax, options_)};
        NetworkSites made = options_.sites
                                ? relax_network_sites(*prepared_, *plan_, curves_, sites_, relax)
                                : sample_network_sites(*prepared_, *plan_, exactly, relax);
        sites_ = std::move(made.sites);
        result_.relaxation = std::move(made.levels);
        curves_ = std::move(made.curves);
        chain_ = chain_edges(plan_->network, plan_->cut, curves_);
        result_.features.vertices = num_result_vertices(plan_->network, curves_);
        result_.junctions.vertices = num_junction_vertices(plan_->network, curves_);
    }

    void drop_duplicates() {
        if (!options_.sites) return;
        // Copies of curve sites lie on one another.
        if (!plan_) {
            sites_ = agvd::points_of(sites_, agvd::distinct_points(surface(), sites_));
        }
        num_distinct_ = static_cast<Index>(sites_.size());
    }

    // The dual with the count asked for. Where it self-intersects more often than the input, it
    // is built again with more sites there; the best counts.
    void build_mesh() {
        std::optional<agvd::SurfaceLayout> layout(std::move(prepared_->layout));
        const Ground ground{base(), layout, topology().components, component_, corners_, chain_};
        const RemeshOptions cell_options = options_of_cells();
        on_base_ = prepared_->base.to_intrinsic(sites_);
        const std::vector<SurfacePoint> first_on_base = on_base_;
        std::vector<bool> is_thinned;  // By component.
        for (int mends = 0;; ++mends) {
            ValidDual dual = build_valid_dual(ground, on_base_, is_thinned, cell_options, result_);
            take_back_sites(first_on_base);
            if (plan_) {
                result_.features.thinned_patches = std::exchange(result_.components_from_faces, 0);
            }
            if (plan_ && !has_chain(dual)) {
                if (mends > 0) return;
                throw NetworkFailed{};
            }
            if (mends == 0) set_target(dual.diagram);
            const Index num_removed = reduce(dual);
            if (dual.mesh.points.size() > target_ && options_.vertex_count == VertexCount::Exact) {
                if (mends > 0) return;
                if (plan_) throw NetworkFailed{};
                throw TooFewSamples{target_, static_cast<Index>(dual.mesh.points.size())};
            }
            const DelaunayCounts flips = flip_edges(dual);
            if (plan_) {
                groups_ = numbers_of(dual, groups_of_copies(curves_), curves_.num_groups());
                whole_ = glue(dual.mesh.triangles, groups_,
                              numbers_of(dual, curves_.vertex, curves_.num_vertices));
            }
            PlacedMesh placed = place(dual);
            const CrossingFaces crossings = unfit_crossings(placed);
            if (mends == 0 || !crossings || crossings->size() < *result_.self_intersections) {
                take_result(placed);
                if (plan_ && options_.sites) order_as_given(dual);
                take_thinned(std::move(placed), dual, is_thinned);
                result_.sites_removed = num_removed;
                result_.delaunay = flips;
                if (crossings) result_.self_intersections = static_cast<Index>(crossings->size());
            }
            if (!crossings || crossings->size() <= result_.input_self_intersections ||
                mends == most_mends_) {
                return;
            }
            if (!add_sites_at(*crossings, dual)) return;
        }
    }

    // Narrow parts between curves are thinned at once: sites added there would be of no use.
    [[nodiscard]] RemeshOptions options_of_cells() const {
        RemeshOptions options = options_;
        if (!plan_) return options;
        options.boundary = Boundary::Free;
        options.repair_rounds = 0;
        return options;
    }

    // Whether each curve is the same chain of edges in all patches beside it.
    [[nodiscard]] bool has_chain(const ValidDual& dual) const {
        std::vector<DirectedEdge> rim = rim_of(dual.mesh.triangles), chain = ends_of(chain_);
        for (auto& [from, to] : rim) {
            from = dual.site[from];
            to = dual.site[to];
        }
        std::sort(rim.begin(), rim.end());
        std::sort(chain.begin(), chain.end());
        return rim == chain;
    }

    // The numbers of the copies on the curves, and later ones for the other vertices of the dual.
    [[nodiscard]] static std::vector<Index> numbers_of(const ValidDual& dual,
                                                       const std::vector<Index>& of_copies,
                                                       Index next) {
        std::vector<Index> numbers;
        for (const Index site : dual.site) {
            numbers.push_back(site < of_copies.size() ? of_copies[site] : next++);
        }
        return numbers;
    }

    void take_result(const PlacedMesh& placed) {
        result_.mesh = mesh_of(placed);
        result_.sites = plan_ ? take(placed.points, whole_.representative) : placed.points;
        if (has_junctions()) first_of_group_ = whole_.first_of_group;
    }
    // Vertices of curves come first else. Those that repair has added stay last.
    void order_as_given(const ValidDual& dual) {
        std::vector<std::pair<Index, Index>> order;  // (number of the site, vertex)
        for (Index v = 0; v < whole_.representative.size(); ++v) {
            const Index site = dual.site[whole_.representative[v]];
            order.emplace_back(site < given_number_.size() ? given_number_[site] : no_index, v);
        }
        std::sort(order.begin(), order.end());
        std::vector<Index> before, after(order.size());
        for (const auto& [number, v] : order) {
            after[v] = static_cast<Index>(before.size());
            before.push_back(v);
        }
        result_.mesh = {take(result_.mesh.positions, before),
                        rename_vertices(result_.mesh.triangles, after)};
        result_.sites = take(result_.sites, before);
    }
    // Copies of a vertex are one, and sheets meet in the same points.
    [[nodiscard]] agvd::TriangleMesh mesh_of(const PlacedMesh& placed) const {
        if (!plan_) return {positions_of(placed), placed.triangles};
        return {take(positions_of(placed), whole_.first_of_group), whole_.triangles};
    }
    // Sheets have the same vertices where they meet; others may be in no triangle.
    [[nodiscard]] agvd::TriangleMesh welded_mesh_of(const PlacedMesh& placed) const {
        if (!has_junctions()) return mesh_of(placed);
        return {positions_of(placed), rename_vertices(whole_.triangles, whole_.first_of_group)};
    }
    // Keeps what mending wants of a result with thinned components.
    void take_thinned(PlacedMesh placed, const ValidDual& dual,
                      const std::vector<bool>& is_thinned) {
        thinned_ = {};
        if (plan_ || result_.components_from_faces == 0 || !is_relaxed()) return;
        std::vector<bool> is_corner(base().num_vertices(), false);
        for (const Index v : corners_) is_corner[v] = true;
        thinned_.hard = rim_of(placed.triangles);
        thinned_.mobility.assign(placed.points.size(), Mobility::Free);
        for (const auto& [from, to] : thinned_.hard) {
            thinned_.mobility[from] = thinned_.mobility[to] = Mobility::Boundary;
        }
        for (Index i = 0; i < placed.points.size(); ++i) {
            const SurfacePoint& point = dual.mesh.points[i];
            const auto v = agvd::vertex_of(base(), point);
            if ((v && is_corner[*v]) || !is_thinned[component_[point.face.value()]]) {
                thinned_.mobility[i] = Mobility::Fixed;
            }
        }
        thinned_.mesh = std::move(placed);
    }

    // Thinned components have thin triangles. Where better ones would intersect, their
    // corners stay.
    void mend_thinned() {
        if (thinned_.mesh.points.empty()) return;
        for (int round = 0; round < max_mended; ++round) {
            PlacedMesh mended = thinned_.mesh;
            std::vector<Index> numbers;
            {
                const StageClock clock(Stage::Place, result_);
                const agvd::Progress progress = progress_of(Stage::Place, options_);
                numbers = mend_shape(prepared_->input(), thinned_.mobility, thinned_.hard, mended,
                                     agvd::within(progress, 1, 1));
            }
            if (numbers.empty()) return;
            const CrossingFaces crossings = find_crossings(mended);
            if (!crossings || crossings->size() <= *result_.self_intersections) {
                if (crossings) result_.self_intersections = static_cast<Index>(crossings->size());
                return take_result(mended);
            }
            fix_corners(*crossings, mended.triangles, numbers);
        }
    }

    void fix_corners(const std::vector<std::pair<Index, Index>>& faces,
                     const std::vector<agvd::Triangle>& triangles,
                     const std::vector<Index>& numbers) {
        for (const auto& [f, g] : faces) {
            for (const Index face : {f, g}) {
                for (const Index v : triangles[face]) {
                    if (numbers[v] < thinned_.mobility.size()) {
                        thinned_.mobility[numbers[v]] = Mobility::Fixed;
                    }
                }
            }
        }
    }

    [[nodiscard]] bool has_junctions() const { return plan_ && !plan_->junctions.empty(); }
    template <typename T>
    [[nodiscard]] static std::vector<T> take(const std::vector<T>& all,
                                             const std::vector<Index>& chosen) {
        std::vector<T> result;
        result.reserve(chosen.size());
        for (const Index i : chosen) result.push_back(all[i]);
        return result;
    }

    // Sites on the input, as repair has changed those on the base.
    void take_back_sites(const std::vector<SurfacePoint>& first_on_base) {
        sites_.resize(first_on_base.size());
        for (Index s = 0; s < on_base_.size(); ++s) {
            if (s >= sites_.size()) {
                sites_.push_back(prepared_->base.to_input(on_base_[s]));
            } else if (on_base_[s] != first_on_base[s]) {
                sites_[s] = prepared_->base.to_input(on_base_[s]);
            }
        }
    }

    void set_target(const agvd::Diagram& diagram) {
        target_ = options_.num_samples + num_other_copies();
        if (!options_.sites) return;
        const auto num_copies = static_cast<Index>(curves_.sites.size());
        const auto first = diagram.cell_area.begin();
        target_ =
            num_copies + static_cast<Index>(std::count_if(first + num_copies, first + num_distinct_,
                                                          [](double area) { return area > 0; }));
        result_.sites_dropped =
            static_cast<Index>(options_.sites->size()) - (target_ - num_other_copies());
    }

    // Sites of curves that become no vertex besides those of the first copies.
    [[nodiscard]] Index num_other_copies() const {
        if (!plan_) return 0;
        return static_cast<Index>(curves_.sites.size()) -
               num_result_vertices(plan_->network, curves_);
    }

    // Takes vertices away until the count is met; returns how many.
    Index reduce(ValidDual& dual) {
        const auto num_vertices = static_cast<Index>(dual.mesh.points.size());
        const bool adds = options_.vertex_count == VertexCount::Add;
        // A component from its faces has more vertices than it was to have sites.
        if (adds && result_.components_from_faces == 0) return 0;
        const Index target = adds ? static_cast<Index>(on_base_.size()) : target_;
        if (num_vertices <= target) return 0;
        const StageClock clock(Stage::Dual, result_);
        std::vector<bool> is_corner(base().num_vertices(), false);
        for (const Index v : corners_) is_corner[v] = true;
        std::vector<std::uint8_t> keep(num_vertices, 0);
        for (Index i = 0; i < num_vertices; ++i) {
            const auto v = agvd::vertex_of(base(), dual.mesh.points[i]);
            const Index site = dual.site[i];
            keep[i] = (v && is_corner[*v]) || site < curves_.sites.size() ||
                      (site != no_index && site < is_wanted_.size() && is_wanted_[site]);
        }
        const std::vector<Index> gone =
            reduce_vertices(positions_of(places_of(dual)), dual.mesh.triangles, target, keep,
                            progress_of(Stage::Dual, options_));
        compact(dual, gone);
        return static_cast<Index>(gone.size());
    }

    DelaunayCounts flip_edges(ValidDual& dual) {
        const StageClock clock(Stage::Delaunay, result_);
        const agvd::Progress progress = progress_of(Stage::Delaunay, options_);
        agvd::poll(progress, 0);
        DelaunayResult made = make_delaunay(
            base(), dual.mesh.points, positions_of(places_of(dual)), dual.site, dual.diagram,
            dual.mesh.triangles,
            {.mode = options_.delaunay, .num_threads = options_.num_threads, .progress = progress});
        agvd::poll(progress, 1);
        dual.mesh.triangles = std::move(made.triangles);
        return made.counts;
    }

    static void compact(ValidDual& dual, const std::vector<Index>& gone) {
        std::vector<Index> number(dual.mesh.points.size(), 0);
        for (const Index v : gone) number[v] = no_index;
        Index num_left = 0;
        for (Index v = 0; v < number.size(); ++v) {
            if (number[v] == no_index) continue;
            dual.mesh.points[num_left] = dual.mesh.points[v];
            dual.site[num_left] = dual.site[v];
            number[v] = num_left++;
        }
        dual.mesh.points.resize(num_left);
        dual.site.resize(num_left);
        for (agvd::Triangle& t : dual.mesh.triangles) {
            for (Index& v : t) v = number[v];
        }
    }

    // Where the vertices of the dual lie on the input.
    [[nodiscard]] std::vector<SurfacePoint> places_of(const ValidDual& dual) const {
        std::vector<SurfacePoint> places;
        places.reserve(dual.site.size());
        for (Index v = 0; v < dual.site.size(); ++v) {
            const Index site = dual.site[v];
            places.push_back(site != no_index ? sites_[site]
                                              : prepared_->base.to_input(dual.mesh.points[v]));
        }
        return places;
    }

    [[nodiscard]] std::vector<Vec3> positions_of(const std::vector<SurfacePoint>& points) const {
        std::vector<Vec3> positions;
        positions.reserve(points.size());
        for (const SurfacePoint& point : points) {
            positions.push_back(position(surface().mesh.view(), point));
        }
        return positions;
    }

    [[nodiscard]] bool is_relaxed() const {
        return options_.relax_steps > 0 && !(options_.sites && options_.keep_sites);
    }

    PlacedMesh place(const ValidDual& dual) {
        const StageClock clock(Stage::Place, result_);
        const agvd::Progress progress = progress_of(Stage::Place, options_);
        agvd::poll(progress, 0);
        PlacedMesh placed{places_of(dual), {}, dual.mesh.triangles};
        placed.offsets.assign(placed.points.size(), Vec3::Zero());
        std::vector<Index> vertex(on_base_.size(), no_index);
        for (Index v = 0; v < dual.site.size(); ++v) {
            if (dual.site[v] != no_index) vertex[dual.site[v]] = v;
        }
        std::vector<Index> nearest;
        for (const agvd::SiteId site : dual.diagram.nearest_site) {
            nearest.push_back(site.is_valid() ? vertex[site.value()] : no_index);
        }
        if (options_.fit.value_or(is_relaxed())) {
            if (plan_) fit_network(placed);
            fit_vertices(*prepared_, nearest, placed, options_.num_threads,
                         agvd::within(progress, 0, 0), plan_ ? rounding * spacing_ : 0);
        }
        if (is_relaxed()) {
            improve_shape(*prepared_, nearest, placed, agvd::within(progress, 0.5, 0.5));
        }
        agvd::poll(progress, 1);
        return placed;
    }

    [[nodiscard]] std::vector<Vec3> positions_of(const PlacedMesh& mesh) const {
        std::vector<Vec3> positions;
        positions.reserve(mesh.points.size());
        for (Index v = 0; v < mesh.points.size(); ++v) {
            positions.push_back(mesh.position(surface().mesh.view(), v));
        }
        return positions;
    }

    void fit_network(PlacedMesh& placed) const {
        const std::vector<Vec3> offsets =
            fit_curves(uncut_, plan_->network, curves_, options_.boundary);
        for (Index v = 0; v < groups_.size(); ++v) {
            if (groups_[v] < offsets.size()) placed.offsets[v] = offsets[groups_[v]];
        }
    }

    // Puts vertices back onto the surface where triangles intersect.
    CrossingFaces unfit_crossings(PlacedMesh& mesh) {
        CrossingFaces crossings = find_crossings(mesh);
        result_.unfitted_vertices = 0;
        for (int round = 0; round < max_unfits && crossings && !crossings->empty(); ++round) {
            bool is_changed = false;
            for (const auto& [f, g] : *crossings) {
                for (const Index face : {f, g}) {
                    for (const Index v : mesh.triangles[face]) {
                        if (mesh.offsets[v].isZero(0)) continue;
                        unfit(v, mesh);
                        ++result_.unfitted_vertices;
                        is_changed = true;
                    }
                }
            }
            if (!is_changed) break;
            crossings = find_crossings(mesh);
        }
        return crossings;
    }

    // Copies of a vertex stay together.
    void unfit(Index v, PlacedMesh& mesh) const {
        mesh.offsets[v].setZero();
        if (!plan_ || groups_[v] >= curves_.num_groups()) return;
        for (Index other = 0; other < groups_.size(); ++other) {
            if (groups_[other] == groups_[v]) mesh.offsets[other].setZero();
        }
    }

    // Of the input only if the result has any. Sheets that meet at a junction are no crossing.
    CrossingFaces find_crossings(const PlacedMesh& mesh) {
        const StageClock clock(Stage::Check, result_);
        const agvd::Progress progress = progress_of(Stage::Check, options_);
        agvd::poll(progress, 0);
        const auto find = [&](const agvd::MeshView& whole) {
            return find_self_intersections(whole, options_.num_threads, progress);
        };
        const agvd::TriangleMesh placed = welded_mesh_of(mesh);
        CrossingFaces found = find(placed.view());
        if (found && !found->empty() && !has_judged_input_) {
            const agvd::TriangleMesh& input = surface().mesh;
            std::vector<agvd::Triangle> welded;
            if (has_junctions()) {
                welded = rename_vertices(input.triangles,
                                         first_copies(plan_->junctions, surface().num_vertices()));
            }
            result_.input_self_intersections = static_cast<Index>(
                find({input.positions, has_junctions() ? welded : input.triangles})->size());
            has_judged_input_ = true;
        }
        return found;
    }

    // Where the cells of the faces' corners reach farthest; these cells' sites then stay. False if
    // there is no such place.
    bool add_sites_at(const std::vector<std::pair<Index, Index>>& crossings,
                      const ValidDual& dual) {
        const std::vector<Index> farthest = farthest_corners(dual.diagram);
        std::vector<Index> corners;
        is_wanted_.resize(on_base_.size(), false);
        for (const auto& [f, g] : crossings) {
            for (const Index face : {f, g}) {
                for (const Index v : dual.mesh.triangles[face]) {
                    const Index site = dual.site[v];
                    if (site == no_index || farthest[site] == no_index) continue;
                    corners.push_back(farthest[site]);
                    is_wanted_[site] = true;
                }
            }
        }
        if (corners.empty()) return false;
        std::sort(corners.begin(), corners.end());
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        for (const Index v : corners) on_base_.push_back(dual.diagram.vertices[v]);
        is_wanted_.resize(on_base_.size(), true);
        result_.sites_added += static_cast<Index>(corners.size());
        result_.added_because["self-intersects"] += static_cast<Index>(corners.size());
        return true;
    }

    // All before implies this; nothing leaves unchecked all the same.
    void check_mesh() {
        const StageClock clock(Stage::Check, result_);
        const agvd::Progress progress = progress_of(Stage::Check, options_);
        agvd::poll(progress, 1);
        const Topology topology =
            analyze_topology(result_.mesh.view(), agvd::within(progress, 1, 1));
        if (!topology.is_manifold || !topology.is_oriented ||
            !same_topology(topology, result_.input_topology)) {
            if (plan_) throw NetworkFailed{};
            throw std::logic_error(
                "the result lost the topology of the input; please report this with the mesh");
        }
        if (has_junctions() && options_.junctions == Junctions::Keep) weld_junctions();
        if (plan_ && options_.vertex_count == VertexCount::Exact &&
            result_.mesh.positions.size() != target_ - num_other_copies()) {
            throw NetworkFailed{};
        }
    }

    // More than two faces meet nowhere but along the junctions.
    void weld_junctions() {
        result_.sites = take(result_.sites, weld_sheets(first_of_group_, result_.mesh));
        result_.junctions.welded_edges = num_branched_edges(result_.mesh.triangles);
        Index num_wanted = 0;
        for (const ChainEdge& edge : chain_) {
            const bool is_branched = plan_->network.curves[edge.curve].sides.size() > 2;
            if (is_branched && edge.side == 0) ++num_wanted;
        }
        if (result_.junctions.welded_edges != num_wanted) throw NetworkFailed{};
    }

    agvd::MeshView input_;
    agvd::TriangleMesh* owned_input_;  // What input_ shows if it may be given away, or null.
    const RemeshOptions& options_;
    const int most_mends_;
    const KeptCurves kept_;
    RemeshResult result_;
    CleanResult clean_;
    double spacing_ = 0;                       // Mean distance of the sites.
    std::optional<NetworkPlan> plan_;          // Its cut surface is here the whole one.
    Surface uncut_;                            // The cleaned mesh, if there is a plan.
    Topology patches_;                         // Of the cut surface; without a plan not used.
    std::optional<PreparedSurface> prepared_;  // The cleaned mesh, cut along the creases.
    bool is_input_gone_ = false;
    std::vector<Index> component_;       // #F of the base.
    CurveSites curves_;                  // The first ones of the sites; empty without a plan.
    std::vector<ChainEdge> chain_;       // Likewise.
    std::vector<Index> given_number_;    // By site, of given ones with a plan: their order.
    std::vector<Index> groups_;          // Of the dual's vertices: equal for copies of one.
    GluedMesh whole_;                    // The dual with copies as one; without a plan not used.
    std::vector<Index> first_of_group_;  // Of the result's vertices; without junctions empty.
    std::vector<SurfacePoint> sites_;    // On the cleaned mesh.
    std::vector<SurfacePoint> on_base_;  // The same, and those that repair has added.
    std::vector<Index> corners_;         // Boundary vertices, ascending.
    Index num_distinct_ = 0;             // Given sites.
    Index target_ = 0;                   // Vertices of the result.
    struct {
        PlacedMesh mesh;  // Of no vertices: there is nothing to mend.
        std::vector<Mobility> mobility;
        std::vector<DirectedEdge> hard;
    } thinned_;
    std::vector<bool> is_wanted_;  // By site: stays where vertices are taken away.
    bool has_judged_input_ = false;
};

}  // namespace

RemeshResult run_pipeline(const agvd::MeshView& mesh, const RemeshOptions& options, int most_mends,
                          const KeptCurves& kept) {
    return Pipeline(mesh, nullptr, options, most_mends, kept).run();
}

RemeshResult run_pipeline(agvd::TriangleMesh& mesh, const RemeshOptions& options, int most_mends,
                          const KeptCurves& kept) {
    return Pipeline(mesh.view(), &mesh, options, most_mends, kept).run();
}

}  // namespace remesh::detail
