// The whole pipeline: options of JavaScript to those of the library, and the result with all values
// of the input.
#include <utility>

#include "calls.h"
#include "choices.h"
#include "expected_stages.h"
#include "feature_rule.h"
#include "javascript_terms.h"
#include "mesh_message.h"
#include "options.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/transfer/transfer.h"
#include "report/report.h"
#include "run.h"
#include "shortfalls.h"
#include "sites.h"

namespace npm {
namespace {

using agvd::Index;
using agvd::InvalidOption;
using remesh::Attribute;
using remesh::MeshFile;
using remesh::RemeshOptions;

constexpr double most_index = std::numeric_limits<Index>::max();

const char* topology_name(remesh::VertexCount count) {
    return count == remesh::VertexCount::Add ? "add" : "exact";
}

// Values of an array, or those of the mesh that an option names; none: the option is not given.
std::vector<double> values_of(const Request& request, Options& options, const char* name,
                              const std::vector<Attribute>& attributes, const char* what) {
    options.know(name);
    if (request.has_array(name)) {
        const auto array = request.array<double>(name);
        return {array.begin(), array.end()};
    }
    const auto wanted = options.text(name);
    if (!wanted) return {};
    return remesh::require_attribute(attributes, *wanted,
                                     name + (": the mesh has no values of " + std::string(what)))
        .values;
}

void require_one(std::span<const char* const> names, Options& options) {
    const char* first = nullptr;
    for (const char* const name : names) {
        if (!options.has(name)) continue;
        if (first != nullptr) {
            throw InvalidOption(std::string(first) + " and " + name +
                                " each give the number of vertices; use one of them");
        }
        first = name;
    }
}

void set_count(const Request& request, Options& given, const MeshFile& input,
               std::size_t num_vertices, RemeshOptions& options) {
    constexpr const char* names[] = {"n", "faces", "edgeLength", "maxDistance"};
    require_one(names, given);
    const agvd::MeshView mesh = input.mesh.view();
    if (const auto count = given.count("n", num_vertices)) {
        options.num_samples = static_cast<Index>(*count);
    }
    if (const auto faces = given.whole("faces", 1, most_index)) {
        options.sizing.count = remesh::NumFaces{static_cast<Index>(*faces)};
    }
    if (const auto edge = given.length("edgeLength", mesh)) {
        options.sizing.count = remesh::MeanEdge{*edge};
    }
    if (const auto distance = given.length("maxDistance", mesh)) {
        options.sizing.count = remesh::MaxDistance{*distance};
    }
    for (const char* const name : {"sizing", "faceSizing"}) {
        const bool has_lengths = request.has_array(name) || given.has(name);
        const bool is_free = std::none_of(std::begin(names), std::end(names),
                                          [&](const char* one) { return given.has(one); });
        if (has_lengths && is_free) options.sizing.count = remesh::CountOfLengths{};
    }
}

void set_lengths(const Request& request, Options& given, const MeshFile& input,
                 RemeshOptions& options) {
    const remesh::MeshAttributes& attributes = input.attributes;
    std::vector<double> lengths =
        values_of(request, given, "sizing", attributes.of_vertices, "vertices");
    std::vector<double> of_faces =
        values_of(request, given, "faceSizing", attributes.of_faces, "faces");
    std::vector<double> densities =
        values_of(request, given, "density", attributes.of_vertices, "vertices");
    const bool is_adaptive = given.flag("adaptive");
    const int num_ways =
        int{is_adaptive} + int{!lengths.empty()} + int{!of_faces.empty()} + int{!densities.empty()};
    const bool has_distance = given.has("maxDistance");
    if (num_ways > 1) {
        throw InvalidOption(
            "several of adaptive, sizing, faceSizing and density are given; use "
            "one of them");
    }
    if (has_distance && num_ways > int{is_adaptive}) {
        throw InvalidOption("maxDistance excludes sizing, faceSizing and density");
    }
    auto& edges = options.sizing.edges;
    if (is_adaptive) edges = remesh::AdaptiveEdges{};
    if (!lengths.empty()) edges = remesh::VertexLengths{std::move(lengths)};
    if (!of_faces.empty()) edges = remesh::FaceLengths{std::move(of_faces)};
    if (!densities.empty()) edges = remesh::VertexDensities{std::move(densities)};
    const agvd::MeshView mesh = input.mesh.view();
    const auto least = given.length("minEdge", mesh), most = given.length("maxEdge", mesh);
    const auto gradation = given.number("gradation");
    if (num_ways == 0 && !has_distance && (least || most || gradation)) {
        throw InvalidOption(
            "minEdge, maxEdge and gradation bound edges that differ; add adaptive, "
            "maxDistance, sizing, faceSizing or density, or leave them out");
    }
    if (least) options.sizing.min_edge = *least;
    if (most) options.sizing.max_edge = *most;
    if (gradation) options.sizing.gradation = *gradation;
}

void set_bounds(Options& given, const MeshFile& input, remesh::ShapeBounds& bounds) {
    bounds.min_angle = given.number("minAngle").value_or(bounds.min_angle);
    bounds.max_angle = given.number("maxAngle").value_or(bounds.max_angle);
    bounds.longest_edge =
        given.length("longestEdge", input.mesh.view()).value_or(bounds.longest_edge);
}

// Of arrays with two vertices for each edge.
void append_edges(std::span<const Index> ends, std::vector<std::array<Index, 2>>& edges) {
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) edges.push_back({ends[i], ends[i + 1]});
}

void set_features(const Request& request, Options& given, const MeshFile& input,
                  RemeshOptions& options) {
    set_feature_rule(given, options);
    given.know("featureEdges");
    append_edges(request.array<Index>("given.featureEdges"), options.feature_edges);
    if (options.features != remesh::Features::Off) {
        options.feature_edges.insert(options.feature_edges.end(), input.feature_edges.begin(),
                                     input.feature_edges.end());
    }
    Attribute labels{
        .name = "faceLabels",
        .values = values_of(request, given, "faceLabels", input.attributes.of_faces, "faces")};
    if (!labels.values.empty()) options.face_labels = remesh::face_labels_of(labels);
}

// \return the number of vertices of what is remeshed.
std::size_t set_kept(const Request& request, Options& given, const MeshFile& input,
                     RemeshOptions& options) {
    given.know("lock");
    const auto locked = request.array<Index>("lock");
    options.locked.assign(locked.begin(), locked.end());
    options.lock_boundary = given.flag("lockBoundary");
    if (!options.sites) {
        options.locked.insert(options.locked.end(), input.locked.begin(), input.locked.end());
        options.locked_edges = input.locked_edges;
    }
    const auto marks = values_of(request, given, "region", input.attributes.of_faces, "faces");
    const std::size_t num_vertices = input.mesh.positions.size();
    if (marks.empty()) return num_vertices;
    std::vector<bool> is_inside(num_vertices);
    for (const double mark : marks) options.region.push_back(mark != 0 ? 1 : 0);
    for (std::size_t f = 0; f < std::min(marks.size(), input.mesh.triangles.size()); ++f) {
        for (const Index v : input.mesh.triangles[f]) {
            if (marks[f] != 0 && v < num_vertices) is_inside[v] = true;
        }
    }
    return static_cast<std::size_t>(std::count(is_inside.begin(), is_inside.end(), true));
}

void set_sites(const Request& request, Options& given, const MeshFile& input,
               RemeshOptions& options) {
    given.know("sites");
    options.keep_sites = given.flag("keepSites");
    Run run({{"sample", 1}});
    if (request.has_array("sites") || request.has_array("sites.points") ||
        request.has_array("sites.faces")) {
        options.sites = sites_of(request, "sites", input.mesh.view(), run);
    } else if (options.keep_sites) {
        throw InvalidOption("keepSites needs sites");
    }
}

void set_method(Options& given, RemeshOptions& options) {
    using remesh::Boundary;
    using remesh::Delaunay;
    using remesh::Init;
    using remesh::Junctions;
    using remesh::VertexCount;
    given.choose("topology", options.vertex_count, {VertexCount::Exact, VertexCount::Add},
                 topology_name);
    given.choose("boundary", options.boundary, {Boundary::Keep, Boundary::Free},
                 cli::boundary_name);
    given.choose("init", options.init, {Init::BlueNoise, Init::Farthest, Init::Random},
                 remesh::init_name);
    given.choose("junctions", options.junctions, {Junctions::Apart, Junctions::Keep},
                 remesh::junctions_name);
    given.choose("delaunay", options.delaunay,
                 {Delaunay::Intrinsic, Delaunay::Extrinsic, Delaunay::Off}, remesh::delaunay_name);
    options.propagation.max_error = given.number("maxError");
    constexpr double most_exact = 0x1p53;
    if (const auto seed = given.whole("seed", 0, most_exact)) {
        options.seed = static_cast<std::uint64_t>(*seed);
    }
    if (const auto steps = given.whole("relax", 0, 1'000'000)) {
        options.relax_steps = static_cast<int>(*steps);
    }
    if (const auto tile = given.whole("tile", 0, 1e9)) {
        options.samples_per_tile = static_cast<agvd::Index>(*tile);
    }
    options.fit = given.optional_flag("fit");
}

void set_cleaning(Options& given, const MeshFile& input, RemeshOptions& options) {
    options.cleaning.keep_slits = given.flag("keepSlits");
    options.drop_components = given.number("dropComponents").value_or(0);
    options.cleaning.weld = given.length("weld", input.mesh.view()).value_or(0);
    if (given.whole("fillHoles", 0, 1'000'000).value_or(0) > 0) {
        throw InvalidOption(
            "fillHoles needs CGAL, which this package is without; leave it out, or fill the holes "
            "with the program or its Python module");
    }
}

RemeshOptions options_of(const Request& request, Options& given, const MeshFile& input) {
    RemeshOptions options{.texture_seams = input.attributes.texture.seams, .num_threads = 1};
    set_sites(request, given, input, options);
    const std::size_t num_vertices = set_kept(request, given, input, options);
    set_count(request, given, input, num_vertices, options);
    set_lengths(request, given, input, options);
    set_bounds(given, input, options.bounds);
    set_features(request, given, input, options);
    set_method(given, options);
    set_cleaning(given, input, options);
    return options;
}

// Of the values that the result gets; unset: all.
std::optional<std::set<std::string>> names_to_transfer(Options& given) {
    const Json* const names = given.find("transfer");
    if (names == nullptr) return std::nullopt;
    return names->get<std::set<std::string>>();
}

void keep_wanted(const std::set<std::string>& wanted, remesh::MeshAttributes& attributes) {
    for (auto* kind : {&attributes.of_vertices, &attributes.of_faces}) {
        std::erase_if(*kind, [&](const Attribute& one) { return !wanted.contains(one.name); });
    }
    if (!wanted.contains("material")) attributes.materials = {};
    attributes.normals.reset();
}

// Where the vertices of the result lie on the input.
void add_places(std::span<const agvd::SurfacePoint> places, Answer& answer) {
    std::vector<Index> faces;
    std::vector<std::array<double, 3>> barycentric;
    for (const agvd::SurfacePoint& place : places) {
        faces.push_back(place.face.value());
        barycentric.push_back(place.barycentric);
    }
    answer.add<Index>("sourceFace", std::move(faces));
    answer.add<double>("barycentric", std::move(barycentric));
}

}  // namespace

