#include <remesh/remesh.h>

#include <algorithm>

int main() {
    const std::vector<agvd::Vec3> positions{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const std::vector<agvd::Triangle> triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    const agvd::Surface surface = agvd::build_surface({positions, triangles});
    const agvd::Index count = 500;
    const remesh::PreparedSurface prepared(surface, remesh::mean_spacing(surface, count));
    const auto start = remesh::sample_sites(surface, {.num_samples = count});
    // Goes on until three steps in a row have brought no lower energy.
    const auto goes_on = [](const remesh::RelaxLevel& level) {
        const auto& energy = level.energy;  // Before the first step, and after each.
        return energy.end() - std::min_element(energy.begin(), energy.end()) <= 3;
    };
    const auto relaxed = remesh::relax_sites(prepared, start, {.goes_on = goes_on});
    const auto result =
        remesh::remesh({positions, triangles}, {.sites = relaxed.sites, .keep_sites = true});
    const std::vector<double>& energy = relaxed.levels.back().energy;
    return energy[1] < energy[0] && energy.size() < 60 && result.mesh.positions.size() == count ? 0
                                                                                                : 1;
}
