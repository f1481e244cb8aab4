// Energy and slope of cells that end at the rim, against sums over a fine grid.
#include "remesh/sites/cvt_energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using agvd::Index;
using agvd::Triangle;
using agvd::Vec3;
using remesh::detail::CvtEnergy;

namespace {

// Sites in the square [0, 2]^2: its corners, one inside that sees the lower side under more than a
// right angle, and one on the right side.
std::vector<Vec3> sites() {
    return {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1.1, .5, 0}, {2, .9, 0}};
}

const std::vector<Triangle> triangles{{0, 1, 4}, {1, 5, 4}, {5, 2, 4}, {2, 3, 4}, {3, 0, 4}};

CvtEnergy measure(const std::vector<Vec3>& at, double weight = 1) {
    const auto mesh = remesh::detail::build_site_mesh(triangles, static_cast<Index>(at.size()));
    agvd::Poller poller;
    agvd::Ticker ticker(poller);
    CvtEnergy result;
    measure_energy(mesh, at, std::vector<double>(at.size(), weight), ticker, result);
    return result;
}

struct Sums {
    double energy = 0;
    std::vector<double> area;
};

// Each point of the square belongs to the nearest site.
Sums sum_over_grid(const std::vector<Vec3>& at) {
    constexpr int n = 1000;
    constexpr double width = 2. / n;
    Sums sums{0, std::vector<double>(at.size(), 0)};
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const Vec3 x((i + .5) * width, (j + .5) * width, 0);
            double least = std::numeric_limits<double>::infinity();
            std::size_t nearest = 0;
            for (std::size_t s = 0; s < at.size(); ++s) {
                const double distance = (x - at[s]).squaredNorm();
                if (distance >= least) continue;
                least = distance;
                nearest = s;
            }
            sums.energy += least * width * width;
            sums.area[nearest] += width * width;
        }
    }
    return sums;
}

// By central differences.
double slope_of(std::size_t site, const Vec3& direction) {
    constexpr double step = 1e-5;
    std::vector<Vec3> ahead = sites(), behind = sites();
    ahead[site] += step * direction;
    behind[site] -= step * direction;
    return (measure(ahead).weighted - measure(behind).weighted) / (2 * step);
}

}  // namespace

TEST(CvtEnergy, CellsEndAtTheRim) {
    const Sums expected = sum_over_grid(sites());
    const CvtEnergy found = measure(sites());
    EXPECT_NEAR(found.energy, expected.energy, 1e-4);
    EXPECT_NEAR(found.weighted, expected.energy, 1e-4);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(found.cells[i].area, expected.area[i], 1e-3) << i;
        EXPECT_NEAR(found.cells[i].mass, found.cells[i].area, 1e-12);
        EXPECT_LT((found.cells[i].normal - Vec3(0, 0, 1)).norm(), 1e-12);
    }
}

TEST(CvtEnergy, SlopesOfClippedCellsAreThoseOfTheEnergy) {
    const CvtEnergy found = measure(sites());
    const Vec3 x(1, 0, 0), y(0, 1, 0);
    EXPECT_NEAR(found.cells[4].slope.x(), slope_of(4, x), 1e-8);
    EXPECT_NEAR(found.cells[4].slope.y(), slope_of(4, y), 1e-8);
    // Along the rim.
    EXPECT_NEAR(found.cells[5].slope.y(), slope_of(5, y), 1e-8);
    // Not past the rim: the square goes on below, so that the site is drawn upwards.
    EXPECT_LT(found.cells[4].slope.y(), -0.1);
}

// A triangle whose corners lie on one line, with two edges at the rim, beside another one.
TEST(CvtEnergy, ATriangleWithoutHeightAtTheRimIsLeftOut) {
    const std::vector<Vec3> at{{0, 0, 0}, {0.75, 0.1, 0}, {3, 0.4, 0}, {1, 3, 0}};
    const auto mesh = remesh::detail::build_site_mesh({{0, 1, 2}, {0, 2, 3}}, 4);
    agvd::Poller poller;
    agvd::Ticker ticker(poller);
    CvtEnergy result;
    for (const double lift : {0.0, 1e-18, -1e-18, 1e-12}) {
        std::vector<Vec3> lifted = at;
        lifted[1].z() = lift;
        measure_energy(mesh, lifted, std::vector<double>(4, 1), ticker, result);
        EXPECT_TRUE(std::isfinite(result.energy)) << lift;
        EXPECT_GT(result.energy, 1) << lift;
        EXPECT_TRUE(std::isfinite(result.weighted)) << lift;
    }
}

TEST(CvtEnergy, WeightsScaleMassAndSlope) {
    const CvtEnergy once = measure(sites()), thrice = measure(sites(), 3);
    EXPECT_NEAR(thrice.energy, once.energy, 1e-12);
    EXPECT_NEAR(thrice.weighted, 3 * once.weighted, 1e-12);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(thrice.cells[i].mass, 3 * once.cells[i].mass, 1e-12);
        EXPECT_LT((thrice.cells[i].slope - 3 * once.cells[i].slope).norm(), 1e-12);
    }
}