Answer call_remesh(const Request& request) {
    Options given(request.json()["options"]);
    MeshFile input = mesh_of(request);
    const auto wanted = names_to_transfer(given);
    remesh::TextureCoordinates& texture = input.attributes.texture;
    if (wanted && !wanted->contains("uv")) texture = {};
    if (!texture.empty()) {
        texture.seams = remesh::find_texture_seams(input.mesh.view(), texture.corners);
    }
    RemeshOptions options = options_of(request, given, input);
    const bool is_strict = given.flag("strict");
    given.require_known();
    if (wanted) keep_wanted(*wanted, input.attributes);
    const agvd::MeshView mesh = input.mesh.view();
    const std::size_t num_samples = cli::estimated_samples(options, mesh);
    Run run(cli::stages_of_remesh(mesh.triangles.size(), num_samples, true, options),
            cli::runs_of_remesh(options));
    options.progress = [&](remesh::Stage stage, double fraction) {
        return run.goes_on(remesh::stage_name(stage), fraction);
    };
    remesh::RemeshResult result = remesh::remesh(mesh, options);
    const std::vector<std::string> warnings =
        in_terms_of_javascript(cli::shortfalls_of(result, options, is_strict));
    const remesh::InputMap map =
        remesh::map_to_input(mesh, result.mesh.view(), result.sites,
                             {.with_faces = !input.attributes.of_faces.empty(),
                              .num_threads = 1,
                              .progress = run.of("transfer")});
    MeshFile output;
    output.attributes = remesh::transfer_attributes(
        input, result.mesh.view(), map, {.num_threads = 1, .progress = run.of("transfer")});
    remesh::keep_attributes(input.attributes, result.kept.vertices, result.kept.faces,
                            output.attributes);
    Answer answer;
    answer.json["warnings"] = warnings;
    answer.report = remesh::to_json(result, {.version = REMESH_VERSION,
                                             .options = options,
                                             .output = remesh::measure_figures(result.mesh.view()),
                                             .warnings = warnings});
    add_places(map.vertices, answer);
    answer.add<Index>("keptVertices", std::move(result.kept.vertices));
    answer.add<Index>("keptFaces", std::move(result.kept.faces));
    output.mesh = std::move(result.mesh);
    add_mesh(std::move(output), answer);
    return answer;
}

}  // namespace npm
