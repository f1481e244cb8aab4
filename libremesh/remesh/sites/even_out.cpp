// Passes from coarse to fine: if the sites of regions are less even than random points (chi-
// square), random ones move from crowded regions to others.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "agvd/core/random.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/sites/levels.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sampling.h"
#include "remesh/sites/shares.h"

namespace remesh::detail {
namespace {

// Sites for each region, pass by pass. Relaxation needs a few steps only for what is uneven within
// the smallest regions.
constexpr std::array sites_per_region{400.0, 100.0, 25.0, 6.0};
// Least number of vertices for each region: smaller regions, which consist of faces, are too
// coarse.
constexpr Index vertices_per_region = 8;
// Standard deviations of random points that are tolerated: for all regions together, and for one.
constexpr double most_deviation = 4, most_deviation_of_one = 5;
// Sites nearer than this count as being at one position; in mean distances.
constexpr double same_position = 1e-3;
// Of the random numbers: no value is better than another.
constexpr std::uint64_t seed = 0x5eed;

// Parts of the surface, each a set of faces.
struct Regions {
    std::vector<Index> of_face;  // #F: numbers without gaps.
    std::vector<Component> parts;

    Regions(std::vector<Index> region_of_face, Index count, std::span<const double> area_of_face)
        : of_face(std::move(region_of_face)), parts(count) {
        for (Index f = 0; f < of_face.size(); ++f) {
            Component& part = parts[of_face[f]];
            part.area_up_to.push_back(area_of_face[f] + (part.faces.empty() ? 0 : part.area()));
            part.faces.push_back(f);
        }
    }
};

// A random point by area.
SurfacePoint draw(const Component& part, std::uint64_t stream, std::uint64_t number) {
    const auto unit = [&](std::uint64_t k) { return random_unit(seed, stream, 3 * number + k); };
    const Index face = part.faces[pick_by_sums(part.area_up_to, unit(0))];
    const std::array<double, 3> b = uniform_barycentric(unit(1), unit(2));
    return {FaceId(face), {1 - b[1] - b[2], b[1], b[2]}};
}

// Makes regions around vertices that are far apart; a later call adds to those of earlier ones.
struct RegionMaker {
    const Surface& surface;
    std::span<const double> area_of_face;
    const Progress& progress;
    BoundsSearch search;
    FallingQueue<DistanceOfVertex> farthest = farthest_vertices(surface, {search});
    Index num_centers = 0;

    // At least `count` regions, and one for each component.
    Regions make(Index count) {
        Poller poller(progress);
        Ticker ticker(poller);
        while (!farthest.is_empty()) {
            ticker.tick(search_work);
            const Index v = farthest.pop();
            if (num_centers >= count && std::isfinite(search.distance(v))) {
                farthest.push(v);
                break;
            }
            search.add(point_at(surface, v), num_centers++);
            search.run(progress);
        }
        // A face belongs to the region of its first corner; regions without a face get no number.
        std::vector<Index> number(num_centers, no_index);
        std::vector<Index> region(surface.num_faces());
        Index num_regions = 0;
        for (Index f = 0; f < region.size(); ++f) {
            Index& n = number[search.site(surface.mesh.triangles[f][0])];
            if (n == no_index) n = num_regions++;
            region[f] = n;
        }
        return {std::move(region), num_regions, area_of_face};
    }
};

class EvenOut {
public:
    EvenOut(const IntrinsicTriangulation& base, std::vector<SurfacePoint>& sites,
            std::span<const std::uint8_t> is_fixed, const SizeField* sizes,
            const Progress& progress)
        : base_(base),
          surface_(base.surface()),
          sites_(sites),
          on_base_(base.to_intrinsic(sites)),
          components_(find_components(surface_, progress)) {
        may_move_.reserve(sites.size());
        for (Index i = 0; i < sites.size(); ++i) {
            const bool stays = (!is_fixed.empty() && is_fixed[i] != 0) ||
                               boundary_half_edge(base.input(), sites[i]).has_value();
            may_move_.push_back(stays ? 0 : 1);
        }
        component_of_face_.resize(surface_.num_faces());
        for (Index c = 0; c < components_.size(); ++c) {
            for (const Index f : components_[c].faces) component_of_face_[f] = c;
            area_ += components_[c].area();
        }
        measure_faces(sizes);
        find_surplus();
    }

    void run(const SurfaceLayout& layout, int num_threads, const Progress& progress) {
        const auto num_sites = static_cast<Index>(sites_.size());
        const Regions components(component_of_face_, static_cast<Index>(components_.size()),
                                 area_of_face_);
        std::vector<double> shares;
        if (num_sites >= needed_samples(components_)) {
            for (const Index n : share_out(components_, num_sites)) shares.push_back(n);
        } else {
            for (const Component& c : components_) shares.push_back(c.area());
        }
        balance(components, shares);

        RegionMaker maker{surface_, area_of_face_, progress,
                          BoundsSearch(surface_, layout, num_threads)};
        for (const double per_region : sites_per_region) {
            const auto count = static_cast<Index>(num_sites / per_region);
            if (count < 2 || count * vertices_per_region > surface_.num_vertices()) continue;
            const Regions regions = maker.make(count);
            balance(regions, shares_of(regions));
        }
    }

private:
    // Areas of faces and components, in squares of local lengths if there are sizes.
    void measure_faces(const SizeField* sizes) {
        const double third = 1.0 / 3;
        for (Index f = 0; f < surface_.num_faces(); ++f) {
            const double area = face_area(surface_, f);
            if (sizes == nullptr) {
                area_of_face_.push_back(area);
                continue;
            }
            const double length =
                sizes->at(base_.to_input(SurfacePoint{FaceId(f), {third, third, third}}));
            area_of_face_.push_back(area / (length * length));
        }
        if (sizes != nullptr) set_areas(components_, area_of_face_);
    }

