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
struct CellFaces {
    std::vector<Index> begin;  // #sites + 1
    std::vector<Index> faces;

    CellFaces(const agvd::Surface& surface, const agvd::DistanceBounds& labels, Index num_sites)
        : begin(num_sites + 1, 0) {
        const auto cell = [&](Index f) { return labels.site[surface.mesh.triangles[f][0]]; };
        for (Index f = 0; f < surface.num_faces(); ++f) {
            if (cell(f) != no_index) ++begin[cell(f) + 1];
        }
        for (Index i = 0; i < num_sites; ++i) begin[i + 1] += begin[i];
        faces.resize(begin.back());
        std::vector<Index> next(begin.begin(), begin.end() - 1);
        for (Index f = 0; f < surface.num_faces(); ++f) {
            if (cell(f) != no_index) faces[next[cell(f)]++] = f;
        }
    }
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

    void run() {
        for (int round = 0; round < most_rounds; ++round) {
            if (!improve(round)) return;
        }
    }

private:
    bool improve(int round) {
        const auto num_sites = static_cast<Index>(sites_.size());
        const agvd::DistanceBounds labels = label_vertices(surface_, layout_, sites_, num_threads_);
        const std::vector<double> areas = label_areas(surface_, labels, num_sites);
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
            return false;
        }
        const CellFaces cells(surface_, labels, num_sites);
        auto next = small.begin();
        for (Index i = 0; i < num_sites; ++i) {
            if (areas[i] <= too_large * mean) continue;
            const double missing = std::floor(areas[i] / mean) - 1;
            for (double k = 0; k < missing && next != small.end(); ++k, ++next) {
                sites_[next->second] = draw(cells, i, static_cast<std::uint64_t>(round),
                                            static_cast<std::uint64_t>(next - small.begin()));
            }
        }
        return true;
    }

    // A random point of a cell, by area.
    [[nodiscard]] SurfacePoint draw(const CellFaces& cells, Index cell, std::uint64_t round,
                                    std::uint64_t number) const {
        const auto unit = [&](std::uint64_t k) {
            return agvd::random_unit(seed, round, 3 * number + k);
        };
        const Index begin = cells.begin[cell], end = cells.begin[cell + 1];
        double sum = 0;
        for (Index i = begin; i < end; ++i) sum += doubled_area(cells.faces[i]);
        double pick = unit(0) * sum;
        Index i = begin;
        while (i + 1 < end && pick >= doubled_area(cells.faces[i])) {
            pick -= doubled_area(cells.faces[i]);
            ++i;
        }
        const double root = std::sqrt(unit(1));
        const double b1 = root * (1 - unit(2)), b2 = root * unit(2);
        return {agvd::FaceId(cells.faces[i]), {1 - b1 - b2, b1, b2}};
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

void even_out(const agvd::Surface& surface, const agvd::SurfaceLayout& layout,
              std::vector<SurfacePoint>& sites, std::span<const std::uint8_t> is_fixed,
              int num_threads) {
    EvenOut(surface, layout, sites, is_fixed, num_threads).run();
}

}  // namespace remesh::detail
