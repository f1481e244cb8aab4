// Runs the passes of soup.h after a quick check whether the input needs none. Sides are sorted
// again only after passes that changed a triangle.
#include "remesh/clean/clean_input.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/coincident.h"
#include "remesh/clean/soup.h"

namespace remesh {
namespace detail {
namespace {

Soup as_soup(const MeshView& mesh, Ticker ticker) {
    Soup soup;
    soup.ticker = ticker;
    soup.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
    soup.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    ticker.poll();
    soup.vertex_origin.resize(soup.mesh.positions.size());
    soup.face_origin.resize(soup.mesh.triangles.size());
    std::iota(soup.vertex_origin.begin(), soup.vertex_origin.end(), Index{0});
    std::iota(soup.face_origin.begin(), soup.face_origin.end(), Index{0});
    ticker.poll();
    return soup;
}

std::vector<Index> open_half_edges(std::span<const Index> twin) {
    std::vector<Index> open;
    for (Index h = 0; h < twin.size(); ++h) {
        if (twin[h] == no_index) open.push_back(h);
    }
    return open;
}

// Whether build_surface finds an area at all corners. Where that of one is a millionth of the
// sides' squares, rounding cannot take it away at the others: a third of the instructions.
bool has_area(std::span<const Vec3> positions, const Triangle& t) {
    constexpr double plenty = 1e-6;
    const Vec3 along = positions[t[1]] - positions[t[0]];
    const Vec3 up = positions[t[2]] - positions[t[0]];
    const double longest_sq = std::max(along.squaredNorm(), up.squaredNorm());
    const double least = plenty * longest_sq;
    const double doubled_area_sq = along.cross(up).squaredNorm();
    if (doubled_area_sq > least * least && std::isfinite(doubled_area_sq)) return true;
    const double area = smallest_doubled_area(positions, t);
    return area > 0 && std::isfinite(area);
}

// The input unchanged, if it has no defect. Makes linear passes only.
std::optional<CleanResult> take_clean(const MeshView& mesh, const MeshBox& box,
                                      const CleanOptions& options) {
    const int num_threads = options.num_threads;
    const Progress& progress = options.progress;
    Poller poller(progress);
    Ticker ticker(poller);
    std::optional<Connectivity> found = find_connectivity(mesh, progress);
    if (!found || found->outgoing.empty()) return std::nullopt;
    const std::vector<Index>& twin = found->twin;
    const std::vector<Index>& outgoing = found->outgoing;
    if (std::find(outgoing.begin(), outgoing.end(), no_index) != outgoing.end()) {
        return std::nullopt;  // An isolated vertex.
    }
    const auto apex = [&](Index h) { return mesh.triangles[h / 3][previous_half_edge(h) % 3]; };
    std::atomic<bool> is_clean = true, may_coincide = label_components(twin, ticker).count > 1;
    const double shortest = zero_length(box);
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    const auto check_face = [&](Index f) {
        const Triangle& t = mesh.triangles[f];
        bool is_good = has_area(mesh.positions, t);
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Vec3& tail = mesh.positions[t[h % 3]];
            is_good = is_good && (mesh.positions[t[(h + 1) % 3]] - tail).norm() > shortest;
            is_good = is_good && (twin[h] == no_index || apex(h) != apex(twin[h]));
            if (twin[h] < h && is_folded(mesh, h, twin[h])) {
                may_coincide.store(true, std::memory_order_relaxed);
            }
        }
        if (!is_good) is_clean.store(false, std::memory_order_relaxed);
    };
    parallel_each(num_faces, pass_grain, num_threads, check_face, poller);
    if (!is_clean) return std::nullopt;
    if (may_coincide &&
        !find_coincident(mesh, sorted_edge_sides(mesh.triangles, ticker), ticker).empty()) {
        return std::nullopt;
    }
    std::vector<bool> is_boundary(outgoing.size());
    for (Index v = 0; v < outgoing.size(); ++v) {
        ticker.tick();
        is_boundary[v] = twin[outgoing[v]] == no_index;
    }
    const bool is_open = std::ranges::find(is_boundary, true) != is_boundary.end();
    if (is_open && options.fill_holes > 0) return std::nullopt;
    if (!options.keep_slits) {
        const std::vector<Index> first =
            find_common_positions(mesh, is_boundary, ticker, options.weld).first;
        for (Index v = 0; v < first.size(); ++v) {
            if (first[v] != no_index && first[v] != v) return std::nullopt;  // Possibly a crack.
        }
        if (!find_divisions(mesh, open_half_edges(twin), options.weld, ticker).empty()) {
            return std::nullopt;
        }
    }
    Soup soup = as_soup(mesh, ticker);
    soup.connectivity = *std::move(found);
    return soup;
}

void check_options(const CleanOptions& options) {
    if (!(options.weld >= 0 && std::isfinite(options.weld))) {
        throw InvalidOption("weld is " + std::to_string(options.weld) +
                            "; use a length of 0 or more");
    }
    if (options.weld > 0 && options.keep_slits) {
        throw InvalidOption("weld and keep_slits are given; leave out one of them");
    }
}

void check_not_empty(const Soup& soup) {
    if (!soup.mesh.triangles.empty()) return;
    throw InvalidInput("the mesh has no face with an area; check that the file holds a surface");
}

}  // namespace

void check_elements(const MeshView& mesh, Ticker ticker) {
    if (mesh.triangles.size() > no_index / 3 || mesh.positions.size() >= no_index) {
        throw InvalidInput("the mesh has more than 2^32 / 3 faces; split it into parts");
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick();
        if (mesh.positions[v].allFinite()) continue;
        throw InvalidInput("vertex " + std::to_string(v) +
                           " has a coordinate that is not finite; correct or delete the vertex");
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        for (const Index v : mesh.triangles[f]) {
            if (v < mesh.positions.size()) continue;
            throw InvalidInput("face " + std::to_string(f) + " names vertex " + index_text(v) +
                               ", but the mesh has only " + std::to_string(mesh.positions.size()) +
                               " vertices, counted from 0; correct or delete the face");
        }
    }
}

Index drop_faces(Soup& soup, const std::vector<bool>& is_dead, std::vector<Index>* twin) {
    const auto dropped = static_cast<Index>(std::count(is_dead.begin(), is_dead.end(), true));
    if (dropped == 0) return 0;
    std::vector<Index> new_face(soup.mesh.triangles.size(), no_index);
    Index count = 0;
    for (Index f = 0; f < new_face.size(); ++f) {
        soup.ticker.tick();
        if (is_dead[f]) continue;
        new_face[f] = count;
        soup.mesh.triangles[count] = soup.mesh.triangles[f];
        soup.face_origin[count] = soup.face_origin[f];
        ++count;
    }
    soup.mesh.triangles.resize(count);
    soup.face_origin.resize(count);
    if (twin == nullptr) return dropped;
    for (Index h = 0; h < twin->size(); ++h) {
        soup.ticker.tick();
        if (new_face[h / 3] == no_index) continue;
        const Index across = (*twin)[h];
        const bool is_open = across == no_index || new_face[across / 3] == no_index;
        (*twin)[3 * new_face[h / 3] + h % 3] =
            is_open ? no_index : 3 * new_face[across / 3] + across % 3;
    }
    twin->resize(3 * std::size_t{count});
    return dropped;
}

bool drop_repeated_corners(Soup& soup) {
    std::vector<bool> is_dead(soup.mesh.triangles.size());
    for (std::size_t f = 0; f < is_dead.size(); ++f) {
        soup.ticker.tick();
        const auto& [a, b, c] = soup.mesh.triangles[f];
        is_dead[f] = a == b || b == c || c == a;
    }
    const Index dropped = drop_faces(soup, is_dead);
    soup.counts.degenerate_faces += dropped;
    return dropped > 0;
}

void drop_isolated_vertices(Soup& soup) {
    const auto before = static_cast<Index>(soup.mesh.positions.size());
    const std::vector<Index> left = drop_unused(before, soup.mesh.triangles);
    if (left.size() == before) return;
    soup.counts.isolated_vertices +=
        before - static_cast<Index>(left.size()) - soup.counts.welded_vertices;
    soup.mesh.positions = take(soup.mesh.positions, left);
    soup.vertex_origin = take(soup.vertex_origin, left);
}

Index drop_components(CleanResult& clean, const Topology& topology, double least_share) {
    double area = 0;
    for (const ComponentTopology& c : topology.components) area += c.area;
    const auto goes = [&](const ComponentTopology& c) { return !(c.area >= least_share * area); };
    const auto dropped = std::ranges::count_if(topology.components, goes);
    if (dropped == 0) return 0;
    if (dropped == std::ssize(topology.components)) {
        throw InvalidOption("no component has " + std::to_string(100 * least_share) +
                            " % of the area or more; use a smaller drop_components");
    }
    clean.connectivity = {};
    const CleanCounts counts = clean.counts;  // Of the repair alone.
    Soup soup{std::move(clean)};
    std::vector<bool> is_dead;
    for (const Index c : topology.face_component) is_dead.push_back(goes(topology.components[c]));
    (void)drop_faces(soup, is_dead);
    drop_isolated_vertices(soup);
    clean = std::move(soup);
    clean.counts = counts;
    return static_cast<Index>(dropped);
}

}  // namespace detail

