// Exact distances by CGAL's Surface_mesh_shortest_path ([xin2009]). The search from a site sees
// only the part of the surface within reach in space, which holds every shortest path that is no
// longer than the reach; the reach grows until all targets are answered. A search from all sites at
// once gives upper bounds, which tell which single sites must be asked.
//
// CGAL up to at least 5.5 has faults with sources on edges: the functions below say how each is
// avoided.
#include "paper/oracle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <string>

#include "agvd/core/error.h"
#include "agvd/core/parallel.h"

namespace agvd {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>;
using WindowTree = CGAL::Surface_mesh_shortest_path<Traits>;
using Location = WindowTree::Face_location;

// Keeps a bound above the distances it was made from.
constexpr double rounding = 1 + 1e-9;
// The same for distances in space, relative to the coordinates.
constexpr double space_rounding = 1e-14;

// Barycentric coordinates below this are rounding: CGAL tells a point on an edge or vertex from one
// inside a face by exact zeros, and a source a rounding error off an edge has degenerate windows.
constexpr double barycentric_zero = 1e-14;

// A set of faces of the surface as a CGAL mesh of its own.
struct Part {
    CgalMesh mesh;
    std::vector<Index> local_face;  // #F of the surface: its index in `mesh`; no_index if left out.
};

// Faces that meet at a vertex without being joined through edges of the part get copies of that
// vertex, so that any set of faces is a manifold.
Part make_part(const Surface& surface, const std::vector<char>& is_inside, Index num_inside) {
    Part part;
    part.local_face.assign(surface.num_faces(), no_index);
    part.mesh.reserve(num_inside, 2 * num_inside, num_inside);
    std::vector<CgalMesh::Vertex_index> corner(surface.twin.size());
    const auto across = [&](Index h) {
        const Index twin = surface.twin[h];
        return twin != no_index && is_inside[Surface::face(twin)] ? twin : no_index;
    };
    const auto name_fan = [&](Index start) {
        Index first = start;  // Turn clockwise to the first half-edge of the fan, or once around.
        for (Index h = across(start); h != no_index; h = across(first)) {
            first = Surface::next(h);
            if (first == start) break;
        }
        const Vec3& p = surface.mesh.positions[surface.tail(start)];
        const CgalMesh::Vertex_index vertex = part.mesh.add_vertex({p.x(), p.y(), p.z()});
        Index h = first;
        do {
            corner[h] = vertex;
            h = across(Surface::previous(h));
        } while (h != no_index && h != first);
    };
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (!is_inside[f]) continue;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (corner[h] == CgalMesh::null_vertex()) name_fan(h);
        }
    }
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (!is_inside[f]) continue;
        const CgalMesh::Face_index face =
            part.mesh.add_face(corner[3 * f], corner[3 * f + 1], corner[3 * f + 2]);
        if (face == CgalMesh::null_face()) {
            throw InvalidInput("CGAL cannot add face " + std::to_string(f) +
                               " to its mesh; repair the mesh first (remesh::clean_input)");
        }
        // CGAL's barycentric coordinates count from the tail of the face's half-edge.
        part.mesh.set_halfedge(face, part.mesh.halfedge(corner[3 * f], corner[3 * f + 1]));
        part.local_face[f] = face;
    }
    return part;
}

Part whole(const Surface& surface) {
    return make_part(surface, std::vector<char>(surface.num_faces(), 1), surface.num_faces());
}

// CGAL wants coordinates that add up to exactly 1.
Location locate(const Part& part, const SurfacePoint& point) {
    std::array<double, 3> b = point.barycentric;
    for (double& c : b) c = c < barycentric_zero ? 0 : c;
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](auto i, auto j) { return b[i] < b[j]; });
    const auto [low, mid, high] = order;
    b[high] = 1 - (b[low] + b[mid]);
    if (b[low] == 0) b[mid] = 1 - b[high];
    return {CgalMesh::Face_index(part.local_face[point.face.value()]), {b[0], b[1], b[2]}};
}

