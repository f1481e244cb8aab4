// A step moves each site by Newton's method for its own cell: the energy plus the weighted squared
// distance from the planes of the cell. Moves that turn triangles over are undone.
#include "remesh/sites/relaxation.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/parallel.h"
#include "agvd/core/portable_math.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"

namespace remesh::detail {
namespace {

using Mat3 = Eigen::Matrix3d;

// A move is this many times Lloyd's, which goes to the centroid, plus this share of the last move.
constexpr double stretch = 1.5;
constexpr double momentum = 0.75;
// Longest move, in square roots of the cell's area.
constexpr double longest_site_move = 0.4;
// Most rounds of undoing moves.
constexpr int most_rounds = 3;
// Most rounds of flips at the start.
constexpr int most_flip_rounds = 10;
// Sites of a parallel chunk.
constexpr Index sites_per_task = 256;
constexpr double most_area_ratio = 4;
// The best density is curvature^(4/3), and the bending of cells of one size curvature^2. Below
// `even_bending` all cells are alike.
constexpr double bending_power = 2.0 / 3;
constexpr double even_bending = 0.05;
// Weight of the squared distances from the planes of a cell, relative to those from its points.
// They draw sites to creases.
constexpr double plane_weight = 2;
constexpr double most_weight = 64;

}  // namespace

Relaxation::Relaxation(const Surface& surface, TriangulatedSites start,
                       std::vector<std::uint8_t> is_fixed, int num_threads,
                       const Progress& progress)
    : surface_(surface),
      num_threads_(num_threads),
      poller_(progress),
      ticker_(poller_),
      sites_(std::move(start.sites)),
      at_(sites_.size()),
      facing_(sites_.size()),
      move_(sites_.size(), Vec3::Zero()),
      weight_(std::move(start.weights)),
      is_fixed_(std::move(is_fixed)),
      boundary_(sites_.size()) {
    weight_.resize(sites_.size(), 1);
    planes_.resize(sites_.size());
    is_fixed_.resize(sites_.size(), 0);
    for (Index i = 0; i < sites_.size(); ++i) {
        locate(i);
        ticker_.tick();
        // The vertex is a corner of the boundary, or as good a point as any on its loop.
        if (boundary_[i] != no_index && vertex_of(surface_, sites_[i])) is_fixed_[i] = 1;
    }
    take_triangles(std::move(start.triangles));
}

void Relaxation::hold(const CurveNetwork& network, CurveSites curves) {
    curves_.emplace(surface_, network, std::move(curves));
    std::fill(is_fixed_.begin(), is_fixed_.begin() + curves_->num_copies(), 1);
    measure();
}

void Relaxation::take_triangles(std::vector<Triangle> triangles) {
    mesh_ = build_site_mesh(std::move(triangles), static_cast<Index>(sites_.size()), ticker_);
    find_stuck();
    measure();
    for (int round = 0; round < most_flip_rounds; ++round) {
        if (flip_towards_delaunay(mesh_, at_, now_.cotangent, ticker_) == 0) break;
        measure();
    }
    find_turned(mesh_, at_, facing_, turned_);
}

void Relaxation::find_stuck() {
    is_stuck_.assign(sites_.size(), 0);
    num_stuck_ = 0;
    for (Index i = 0; i < sites_.size(); ++i) {
        is_stuck_[i] = mesh_.is_rim[i] != 0 && boundary_[i] == no_index ? 1 : 0;
        num_stuck_ += is_stuck_[i];
    }
}

void Relaxation::repair(const std::vector<Triangle>& triangles) {
    const Index flaws = num_flaws();
    SiteMesh before = std::move(mesh_);
    take_triangles(triangles);
    if (num_flaws() < flaws) return;
    mesh_ = std::move(before);
    find_stuck();
    measure();
    find_turned(mesh_, at_, facing_, turned_);
}

void Relaxation::set_density(const CellMeasures* cells, std::span<const double> length) {
    if (cells != nullptr) {
        weigh_cells(*cells, length.empty() ? bending_power : 0);
    } else {
        weight_.assign(sites_.size(), 1);
    }
    // Cells of area A have A^2 in proportion to 1 / density.
    double sum = 0;
    for (const double l : length) sum += l;
    const double mean = sum / static_cast<double>(length.size());
    for (std::size_t i = 0; i < length.size(); ++i) {
        const double squared = (mean / length[i]) * (mean / length[i]);
        weight_[i] *= squared * squared;
    }
    measure();
}

void Relaxation::measure() { measure_energy(mesh_, at_, weight_, ticker_, now_); }

void Relaxation::weigh_cells(const CellMeasures& cells, double power_of_bending) {
    // Sums over a site and its neighbours: measurements of cells are rough where faces are large,
    // and sizes must not change abruptly.
    struct Sums {
        double on_surface, on_triangles, bending, count;
    };
    std::vector<Sums> sums(sites_.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = {cells.area[i], now_.cells[i].area, cells.bending[i], 1};
    }
    for (const Triangle& t : mesh_.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (const Index other : {t[(k + 1) % 3], t[(k + 2) % 3]}) {  // Twice each.
                sums[t[k]].on_surface += cells.area[other] / 2;
                sums[t[k]].on_triangles += now_.cells[other].area / 2;
                sums[t[k]].bending += cells.bending[other] / 2;
                sums[t[k]].count += 0.5;
            }
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Sums& s = sums[i];
        const double ratio = s.on_triangles > 0 ? s.on_surface / s.on_triangles : 1;
        const double area_ratio = std::clamp(ratio, 1.0, most_area_ratio);
        // Area goes as 1 / sqrt(density), so a cell with k times the surface needs k^2; half a
        // power more makes up for the few steps.
        const double lost = area_ratio * area_ratio * std::sqrt(area_ratio);
        const double bent = portable::pow(1 + s.bending / s.count / even_bending, power_of_bending);
        weight_[i] = std::min(lost * bent, most_weight);
    }
    planes_ = cells.planes;
}

void Relaxation::step() {
    choose_moves();
    poller_.poll();
    sites_before_ = sites_;
    at_before_ = at_;
    facing_before_ = facing_;
    walk();
    poller_.poll();
    take_back();
    measure();
    // The flips are few; the next step measures what they change.
    flip_towards_delaunay(mesh_, at_, now_.cotangent, ticker_);
}

double Relaxation::objective() const {
    double sum = now_.weighted;
    for (std::size_t i = 0; i < at_.size(); ++i) {
        sum += plane_weight * weight_[i] * planes_[i].at(at_[i]);
    }
    return sum;
}

void Relaxation::locate(Index i) {
    facing_[i] = facing_at(surface_, sites_[i]);
    at_[i] = position(surface_.mesh.view(), sites_[i]);
    boundary_[i] = boundary_half_edge(surface_, sites_[i]).value_or(no_index);
}

void Relaxation::choose_moves() {
    const auto num_sites = static_cast<Index>(move_.size());
    half_slope_.resize(num_sites);
    const auto find_slopes = [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Vec3 off = planes_[i].half_slope(at_[i]);
            const Vec3 along = off - facing_[i].dot(off) * facing_[i];
            half_slope_[i] = now_.cells[i].slope / 2 + plane_weight * weight_[i] * along;
        }
    };
    parallel_chunks(num_sites, sites_per_task, num_threads_, find_slopes, poller_);
    double uphill = 0;
    for (Index i = 0; i < num_sites; ++i) uphill += half_slope_[i].dot(move_[i]);
    if (curves_) uphill += curves_->measure(now_.cells);
    const double keep = uphill > 0 ? 0 : momentum;
    const auto choose = [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) choose_move(i, keep);
    };
    parallel_chunks(num_sites, sites_per_task, num_threads_, choose, poller_);
    if (curves_) curves_->step(stretch, keep);
}

