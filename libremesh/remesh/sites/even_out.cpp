// Passes from coarse to fine: components first, then regions of ever fewer sites. A pass compares
// the number of sites in each region with its share by a chi-square test. If the sites are less
// even than random points, random sites of crowded regions move to random points of others. Regions
// are the cells of vertices that are far apart.
#include "remesh/sites/even_out.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "agvd/core/random.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/sites/farthest_vertex.h"
#include "remesh/sites/shares.h"
#include "remesh/sites/walk.h"

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
// Sites nearer than this count as being at one place; in mean distances.
constexpr double same_place = 1e-3;
// Any value works.
constexpr std::uint64_t seed = 0x5eed;

// Parts of the surface, each a set of faces.
struct Regions {
    std::vector<Index> of_face;      // #F
    std::vector<double> area;        // Per region.
    std::vector<Index> begin;        // #regions + 1, into `faces` and `area_up_to`.
    std::vector<Index> faces;        // By region.
    std::vector<double> area_up_to;  // Area of the region up to this face.

    // \param region_of_face  #F: numbers without gaps.
    // \param area_of_face    #F
    Regions(std::span<const double> area_of_face, std::vector<Index> region_of_face, Index count)
        : of_face(std::move(region_of_face)), area(count, 0), begin(count + 1, 0) {
        for (const Index r : of_face) ++begin[r + 1];
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        faces.resize(of_face.size());
        area_up_to.resize(of_face.size());
        std::vector<Index> next(begin.begin(), begin.end() - 1);
        for (Index f = 0; f < of_face.size(); ++f) {
            const Index r = of_face[f];
            area[r] += area_of_face[f];
            faces[next[r]] = f;
            area_up_to[next[r]++] = area[r];
        }
    }
    [[nodiscard]] Index size() const { return static_cast<Index>(area.size()); }

    // A random point of a region, by area.
    [[nodiscard]] SurfacePoint draw(Index region, std::uint64_t stream,
                                    std::uint64_t number) const {
        const auto unit = [&](std::uint64_t k) {
            return random_unit(seed, stream, 3 * number + k);
        };
        const auto first = area_up_to.begin() + begin[region];
        const auto last = area_up_to.begin() + begin[region + 1] - 1;
        const auto found = std::upper_bound(first, last, unit(0) * area[region]);
        const std::array<double, 3> b = uniform_barycentric(unit(1), unit(2));
        const Index face = faces[static_cast<std::size_t>(found - area_up_to.begin())];
        return {FaceId(face), {1 - b[1] - b[2], b[1], b[2]}};
    }
};

// Makes regions around vertices that are far apart; a later call adds to those of earlier ones.
class RegionMaker {
public:
    RegionMaker(const Surface& surface, std::span<const double> area_of_face,
                const SurfaceLayout& layout, int num_threads, const Progress& progress)
        : surface_(surface),
          area_of_face_(area_of_face),
          progress_(progress),
          search_(surface, layout, num_threads),
          farthest_(surface, search_) {}