    // Of several sites at one position, all but one wait for a region.
    void find_surplus() {
        const double cell = same_position * std::sqrt(area_ / static_cast<double>(sites_.size()));
        std::unordered_set<Vec3, PositionHash> taken;
        for (const bool moves : {false, true}) {
            for (Index i = 0; i < sites_.size(); ++i) {
                if ((may_move_[i] != 0) != moves) continue;
                const Vec3 at = position(base_.input().mesh.view(), sites_[i]) / cell;
                const Vec3 key(std::round(at.x()), std::round(at.y()), std::round(at.z()));
                if (!taken.insert(key).second && moves) surplus_.push_back(i);
            }
        }
    }

    // The share of each region in the sites of its component, by area.
    [[nodiscard]] std::vector<double> shares_of(const Regions& regions) const {
        std::vector<double> count(components_.size(), 0);
        for (const SurfacePoint& s : on_base_) ++count[component_of_face_[s.face.value()]];
        std::vector<double> shares;
        for (const Component& part : regions.parts) {
            const Index c = component_of_face_[part.faces[0]];
            shares.push_back(count[c] * part.area() / components_[c].area());
        }
        return shares;
    }

    // Gives every region its share if the sites are spread less evenly than random points.
    void balance(const Regions& regions, std::span<const double> shares) {
        const auto num_sites = static_cast<Index>(sites_.size());
        const std::uint64_t stream = regions.parts.size();
        std::vector<std::vector<Index>> residents(regions.parts.size());  // Ascending.
        std::vector<std::uint8_t> waits(num_sites, 0);
        for (const Index i : surplus_) waits[i] = 1;
        for (Index i = 0; i < num_sites; ++i) {
            if (waits[i] == 0) residents[regions.of_face[on_base_[i].face.value()]].push_back(i);
        }
        if (surplus_.empty() && is_even(residents, shares)) return;

        const std::vector<Index> quota = apportion(shares, num_sites);
        std::vector<double> missing;
        Index num_missing = 0;
        for (Index r = 0; r < regions.parts.size(); ++r) {
            const auto have = static_cast<Index>(residents[r].size());
            missing.push_back(quota[r] > have ? quota[r] - have : 0);
            num_missing += static_cast<Index>(missing.back());
            if (have > quota[r]) release(residents[r], have - quota[r], stream);
        }
        if (num_missing == 0) return;
        // These are fewer than are missing if surplus sites may not move.
        const std::vector<Index> gets = apportion(missing, static_cast<Index>(surplus_.size()));
        Index next = 0;
        for (Index r = 0; r < regions.parts.size(); ++r) {
            for (Index k = 0; k < gets[r]; ++k, ++next) {
                on_base_[surplus_[next]] = draw(regions.parts[r], stream, next);
                sites_[surplus_[next]] = base_.to_input(on_base_[surplus_[next]]);
            }
        }
        surplus_.clear();
    }

    [[nodiscard]] static bool is_even(const std::vector<std::vector<Index>>& residents,
                                      std::span<const double> shares) {
        double chi_square = 0;
        for (std::size_t r = 0; r < shares.size(); ++r) {
            const double excess = static_cast<double>(residents[r].size()) - shares[r];
            if (excess > most_deviation_of_one * std::sqrt(shares[r]) + 1) return false;
            chi_square += excess * excess / std::max(shares[r], 1.0);
        }
        const auto count = static_cast<double>(shares.size());
        return chi_square <= count + most_deviation * std::sqrt(2 * count);
    }

    // Releases random residents that may move.
    void release(const std::vector<Index>& residents, Index count, std::uint64_t stream) {
        std::vector<std::pair<std::uint64_t, Index>> order;
        for (const Index i : residents) {
            if (may_move_[i] != 0) order.emplace_back(random_bits(seed, ~stream, i), i);
        }
        std::sort(order.begin(), order.end());
        order.resize(std::min<std::size_t>(order.size(), count));
        for (const auto& [bits, i] : order) surplus_.push_back(i);
    }

    const IntrinsicTriangulation& base_;
    const Surface& surface_;             // Of the base.
    std::vector<SurfacePoint>& sites_;   // On the input.
    std::vector<SurfacePoint> on_base_;  // The same, on the base.
    std::vector<Component> components_;
    std::vector<double> area_of_face_;      // #F
    std::vector<Index> component_of_face_;  // #F
    double area_ = 0;                       // Square mesh units.
    std::vector<std::uint8_t> may_move_;    // #sites
    std::vector<Index> surplus_;
};

}  // namespace

void even_out(const PreparedSurface& surface, std::vector<SurfacePoint>& sites,
              std::span<const std::uint8_t> is_fixed, int num_threads, const Progress& progress,
              const SizeField* sizes) {
    EvenOut(surface.base, sites, is_fixed, sizes, progress)
        .run(surface.layout, num_threads, progress);
}

}  // namespace remesh::detail