void Relaxation::choose_move(Index i, double keep) {
    const CvtEnergy::Cell& cell = now_.cells[i];
    if (is_fixed_[i] != 0 || is_stuck_[i] != 0 || !(cell.mass > 0)) {
        move_[i].setZero();
        return;
    }
    const Mat3 along = Mat3::Identity() - facing_[i] * facing_[i].transpose();
    const Mat3 stiffness = cell.mass * Mat3::Identity() +
                           plane_weight * weight_[i] * along * planes_[i].spread * along;
    Vec3 move = keep * move_[i] - stretch * (stiffness.inverse() * half_slope_[i]);
    move -= cell.normal.dot(move) * cell.normal;
    const double most = longest_site_move * std::sqrt(std::max(cell.area, 0.0));
    const double length = move.norm();
    move_[i] = length > most ? Vec3(most / length * move) : move;
}

// Sites are not ordered on the surface, so what a walk reads is not in the cache.
[[gnu::always_inline]] inline void Relaxation::prefetch(Index i) const {
    const std::size_t f = sites_[i].face.value();
    __builtin_prefetch(&surface_.mesh.triangles[f]);
    __builtin_prefetch(&surface_.twin[3 * f]);
}

void Relaxation::walk() {
    constexpr Index ahead = 4;  // Sites.
    const auto body = [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            if (i + ahead < end) prefetch(i + ahead);
            if (move_[i].isZero(0)) continue;
            sites_[i] = boundary_[i] != no_index
                            ? walk_boundary(surface_, sites_[i], boundary_[i], move_[i])
                            : walk_straight(surface_, sites_[i], move_[i]).end;
            locate(i);
        }
    };
    parallel_chunks(static_cast<Index>(sites_.size()), sites_per_task, num_threads_, body, poller_);
    if (curves_) walk_curves();
}

void Relaxation::walk_curves() {
    const std::vector<SurfacePoint>& copies = curves_->sites().sites;
    for (Index i = 0; i < copies.size(); ++i) {
        sites_[i] = copies[i];
        locate(i);
    }
}

// Undoes the moves that turned triangles over.
void Relaxation::take_back() {
    find_turned(mesh_, at_, facing_, turned_);
    for (int round = 0; round < most_rounds; ++round) {
        bool is_done = true;
        for (const Index turned : turned_) {
            const Triangle& t = mesh_.triangles[turned];
            const Vec3 normal =
                (at_before_[t[1]] - at_before_[t[0]]).cross(at_before_[t[2]] - at_before_[t[0]]);
            const Vec3 facing = facing_before_[t[0]] + facing_before_[t[1]] + facing_before_[t[2]];
            if (!(normal.dot(facing) > 0)) continue;  // Turned before the step.
            for (const Index i : t) {
                if (take_back(i)) is_done = false;
            }
        }
        if (is_done) return;
        find_turned(mesh_, at_, facing_, turned_);
    }
}

// Undoes the move of a site, and of all copies of a curve's site together. Returns false if it has
// not moved.
bool Relaxation::take_back(Index i) {
    if (at_[i] == at_before_[i]) return false;
    std::pair<Index, Index> together{i, i + 1};
    if (curves_ && i < curves_->num_copies()) {
        curves_->take_back(i);
        together = curves_->copies_with(i);
    }
    for (Index k = together.first; k < together.second; ++k) {
        sites_[k] = sites_before_[k];
        locate(k);
        move_[k].setZero();
    }
    return true;
}

}  // namespace remesh::detail