// CGAL up to at least 5.5 takes a source on an edge for its mirror image on that edge (it hands the
// weight of the tail to a function that wants the distance from the tail). Ask it on a square.
bool mirrors_edge_sources() {
    CgalMesh square;
    const auto a = square.add_vertex({0, 0, 0}), b = square.add_vertex({1, 0, 0});
    const auto c = square.add_vertex({1, 1, 0}), d = square.add_vertex({0, 1, 0});
    const auto face = square.add_face(a, b, c);
    square.add_face(a, c, d);
    square.set_halfedge(face, square.halfedge(a, b));
    WindowTree tree(square);
    tree.add_source_point(face, {0.25, 0, 0.75});
    return tree.shortest_distance_to_source_points(a).first < 1;  // At 1.06 when right.
}

WindowTree::Source_point_iterator add_source(WindowTree& tree, const Part& part,
                                             const SurfacePoint& site) {
    static const bool is_mirrored = mirrors_edge_sources();
    Location at = locate(part, site);
    if (is_mirrored) {
        auto& b = at.second;
        for (std::size_t k = 0; k < 3; ++k) {
            if (b[k] == 0 && b[(k + 1) % 3] != 0 && b[(k + 2) % 3] != 0) {
                std::swap(b[(k + 1) % 3], b[(k + 2) % 3]);
                break;
            }
        }
    }
    return tree.add_source_point(at);
}

double ask(WindowTree& tree, const Part& part, const SurfacePoint& target) {
    const Location at = locate(part, target);
    const double distance = tree.shortest_distance_to_source_points(at.first, at.second).first;
    return distance < 0 ? infinity : distance;
}

// Exactly between two of CGAL's windows, such as straight behind a vertex, rounding may let a point
// fall into neither. The path over a place close by, off all such lines, has the same length then.
double distance_to(WindowTree& tree, const Surface& surface, const Part& part,
                   const SurfacePoint& target) {
    constexpr double step = 1e-12;
    constexpr std::array<double, 3> towards{0.2, 0.3, 0.5};
    SurfacePoint close = target;
    for (std::size_t k = 0; k < 3; ++k) {
        close.barycentric[k] += step * (towards[k] - close.barycentric[k]);
    }
    const MeshView mesh = surface.mesh.view();
    return std::min(
        ask(tree, part, target),
        ask(tree, part, close) + (position(mesh, close) - position(mesh, target)).norm());
}

// Distance of each target from the nearest of the sites.
std::vector<double> search(const Surface& surface, const Part& part,
                           std::span<const SurfacePoint> sites,
                           std::span<const SurfacePoint> targets) {
    WindowTree tree(part.mesh);
    for (const SurfacePoint& site : sites) add_source(tree, part, site);
    std::vector<double> distances;
    distances.reserve(targets.size());
    for (const SurfacePoint& target : targets) {
        distances.push_back(distance_to(tree, surface, part, target));
    }
    return distances;
}

// At least every face that comes within `reach` of a place in space, hence along the surface too.
std::vector<char> faces_within(const Surface& surface, const Vec3& place, double reach) {
    std::vector<char> is_inside(surface.num_faces());
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const auto& [a, b, c] = surface.mesh.triangles[f];
        const auto& p = surface.mesh.positions;
        const Vec3 centre = (p[a] + p[b] + p[c]) / 3;
        const double radius =
            std::sqrt(std::max({(p[a] - centre).squaredNorm(), (p[b] - centre).squaredNorm(),
                                (p[c] - centre).squaredNorm()}));
        is_inside[f] = (centre - place).norm() - radius <= reach;
    }
    return is_inside;
}

// The part of the surface within `reach` of the site holds every shortest path no longer than that,
// and no path in it is shorter than the shortest on the surface: distances up to `reach` are exact,
// longer ones upper bounds.
std::vector<double> distances_within(const Surface& surface, const SurfacePoint& site,
                                     std::span<const SurfacePoint> targets, double reach) {
    if (targets.empty()) return {};
    std::vector<char> is_inside = faces_within(surface, position(surface.mesh.view(), site), reach);
    is_inside[site.face.value()] = 1;  // Also when rounding says otherwise.
    for (const SurfacePoint& target : targets) is_inside[target.face.value()] = 1;
    const auto num_inside = static_cast<Index>(std::count(is_inside.begin(), is_inside.end(), 1));
    return search(surface, make_part(surface, is_inside, num_inside), {&site, 1}, targets);
}

