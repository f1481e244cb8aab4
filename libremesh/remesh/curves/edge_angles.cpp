// Joins thin faces with neighbours into patches that are not thin: a union-find over the sides of
// thin faces, in order of merit. The angle at an edge is that between the vector areas of the two
// patches. `thin` is a height in mesh units.
#include "remesh/curves/edge_angles.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/parallel.h"
#include "agvd/mesh/surface.h"

namespace remesh::detail {
namespace {

constexpr Index edges_per_task = 4096;

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Faces joined into patches. A patch is named by its root.
struct Patches {
    std::vector<Index> parent;    // #F.
    std::vector<Vec3> area;       // #F: twice the vector area; at a root, of its patch.
    std::vector<double> longest;  // #F: longest side; at a root, of its patch.

    [[nodiscard]] Index root(Index f) {
        while (parent[f] != f) f = parent[f] = parent[parent[f]];
        return f;
    }
    // The same for threads side by side: paths stay as they are.
    [[nodiscard]] Index root_of(Index f) const {
        while (parent[f] != f) f = parent[f];
        return f;
    }
    [[nodiscard]] bool is_thin(Index root, double thin) const {
        return area[root].norm() < thin * longest[root];
    }
    void join(Index a, Index b) {
        if (b < a) std::swap(a, b);
        parent[b] = a;
        area[a] += area[b];
        longest[a] = std::max(longest[a], longest[b]);
    }
};

Patches single_faces(const Surface& surface, int num_threads, Poller& poller) {
    const Index count = surface.num_faces();
    Patches patches{std::vector<Index>(count), std::vector<Vec3>(count),
                    std::vector<double>(count)};
    const auto& p = surface.mesh.positions;
    parallel_chunks(
        count, edges_per_task, num_threads,
        [&](Index, Index begin, Index end) {
            for (Index f = begin; f < end; ++f) {
                const auto& [a, b, c] = surface.mesh.triangles[f];
                patches.parent[f] = f;
                patches.area[f] = (p[b] - p[a]).cross(p[c] - p[a]);
                patches.longest[f] =
                    std::max({surface.length_of(3 * f), surface.length_of(3 * f + 1),
                              surface.length_of(3 * f + 2)});
            }
        },
        poller);
    return patches;
}

// Ascending.
std::vector<Index> find_thin_faces(const Surface& surface, const Patches& patches, double thin,
                                   int num_threads, Poller& poller) {
    std::vector<std::vector<Index>> found(num_chunks(surface.num_faces(), edges_per_task));
    const auto find = [&](Index chunk, Index begin, Index end) {
        for (Index f = begin; f < end; ++f) {
            if (patches.is_thin(f, thin)) found[chunk].push_back(f);
        }
    };
    parallel_chunks(surface.num_faces(), edges_per_task, num_threads, find, poller);
    std::vector<Index> faces;
    for (const std::vector<Index>& some : found) {
        faces.insert(faces.end(), some.begin(), some.end());
    }
    return faces;
}

// A side of a thin face, and the merit of joining the face across it. Long sides come first: only
// across them a needle gains height. Sides to faces of the same direction come before others: a
// needle in a plane belongs to that plane. The needle's own direction may be rounding, so a long
// side to a face of another direction still counts for a tenth.
struct Seam {
    double merit;
    Index edge;
};

std::vector<Seam> seams_of_thin_faces(const Surface& surface, const Patches& patches, double thin,
                                      int num_threads, Poller& poller) {
    Ticker ticker(poller);
    std::vector<Seam> seams;
    for (const Index f : find_thin_faces(surface, patches, thin, num_threads, poller)) {
        ticker.tick();
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index twin = surface.twin[h];
            if (twin == no_index) continue;
            const Index across = Surface::face(twin);
            if (across < f && patches.is_thin(across, thin)) continue;  // Added from there.
            const double turn = angle_between(patches.area[f], patches.area[across]);
            const double likeness = 0.1 + std::pow((1 + std::cos(turn)) / 2, 8);
            seams.push_back({surface.length_of(h) * likeness, surface.edge[h]});
        }
    }
    sort_ticked(seams, ticker, [](const Seam& a, const Seam& b) {
        return a.merit != b.merit ? a.merit > b.merit : a.edge < b.edge;
    });
    return seams;
}

void join_thin_faces(const Surface& surface, double thin, int num_threads, Patches& patches,
                     Poller& poller) {
    Ticker ticker(poller);
    for (const Seam& seam : seams_of_thin_faces(surface, patches, thin, num_threads, poller)) {
        ticker.tick();
        const Index h = surface.edge_half[seam.edge];
        const Index a = patches.root(Surface::face(h));
        const Index b = patches.root(Surface::face(surface.twin[h]));
        if (a != b && (patches.is_thin(a, thin) || patches.is_thin(b, thin))) patches.join(a, b);
    }
}

}  // namespace

std::vector<double> edge_angles(const Surface& surface, double thin, int num_threads,
                                Poller& poller) {
    Patches patches = single_faces(surface, num_threads, poller);
    join_thin_faces(surface, thin, num_threads, patches, poller);
    std::vector<double> angles(surface.num_edges());
    parallel_chunks(
        surface.num_edges(), edges_per_task, num_threads,
        [&](Index, Index begin, Index end) {
            for (Index e = begin; e < end; ++e) {
                const Index h = surface.edge_half[e];
                if (surface.twin[h] == no_index) continue;
                const Index a = patches.root_of(Surface::face(h));
                const Index b = patches.root_of(Surface::face(surface.twin[h]));
                if (a != b) angles[e] = angle_between(patches.area[a], patches.area[b]);
            }
        },
        poller);
    return angles;
}

}  // namespace remesh::detail