CleanResult clean_input(const MeshView& mesh, const CleanOptions& options) {
    using namespace detail;
    check_options(options);
    Poller poller(options.progress);
    Ticker ticker(poller);
    check_elements(mesh, ticker);
    const MeshBox box = box_of(mesh, options.num_threads);
    check_scale(box);
    check_digits(box);
    check_spread(mesh, box);
    check_width(mesh, ticker);
    const auto count_loose = [&](const MeshView& cleaned, std::span<const Index> twin) {
        if (options.keep_slits) return Index{0};
        const double reach = loose_share * box.longest_side();
        return static_cast<Index>(
            find_divisions(cleaned, open_half_edges(twin), reach, ticker).size());
    };
    if (std::optional<CleanResult> clean = take_clean(mesh, box, options)) {
        clean->loose_vertices = count_loose(clean->mesh, clean->connectivity.twin);
        return *std::move(clean);
    }
    Soup soup = as_soup(mesh, ticker);

    std::vector<EdgeSide> sides = sorted_edge_sides(soup.mesh.triangles, soup.ticker);
    const auto refresh = [&](bool is_changed) {
        if (is_changed) sides = sorted_edge_sides(soup.mesh.triangles, soup.ticker);
    };
    const bool is_collapsed = collapse_zero_edges(soup, zero_length(box));
    refresh(drop_repeated_corners(soup) || is_collapsed);
    if (!options.keep_slits) {
        refresh(divide_edges(soup, sides, options.weld));
        refresh(weld_cracks(soup, sides, options.weld));
        refresh(drop_repeated_corners(soup));
    }
    refresh(drop_duplicates(soup, sides));
    refresh(drop_slivers(soup, sides));
    check_not_empty(soup);
    refresh(orient_faces(soup, sides));
    std::vector<Index> twin = pair_sheets(soup, sides);
    remove_degenerate_faces(soup, twin);
    check_not_empty(soup);
    split_vertices(soup, twin);
    soup.loose_vertices = count_loose(soup.mesh, twin);
    drop_isolated_vertices(soup);
    if (options.fill_holes > 0) fill_holes(soup, options.fill_holes);

    return soup;
}

}  // namespace remesh