// Calls answer(s) for each site in parallel; of several failures the one of the lowest site is
// thrown, so that every run fails alike.
void for_each_site(std::size_t num_sites, int num_threads,
                   const std::function<void(Index)>& answer) {
    std::vector<std::exception_ptr> failures(num_sites);
    parallel_chunks(static_cast<Index>(num_sites), 1, num_threads, [&](Index s, Index, Index) {
        try {
            answer(s);
        } catch (...) {
            failures[s] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures) {
        if (failure) std::rethrow_exception(failure);
    }
}

}  // namespace

std::vector<double> exact_distances(const Surface& surface, const SurfacePoint& site,
                                    std::span<const SurfacePoint> targets) {
    constexpr double first_reach = 1.2;  // Times the farthest target's distance in space.
    const Vec3 centre = position(surface.mesh.view(), site);
    double reach = 0;
    for (const SurfacePoint& target : targets) {
        reach =
            std::max(reach, first_reach * (position(surface.mesh.view(), target) - centre).norm());
    }
    for (;;) {
        std::vector<double> distances = distances_within(surface, site, targets, reach);
        double longest = 0;
        for (const double distance : distances) longest = std::max(longest, distance);
        if (longest <= reach || reach == infinity) return distances;
        reach = rounding * longest;  // What is found now is no longer; or all of the surface.
    }
}

std::vector<std::vector<double>> exact_distances(const Surface& surface,
                                                 std::span<const SurfacePoint> sites,
                                                 std::span<const std::vector<SurfacePoint>> targets,
                                                 int num_threads) {
    if (sites.size() != targets.size()) {
        throw InvalidInput("there are " + std::to_string(sites.size()) + " sites, but " +
                           std::to_string(targets.size()) +
                           " lists of targets; give one list for each site");
    }
    std::vector<std::vector<double>> distances(sites.size());
    for_each_site(sites.size(), num_threads,
                  [&](Index s) { distances[s] = exact_distances(surface, sites[s], targets[s]); });
    return distances;
}

std::vector<double> distances_by_one_search(const Surface& surface,
                                            std::span<const SurfacePoint> sites,
                                            std::span<const SurfacePoint> targets) {
    return search(surface, whole(surface), sites, targets);
}

// The search from all sites serves as an upper bound only: what decides are the distances from each
// site alone, of all sites that are near enough in space.
NearestSites exact_nearest_sites(const Surface& surface, std::span<const SurfacePoint> sites,
                                 std::span<const SurfacePoint> targets, int num_threads) {
    std::vector<Vec3> site_positions;
    for (const SurfacePoint& site : sites) {
        site_positions.push_back(position(surface.mesh.view(), site));
    }
    const std::vector<double> bounds = distances_by_one_search(surface, sites, targets);
    std::vector<std::vector<SurfacePoint>> asked(sites.size());
    std::vector<std::vector<Index>> asked_for(sites.size());
    std::vector<double> reach(sites.size(), 0);
    for (Index i = 0; i < targets.size(); ++i) {
        const double bound = rounding * bounds[i];
        const Vec3 place = position(surface.mesh.view(), targets[i]);
        for (std::size_t s = 0; s < sites.size(); ++s) {
            const double slack = space_rounding * (place.norm() + site_positions[s].norm());
            if (!((place - site_positions[s]).norm() <= bound + slack)) continue;
            asked[s].push_back(targets[i]);
            asked_for[s].push_back(i);
            reach[s] = std::max(reach[s], bound + slack);
        }
    }
    std::vector<std::vector<double>> distances(sites.size());
    for_each_site(sites.size(), num_threads, [&](Index s) {
        distances[s] = distances_within(surface, sites[s], asked[s], reach[s]);
    });
    NearestSites nearest{std::vector<double>(targets.size(), infinity),
                         std::vector<SiteId>(targets.size())};
    for (Index s = 0; s < sites.size(); ++s) {
        for (std::size_t k = 0; k < distances[s].size(); ++k) {
            const Index i = asked_for[s][k];
            if (!(distances[s][k] < nearest.distance[i])) continue;
            nearest.distance[i] = distances[s][k];
            nearest.site[i] = SiteId(s);
        }
    }
    return nearest;
}

}  // namespace agvd
