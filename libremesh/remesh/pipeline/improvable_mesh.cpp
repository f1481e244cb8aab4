#include "remesh/pipeline/improvable_mesh.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/mesh_part.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/quality/evaluate.h"

namespace remesh::detail {
namespace {

// Most tries; in the second one fewer vertices may move. Repair adds no intersections but those in
// one plane or by rounding.
constexpr int most_tries = 2;
constexpr int most_partings = 2;
// Share of the triangles: more that exceed what nobody asked for are those of thin walls or shells
// that intersect, and stay so. A wrap has as many at the rims of its sheets.
double most_beyond_aims(const RemeshOptions& options) { return options.wrap ? 0.05 : 0.01; }
// Around bad triangles: edits reach some edges far, and vertices to spare are found there.
constexpr Index rings_of_places = 8;

// The pairs that do not follow from the input's. None if most do.
FacePairs pairs_to_part(const std::optional<CrossingFaces>& crossings) {
    if (!crossings || !are_mostly_added(crossings->counts())) return {};
    return crossings->added;
}

// The faces beyond the aims, but for those with an acute corner between curves; none if they are
// more than a share of all.
std::vector<Index> narrow_faces(const PlacedMesh& mesh, const TriangleMesh& whole,
                                const ShapeBounds& aims, double most_share) {
    std::vector<DirectedEdge> hard = mesh.hard;
    std::ranges::sort(hard);
    std::vector<Index> narrow;
    for (Index f = 0; f < whole.triangles.size(); ++f) {
        const Triangle& t = whole.triangles[f];
        const FaceShape shape = measure_face(corners_of(whole.view(), f));
        const auto [least, most] = std::ranges::minmax_element(shape.angle);
        const auto k = static_cast<std::size_t>(least - shape.angle.begin());
        const bool is_corner =
            has_edge(hard, t[k], t[(k + 1) % 3]) && has_edge(hard, t[(k + 2) % 3], t[k]);
        if (*most > aims.max_angle * degree || (*least < aims.min_angle * degree && !is_corner)) {
            narrow.push_back(f);
        }
    }
    const double most_faces = most_share * static_cast<double>(whole.triangles.size());
    return static_cast<double>(narrow.size()) > most_faces ? std::vector<Index>{} : narrow;
}

}  // namespace

std::vector<Mobility> find_mobility(const CurvedSurface& curved, const MeshCurves& curves,
                                    const PlacedMesh& mesh) {
    std::vector<bool> is_on_edge(mesh.points.size(), false);
    for (const auto& [from, to] : mesh.hard) is_on_edge[from] = is_on_edge[to] = true;
    // Shape is no reason to leave out a node that a distance needs.
    const bool is_fixed =
        curved.has_locked() || (curved.bound != nullptr && !curved.bound->hinges.empty());
    std::vector<Mobility> result;
    result.reserve(mesh.points.size());
    for (Index v = 0; v < mesh.points.size(); ++v) {
        const CurvePlace place = curves.place_of(mesh.points[v]);
        Mobility mobility = place.is_free()           ? Mobility::Free
                            : place.curve != no_index ? Mobility::Boundary
                            : is_fixed                ? Mobility::Fixed
                                                      : Mobility::Node;
        // A mesh may pass by a vertex on a curve, and a rim may lie off the boundary.
        if (!is_on_edge[v]) {
            if (place.node == no_index || !curved.has_locked()) mobility = Mobility::Free;
        } else if (mobility == Mobility::Free) {
            mobility = Mobility::Boundary;
        }
        result.push_back(mobility);
    }
    return result;
}

void improve_in_places(const CurvedSurface& curved, std::span<const std::uint8_t> stays,
                       PlacedMesh& mesh, const StageContext& context) {
    const StageClock clock(Stage::Place, context.result);
    const MeshCurves curves = curved.curves();
    std::vector<Index> seeds;
    const auto at = [&](Index v) { return mesh.position(curved.whole->mesh.view(), v); };
    for (const auto& [a, b, c] : mesh.triangles) {
        if (shape_quality(at(a), at(b), at(c)) < low_quality) seeds.insert(seeds.end(), {a, b, c});
    }
    if (seeds.empty()) return;
    const std::vector<Index> ring = rings_around(mesh.triangles, mesh.points.size(),
                                                 distinct(std::move(seeds)), rings_of_places);
    std::vector<Index> triangles, vertices;
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
        const bool is_near =
            std::ranges::all_of(mesh.triangles[t], [&](Index v) { return ring[v] != no_index; });
        if (!is_near) continue;
        triangles.push_back(t);
        vertices.insert(vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
    }
    vertices = distinct(std::move(vertices));
    PlacedMesh part{take(mesh.points, vertices), take(mesh.offsets, vertices), {}};
    for (const Index t : triangles) {
        Triangle& made = part.triangles.emplace_back(mesh.triangles[t]);
        for (Index& v : made) v = rank_of(vertices, v);
    }
    for (const auto& [from, to] : mesh.hard) {
        if (ring[from] == no_index || ring[to] == no_index) continue;
        part.hard.emplace_back(rank_of(vertices, from), rank_of(vertices, to));
    }
    std::vector<Mobility> mobility = find_mobility(curved, curves, part);
    const auto number_all = [](std::span<const DirectedEdge> edges, std::span<const Index> number) {
        std::vector<DirectedEdge> numbered;
        for (const auto& [from, to] : edges) numbered.emplace_back(number[from], number[to]);
        std::ranges::sort(numbered);
        return numbered;
    };
    const std::vector<DirectedEdge> hard_before = number_all(part.hard, vertices);
    const std::vector<DirectedEdge> rim = rim_of(part.triangles);
    for (const auto& [from, to] : rim) {
        part.hard.emplace_back(from, to);
        if (ring[vertices[from]] == rings_of_places) mobility[from] = Mobility::Fixed;
    }
    for (Index i = 0; i < vertices.size(); ++i) {
        if (!stays.empty() && stays[vertices[i]] != 0) mobility[i] = Mobility::Fixed;
    }
    const std::vector<Index> numbers =
        repair_shape(curves, mobility, part, progress_at(Stage::Place, context.options, 1),
                     faces_around(curved.cut(), part.points, 2 * curved.spacing));
    if (numbers.empty()) return;
    // New vertices take the places of those that are gone.
    std::vector<std::uint8_t> is_left(vertices.size(), 0);
    for (const Index number : numbers) {
        if (number < is_left.size()) is_left[number] = 1;
    }
    std::vector<Index> place;
    place.reserve(numbers.size());
    Index gone = 0;
    for (Index i = 0; i < numbers.size(); ++i) {
        Index number = numbers[i];
        if (number >= is_left.size()) {
            while (is_left[gone] != 0) ++gone;
            number = gone++;
        }
        place.push_back(vertices[number]);
        mesh.points[place[i]] = part.points[i];
        mesh.offsets[place[i]] = part.offsets[i];
    }
    // Along the boundary an edge may have been added, or have gone.
    std::vector<Triangle> all;
    all.reserve(mesh.triangles.size());
    for (Index t = 0, next = 0; t < mesh.triangles.size(); ++t) {
        if (next < triangles.size() && triangles[next] == t) {
            ++next;
        } else {
            all.push_back(mesh.triangles[t]);
        }
    }
    for (const auto& [a, b, c] : part.triangles) all.push_back({place[a], place[b], place[c]});
    mesh.triangles = std::move(all);
    const auto was_hard = [&](const DirectedEdge& edge) {
        return has_edge(hard_before, edge.first, edge.second);
    };
    std::erase_if(mesh.hard, was_hard);
    const std::vector<DirectedEdge> rim_before = number_all(rim, vertices);
    const std::vector<DirectedEdge> rim_now = rim_of(mesh.triangles);
    for (const DirectedEdge& edge : number_all(part.hard, place)) {
        const bool is_of_part_only = has_edge(rim_before, edge.first, edge.second) &&
                                     !was_hard(edge) && !std::ranges::binary_search(rim_now, edge);
        if (!is_of_part_only) mesh.hard.push_back(edge);
    }
}

bool is_improvable(const CurvedSurface& curved, const RemeshOptions& options) {
    return is_relaxed(options) && !options.sites && !curved.has_junctions();
}

void improve(const CurvedSurface& curved, CrossingFinder& finder, PlacedMesh& mesh,
             std::optional<CrossingFaces>& crossings, const StageContext& context,
             const ShapeBounds* bounds) {
    const MeshCurves curves = curved.curves();
    std::vector<Mobility> mobility = find_mobility(curved, curves, mesh);
    for (int round = 0; round < most_tries; ++round) {
        PlacedMesh improved = mesh;
        std::vector<Index> numbers;
        {
            const StageClock clock(Stage::Place, context.result);
            const double most_share =
                context.options.bounds.has_any() ? 1 : most_beyond_aims(context.options);
            const Progress progress = progress_at(Stage::Place, context.options, 1);
            numbers = bounds != nullptr
                          ? keep_bounds(curves, mobility, *bounds, most_share, improved, progress)
                          : repair_shape(curves, mobility, improved, progress);
        }
        if (numbers.empty()) return;
        std::optional<FacePairs> pairs = finder.find(improved);
        if (!pairs || pairs->size() <= crossings->all.size()) {
            if (pairs) crossings = finder.tell_added(improved, *std::move(pairs));
            mesh = std::move(improved);
            return;
        }
        for_each_corner(*pairs, improved.triangles, [&](Index v) {
            const Index before = numbers[v];
            if (before < mobility.size()) mobility[before] = Mobility::Fixed;
        });
    }
}

void part_faces(const CurvedSurface& curved, CrossingFinder& finder, PlacedMesh& mesh,
                std::optional<CrossingFaces>& crossings, const StageContext& context) {
    if (pairs_to_part(crossings).empty()) return;
    const MeshCurves curves = curved.curves();
    const Progress progress = progress_at(Stage::Place, context.options, 1);
    // \return whether fewer pairs are left.
    const auto try_edits = [&](const auto& edit) {
        const FacePairs pairs = pairs_to_part(crossings);
        if (pairs.empty()) return false;
        PlacedMesh parted = mesh;
        {
            const StageClock clock(Stage::Place, context.result);
            if (!edit(pairs, find_mobility(curved, curves, mesh), parted)) return false;
        }
        CrossingFaces left = finder.tell_added(parted, *finder.find(parted));
        if (left.added.size() >= pairs.size()) return false;
        mesh = std::move(parted);
        crossings = std::move(left);
        return true;
    };
    const auto repair = [&](const FacePairs& pairs, std::span<const Mobility> mobility,
                            PlacedMesh& parted) {
        return !repair_crossings(curves, mobility, pairs, parted, progress).empty();
    };
    // Creases are left last. The sheets of wraps are so thin that needles would come of it.
    for (const Mobility most : {Mobility::Free, Mobility::Boundary}) {
        const auto push = [&](const FacePairs& pairs, std::span<const Mobility> mobility,
                              PlacedMesh& parted) {
            return push_apart(curves, mobility, pairs, most, parted, progress);
        };
        const bool is_pushed = !context.options.wrap && try_edits(push);
        if (most == Mobility::Boundary && !is_pushed) return;
        for (int round = 0; round < most_partings && try_edits(repair); ++round) {
        }
    }
}

bool free_creases(const CurvedSurface& curved, const std::optional<CrossingFaces>& crossings,
                  const ShapeBounds& aims, PlacedMesh& mesh, const StageContext& context) {
    const TriangleMesh whole = whole_mesh(*curved.whole, mesh);
    std::vector<Index> bad;
    for (const auto& [f, g] : pairs_to_part(crossings)) bad.insert(bad.end(), {f, g});
    for (Index f = 0; f < whole.triangles.size(); ++f) {
        if (is_flat(whole.positions, whole.triangles[f])) bad.push_back(f);
    }
    // Narrow faces are no reason to give up what the caller marked.
    const RemeshOptions& options = context.options;
    const bool has_marked = !options.feature_edges.empty() || !options.face_labels.empty() ||
                            !options.texture_seams.empty();
    if (!options.bounds.has_any() && !has_marked) {
        const std::vector<Index> narrow =
            narrow_faces(mesh, whole, aims, most_beyond_aims(context.options));
        bad.insert(bad.end(), narrow.begin(), narrow.end());
    }
    if (bad.empty() || are_too_many(bad.size(), mesh.triangles.size())) return false;
    std::vector<std::uint8_t> is_bad(mesh.points.size(), 0);
    for (const Index f : bad) {
        for (const Index v : mesh.triangles[f]) is_bad[v] = 1;
    }
    const std::vector<DirectedEdge> rim = rim_of(mesh.triangles);
    FeatureCounts& counts = context.result.features;
    double longest = 0;
    const double before = counts.freed_length;
    std::erase_if(mesh.hard, [&](const DirectedEdge& edge) {
        const auto [from, to] = edge;
        if ((is_bad[from] == 0 && is_bad[to] == 0) || has_edge(rim, from, to)) return false;
        const Vec3 &a = whole.positions[from], &b = whole.positions[to];
        const double length = (b - a).norm();
        counts.freed_length += length / 2;  // Inner edges come once for each side.
        if (length > longest) {
            longest = length;
            counts.freed_near = (a + b) / 2;
        }
        return true;
    });
    counts.length -= counts.freed_length - before;
    return counts.freed_length > before;
}

}  // namespace remesh::detail
