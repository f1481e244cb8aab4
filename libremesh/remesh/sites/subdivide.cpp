// Adds the middles of the longest pairs of neighbours as sites, and divides each triangle at its
// middles. If the middles are too few, the largest triangles get a site in their centre. So new
// sites inside the surface get six neighbours, and old ones keep their number.
#include "remesh/sites/subdivide.h"

#include <algorithm>

#include "remesh/sites/walk.h"

namespace remesh::detail {
namespace {

class Subdivision {
public:
    Subdivision(const Surface& surface, const std::vector<SurfacePoint>& sites,
                const std::vector<double>& weights, const SiteDual& dual,
                std::span<const double> unit)
        : surface_(surface), dual_(dual), result_{sites, {}, weights} {
        unit_.assign(unit.begin(), unit.end());
        if (unit_.empty()) unit_.assign(sites.size(), 1);
    }

    std::optional<TriangulatedSites> run(Index count) {
        const auto has_no_site = [](const Middle& m) { return m.site == no_index; };
        const std::size_t room =
            result_.sites.size() + static_cast<std::size_t>(std::count_if(
                                       dual_.middles.begin(), dual_.middles.end(), has_no_site));
        if (count < result_.sites.size()) return std::nullopt;
        add_middles(std::min<std::size_t>(count, room) - result_.sites.size());
        for (const Triangle& t : dual_.triangles) divide(t);
        if (room < count && !add_centres(static_cast<Index>(count - room))) return std::nullopt;
        return std::move(result_);
    }

private:
    // Adds the middles of the `count` longest pairs.
    void add_middles(std::size_t count) {
        std::vector<Index> order;
        for (Index i = 0; i < dual_.middles.size(); ++i) {
            if (dual_.middles[i].site == no_index) order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
            return length_of(dual_.middles[a]) > length_of(dual_.middles[b]);
        });
        new_site_.assign(dual_.middles.size(), no_index);
        for (std::size_t i = 0; i < count; ++i) new_site_[order[i]] = 0;
        for (Index i = 0; i < new_site_.size(); ++i) {
            const Middle& m = dual_.middles[i];
            if (m.site != no_index) new_site_[i] = m.site;
            if (m.site != no_index || new_site_[i] == no_index) continue;
            new_site_[i] = static_cast<Index>(result_.sites.size());
            result_.sites.push_back(m.point);
            result_.weights.push_back((result_.weights[m.low] + result_.weights[m.high]) / 2);
            unit_.push_back((unit_[m.low] + unit_[m.high]) / 2);
        }
    }

    [[nodiscard]] double length_of(const Middle& m) const {
        return 2 * m.length / (unit_[m.low] + unit_[m.high]);
    }

    [[nodiscard]] Index between(Index a, Index b) const {
        const std::pair<Index, Index> pair = std::minmax({a, b});
        const auto found = std::lower_bound(
            dual_.middles.begin(), dual_.middles.end(), pair,
            [](const Middle& m, const auto& p) { return std::pair(m.low, m.high) < p; });
        if (found == dual_.middles.end() || std::pair(found->low, found->high) != pair) {
            return no_index;
        }
        return new_site_[static_cast<std::size_t>(found - dual_.middles.begin())];
    }

    // Divides a triangle into four, three or two.
    void divide(const Triangle& t) {
        std::array<Index, 3> middle{};
        std::size_t num_missing = 0, missing = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = between(t[k], t[(k + 1) % 3]);
            if (middle[k] != no_index) continue;
            ++num_missing;
            missing = k;
        }
        auto& out = result_.triangles;
        if (num_missing == 0) {
            for (std::size_t k = 0; k < 3; ++k) {
                out.push_back({t[k], middle[k], middle[(k + 2) % 3]});
            }
            out.push_back(middle);
            return;
        }
        // Otherwise the triangle is a polygon, cut into a fan around one of its middles.
        std::vector<Index> polygon;
        for (std::size_t i = 1; i <= 3; ++i) {
            const std::size_t k = (missing + i) % 3;
            polygon.push_back(t[k]);
            if (middle[k] != no_index) polygon.push_back(middle[k]);
        }
        if (num_missing < 3) {
            const auto first = std::find_if(polygon.begin(), polygon.end(), [&](Index site) {
                return std::find(t.begin(), t.end(), site) == t.end();
            });
            std::rotate(polygon.begin(), first, polygon.end());
        }
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            out.push_back({polygon[0], polygon[i - 1], polygon[i]});
        }
    }

    // Adds one site in the centre of each of the largest triangles; false if these are too few.
    bool add_centres(Index count) {
        auto& triangles = result_.triangles;
        if (count > triangles.size()) return false;
        const auto at = [&](Index site) {
            return position(surface_.mesh.view(), result_.sites[site]);
        };
        std::vector<std::pair<double, Index>> by_size;  // (minus the area, triangle)
        for (Index i = 0; i < triangles.size(); ++i) {
            const auto& [a, b, c] = triangles[i];
            const double unit = (unit_[a] + unit_[b] + unit_[c]) / 3;
            by_size.emplace_back(-(at(b) - at(a)).cross(at(c) - at(a)).norm() / (unit * unit), i);
        }
        std::sort(by_size.begin(), by_size.end());
        for (Index i = 0; i < count; ++i) {
            const auto [a, b, c] = triangles[by_size[i].second];
            const auto site = static_cast<Index>(result_.sites.size());
            const Vec3 centre = (at(a) + at(b) + at(c)) / 3;
            result_.sites.push_back(walk_straight(surface_, result_.sites[a], centre - at(a)).end);
            const auto& w = result_.weights;
            result_.weights.push_back((w[a] + w[b] + w[c]) / 3);
            triangles[by_size[i].second] = {a, b, site};
            triangles.push_back({b, c, site});
            triangles.push_back({c, a, site});
        }
        return true;
    }

    const Surface& surface_;
    const SiteDual& dual_;
    TriangulatedSites result_;
    std::vector<double> unit_;     // By site.
    std::vector<Index> new_site_;  // By middle; no_index: not added.
};

}  // namespace

std::optional<TriangulatedSites> subdivide(const Surface& surface,
                                           const std::vector<SurfacePoint>& sites,
                                           const std::vector<double>& weights, const SiteDual& dual,
                                           Index count, std::span<const double> unit) {
    return Subdivision(surface, sites, weights, dual, unit).run(count);
}

}  // namespace remesh::detail