    // At least `count` regions, and one for each component.
    Regions make(Index count) {
        Poller poller(progress_);
        Ticker ticker(poller);
        while (!farthest_.is_empty()) {
            ticker.tick(search_work);
            const Index v = farthest_.pop();
            if (num_centers_ >= count && std::isfinite(search_.distance(v))) {
                farthest_.push(v);
                break;
            }
            search_.add(point_at(surface_, v), num_centers_++);
            search_.run(progress_);
        }
        // A face belongs to the region of its first corner; regions without a face get no number.
        std::vector<Index> number(num_centers_, no_index);
        std::vector<Index> region(surface_.num_faces());
        Index num_regions = 0;
        for (Index f = 0; f < region.size(); ++f) {
            Index& n = number[search_.site(surface_.mesh.triangles[f][0])];
            if (n == no_index) n = num_regions++;
            region[f] = n;
        }
        return {area_of_face_, std::move(region), num_regions};
    }

private:
    const Surface& surface_;
    std::span<const double> area_of_face_;
    const Progress& progress_;
    BoundsSearch search_;
    FarthestVertex farthest_;
    Index num_centers_ = 0;
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
        is_moved_.assign(sites.size(), 0);
        find_surplus();
    }

    Index run(const SurfaceLayout& layout, int num_threads, const Progress& progress) {
        const auto num_sites = static_cast<Index>(sites_.size());
        const Regions components(area_of_face_, component_of_face_,
                                 static_cast<Index>(components_.size()));
        std::vector<double> shares;
        if (num_sites >= needed_samples(components_)) {
            const std::vector<double> no_boundary(components_.size(), 0);
            for (const Index n : share_out(components_, no_boundary, num_sites)) {
                shares.push_back(n);
            }
        } else {
            for (const Component& c : components_) shares.push_back(c.area());
        }
        balance(components, shares, components_.size());

        RegionMaker maker(surface_, area_of_face_, layout, num_threads, progress);
        for (const double per_region : sites_per_region) {
            const auto count = static_cast<Index>(num_sites / per_region);
            if (count < 2 || count * vertices_per_region > surface_.num_vertices()) continue;
            const Regions regions = maker.make(count);
            balance(regions, shares_of(regions), regions.size());
        }
        return static_cast<Index>(std::count(is_moved_.begin(), is_moved_.end(), 1));
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
        if (sizes == nullptr) return;
        for (Component& component : components_) {
            double area = 0;
            for (std::size_t i = 0; i < component.faces.size(); ++i) {
                area += area_of_face_[component.faces[i]];
                component.area_up_to[i] = area;
            }
        }
    }

    // Of several sites at one place, all but one wait for a region.
    void find_surplus() {
        const double cell = same_place * std::sqrt(area_ / static_cast<double>(sites_.size()));
        std::unordered_set<Vec3, PositionHash> taken;
        for (const bool moves : {false, true}) {
            for (Index i = 0; i < sites_.size(); ++i) {
                if ((may_move_[i] != 0) != moves) continue;
                const Vec3 at = position(base_.input().mesh.view(), sites_[i]) / cell;
                const Vec3 key(std::round(at.x()), std::round(at.y()), std::round(at.z()));
                if (!taken.insert(key).second && moves) surplus_.push_back(i);
            }
        }
        for (const Index i : surplus_) is_moved_[i] = 1;
    }

    // The share of each region in the sites of its component, by area.
    [[nodiscard]] std::vector<double> shares_of(const Regions& regions) const {
        std::vector<double> count(components_.size(), 0);
        for (const SurfacePoint& s : on_base_) ++count[component_of_face_[s.face.value()]];
        std::vector<double> shares;
        for (Index r = 0; r < regions.size(); ++r) {
            const Index c = component_of_face_[regions.faces[regions.begin[r]]];
            shares.push_back(count[c] * regions.area[r] / components_[c].area());
        }
        return shares;
    }

    // Gives every region its share if the sites are spread less evenly than random points.
    void balance(const Regions& regions, std::span<const double> shares, std::uint64_t stream) {
        const auto num_sites = static_cast<Index>(sites_.size());
        std::vector<std::vector<Index>> residents(regions.size());  // Ascending.
        std::vector<std::uint8_t> waits(num_sites, 0);
        for (const Index i : surplus_) waits[i] = 1;
        for (Index i = 0; i < num_sites; ++i) {
            if (waits[i] == 0) residents[regions.of_face[on_base_[i].face.value()]].push_back(i);
        }
        if (surplus_.empty() && is_even(residents, shares)) return;

        const std::vector<Index> quota = apportion(shares, num_sites);
        std::vector<double> missing;
        Index num_missing = 0;
        for (Index r = 0; r < regions.size(); ++r) {
            const auto have = static_cast<Index>(residents[r].size());
            missing.push_back(quota[r] > have ? quota[r] - have : 0);
            num_missing += static_cast<Index>(missing.back());
            if (have > quota[r]) release(residents[r], have - quota[r], stream);
        }
        if (num_missing == 0) return;
        // These are fewer than are missing if surplus sites may not move.
        const std::vector<Index> gets = apportion(missing, static_cast<Index>(surplus_.size()));
        Index next = 0;
        for (Index r = 0; r < regions.size(); ++r) {
            for (Index k = 0; k < gets[r]; ++k, ++next) {
                on_base_[surplus_[next]] = regions.draw(r, stream, next);
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
        for (const auto& [bits, i] : order) {
            surplus_.push_back(i);
            is_moved_[i] = 1;
        }
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
    std::vector<std::uint8_t> is_moved_;    // #sites
    std::vector<Index> surplus_;
};

}  // namespace

Index even_out(const PreparedSurface& surface, std::vector<SurfacePoint>& sites,
               std::span<const std::uint8_t> is_fixed, int num_threads, const Progress& progress,
               const SizeField* sizes) {
    return EvenOut(surface.base, sites, is_fixed, sizes, progress)
        .run(surface.layout, num_threads, progress);
}

}  // namespace remesh::detail
