#include "remesh/relax/even_out.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/random.h"
#include "remesh/relax/site_labels.h"
#include "remesh/relax/walk.h"

namespace remesh::detail {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::SurfacePoint;

// Cells larger than this many means get more sites, those below that many may be given up.
// Independent random points stay below the first.
constexpr double too_large = 4;
constexpr double too_small = 0.25;
constexpr int most_rounds = 4;
// Any will do.
constexpr std::uint64_t seed = 0x5eed;

// The faces of each cell, by the label of their first corner.
class CellFaces {
public:
    CellFaces(const agvd::Surface& surface, const agvd::DistanceBounds& labels, Index num_sites)
        : begin_(num_sites + 1, 0) {
        const auto cell = [&](Index f) { return labels.site[surface.mesh.triangles[f][0]]; };
        for (Index f = 0; f < surface.num_faces(); ++f) {
            if (cell(f) != no_index) ++begin_[cell(f) + 1];
        }
        for (Index i = 0; i < num_sites; ++i) begin_[i + 1] += begin_[i];
        faces_.resize(begin_.back());
        std::vector<Index> next(begin_.begin(), begin_.end() - 1);
        for (Index f = 0; f < surface.num_faces(); ++f) {
            if (cell(f) != no_index) faces_[next[cell(f)]++] = f;
        }
    }

    [[nodiscard]] std::span<const Index> of(Index site) const {
        return std::span(faces_).subspan(begin_[site], begin_[site + 1] - begin_[site]);
    }

private:
    std::vector<Index> begin_;  // #sites + 1
    std::vector<Index> faces_;
};

class EvenOut {
public:
    EvenOut(const agvd::Surface& surface, const agvd::SurfaceLayout& layout,
            std::vector<SurfacePoint>& sites, std::span<const std::uint8_t> is_fixed,
            int num_threads)
        : surface_(surface),
          layout_(layout),
          sites_(sites),
          is_fixed_(is_fixed),
          num_threads_(num_threads) {}

    Index run() {
        Index num_moved = 0;
        for (int round = 0; round < most_rounds; ++round) {
            const Index now = improve(round);
            if (now == 0) break;
            num_moved += now;
        }
        return num_moved;
    }

private:
    // Returns the number of sites moved.
    Index improve(int round) {
        const auto num_sites = static_cast<Index>(sites_.size());
        const agvd::DistanceBounds labels = label_vertices(surface_, layout_, sites_, num_threads_);
        const std::vector<double> areas = measure_cells(surface_, labels, num_sites).area;
        double sum = 0;
        for (const double a : areas) sum += a;
        const double mean = sum / num_sites;

        std::vector<std::pair<double, Index>> small;
        for (Index i = 0; i < num_sites; ++i) {
            const bool may_move = (is_fixed_.empty() || is_fixed_[i] == 0) &&
                                  !boundary_half_edge(surface_, sites_[i]);
            if (may_move && areas[i] < too_small * mean) small.emplace_back(areas[i], i);
        }
        std::sort(small.begin(), small.end());
        if (small.empty() || *std::max_element(areas.begin(), areas.end()) <= too_large * mean) {
            return 0;
        }
        const CellFaces cells(surface_, labels, num_sites);
        auto next = small.begin();
        std::vector<double> area_up_to;  // Of the faces of a cell.
        for (Index i = 0; i < num_sites; ++i) {
            const std::span<const Index> faces = cells.of(i);
            if (areas[i] <= too_large * mean || faces.empty()) continue;
            area_up_to.clear();
            double total = 0;
            for (const Index f : faces) area_up_to.push_back(total += doubled_area(f));
            const double missing = std::floor(areas[i] / mean) - 1;
            for (double k = 0; k < missing && next != small.end(); ++k, ++next) {
                const auto number = static_cast<std::uint64_t>(next - small.begin());
                sites_[next->second] =
                    draw(faces, area_up_to, static_cast<std::uint64_t>(round), number);
            }
        }
        return static_cast<Index>(next - small.begin());
    }

    // A random point of some faces, by area.
    static SurfacePoint draw(std::span<const Index> faces, const std::vector<double>& area_up_to,
                             std::uint64_t round, std::uint64_t number) {
        const auto unit = [&](std::uint64_t k) {
            return agvd::random_unit(seed, round, 3 * number + k);
        };
        const auto found =
            std::upper_bound(area_up_to.begin(), area_up_to.end(), unit(0) * area_up_to.back());
        const auto slot =
            std::min(static_cast<std::size_t>(found - area_up_to.begin()), faces.size() - 1);
        const double root = std::sqrt(unit(1));  // Uniform in the triangle.
        const double b1 = root * (1 - unit(2)), b2 = root * unit(2);
        return {agvd::FaceId(faces[slot]), {1 - b1 - b2, b1, b2}};
    }
    [[nodiscard]] double doubled_area(Index face) const {
        return surface_.length_of(3 * face) * surface_.apex[3 * face].y();
    }

    const agvd::Surface& surface_;
    const agvd::SurfaceLayout& layout_;
    std::vector<SurfacePoint>& sites_;
    std::span<const std::uint8_t> is_fixed_;
    int num_threads_;
};

}  // namespace

Index even_out(const agvd::Surface& surface, const agvd::SurfaceLayout& layout,
               std::vector<SurfacePoint>& sites, std::span<const std::uint8_t> is_fixed,
               int num_threads) {
    return EvenOut(surface, layout, sites, is_fixed, num_threads).run();
}

}  // namespace remesh::detail
