#include "agvd/diagram/apollonius.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace agvd {
namespace {

constexpr int max_newton_steps = 25;
// Equalities are met to this share of the triangle's size: below it lies rounding.
constexpr double convergence = 1e-12;
// A branch point this far outside (share of the size) still counts as inside.
constexpr double inside_tolerance = 1e-9;
// A step that the distances contradict by more (share of the size) is drawn straight, so that arcs
// do not cross.
constexpr double largest_violation = 1e-3;
constexpr int max_arc_depth = 4;  // At most 2^4 pieces an arc and face.
constexpr double never = std::numeric_limits<double>::infinity();

struct BranchPoint {
    Vec2 position = Vec2::Zero();
    double distance = 0;
    double violation =
        never;  // How badly the distances contradict it, in length units; 0: not at all.
};

struct Ear {
    double violation = never;
    BranchPoint branch;
    bool is_lens = false;
};

class TriangleSolver {
public:
    TriangleSolver(std::span<const PlanarRelay> relays, const std::array<Vec2, 3>& corners,
                   double chord_tolerance, LocalDiagram& out)
        : relays_(relays), corners_(corners), chord_tolerance_(chord_tolerance), out_(out) {
        size_ = std::max({(corners[1] - corners[0]).norm(), (corners[2] - corners[1]).norm(),
                          (corners[0] - corners[2]).norm()});
    }

    void run(std::vector<Joint>& joints, Index first_branch_node) {
        first_branch_node_ = first_branch_node;
        for (const Joint& joint : joints) out_.pieces.emplace_back(joint.site_after, 1);
        if (joints.size() > 3) close_ears(joints);
        if (joints.size() == 3) {
            BranchPoint branch = find_branch(joints[2], joints[0], joints[1]);
            const bool is_sound = is_accepted(branch.violation);
            if (!is_sound) {
                branch.position =
                    (joints[0].position + joints[1].position + joints[2].position) / 3;
            }
            close_with_branch(joints, 0, branch, is_sound);
        } else {
            assert(joints.size() == 2);
            add_arc(joints[0], joints[1].position, joints[1].node, joints[1].site_after, true);
        }
    }

private:
    // Interval i lies between joint i and joint i + 1. At a joint, looking inwards, the interval
    // before lies on the left.
    static std::size_t after(std::size_t i, std::size_t n) { return i + 1 == n ? 0 : i + 1; }
    static std::size_t before(std::size_t i, std::size_t n) { return i == 0 ? n - 1 : i - 1; }

    [[nodiscard]] Ear judge_ear(const std::vector<Joint>& joints, std::size_t i) const {
        const Joint& previous = joints[before(i, joints.size())];
        const Joint& next = joints[after(i, joints.size())];
        Ear ear;
        ear.is_lens = previous.site_after == next.site_after;
        if (ear.is_lens) {
            ear.violation = lens_violation(joints[i], next);
        } else {
            ear.branch = find_branch(previous, joints[i], next);
            ear.violation = ear.branch.violation;
        }
        return ear;
    }

    // Closes ears, the best first, until at most three joints are left. Closing one changes the
    // judgement of its two neighbours only.
    void close_ears(std::vector<Joint>& joints) {
        std::vector<Ear> ears;
        for (std::size_t i = 0; i < joints.size(); ++i) ears.push_back(judge_ear(joints, i));
        while (joints.size() > 3) {
            const auto best = std::min_element(
                ears.begin(), ears.end(),
                [](const Ear& a, const Ear& b) { return a.violation < b.violation; });
            const auto i = static_cast<std::size_t>(best - ears.begin());
            const Ear ear = *best;
            const std::size_t next = after(i, joints.size());
            close_ear(joints, i, ear);
            // The joints at both ends of the interval gave way to one branch, or to none.
            ears.erase(ears.begin() + static_cast<std::ptrdiff_t>(std::max(i, next)));
            if (ear.is_lens)
                ears.erase(ears.begin() + static_cast<std::ptrdiff_t>(std::min(i, next)));
            const std::size_t n = joints.size();
            const std::size_t here = std::min(i, next) % n;
            for (const std::size_t k :
                 {before(before(here, n), n), before(here, n), here, after(here, n)}) {
                ears[k] = judge_ear(joints, k);
            }
        }
    }

    [[nodiscard]] bool is_accepted(double violation) const {
        return violation <= largest_violation * size_;
    }

    void close_ear(std::vector<Joint>& joints, std::size_t i, const Ear& ear) {
        const bool is_sound = is_accepted(ear.violation);
        if (!ear.is_lens) {
            BranchPoint branch = ear.branch;
            if (!is_sound) {
                // On the chord that cuts the ear off what is left stays convex.
                branch.position =
                    (joints[i].position + joints[after(i, joints.size())].position) / 2;
            }
            close_with_branch(joints, i, branch, is_sound);
            return;
        }
        // The interval is cut off by one arc; its two neighbours are one piece.
        const std::size_t next = after(i, joints.size());
        const Joint from = joints[i];
        const Joint to = joints[next];
        add_arc(from, to.position, to.node, to.site_after, is_sound);
        out_.pieces.emplace_back(to.site_after, -1);
        out_.connected.emplace_back(joints[before(i, joints.size())].interval, to.interval);
        // The interval before the ear now reaches to the end of the one after it.
        const std::size_t low = std::min(i, next);
        const std::size_t high = std::max(i, next);
        joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(high));
        joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(low));
    }

    // Two arcs run from the interval's joints to the branch; with three joints left, all three do.
    void close_with_branch(std::vector<Joint>& joints, std::size_t i, const BranchPoint& branch,
                           bool is_sound) {
        const std::size_t n = joints.size();
        const std::size_t next = after(i, n);
        const Index site_before = joints[before(i, n)].site_after;
        const Index site = joints[i].site_after;
        const Index site_after = joints[next].site_after;
        const Index node = first_branch_node_ + static_cast<Index>(out_.branches.size());
        const auto first_arc = static_cast<Index>(out_.arcs.size());
        out_.branches.push_back({branch.position,
                                 branch.distance,
                                 {first_arc, first_arc + 1, first_arc + 2},
                                 {false, false, false},
                                 {site, site_after, site_before}});
        add_arc(joints[i], branch.position, node, site_before, is_sound);
        add_arc(joints[next], branch.position, node, site, is_sound);
        if (n == 3) {
            add_arc(joints[before(i, n)], branch.position, node, site_after, is_sound);
            return;
        }
        open_branches_.push_back(static_cast<Index>(out_.branches.size()) - 1);
        joints[i] = {branch.position, node, site_after, joints[next].interval};
        joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(next));
    }

    // An arc inwards from a joint; `left` is the site before the joint.
    void add_arc(const Joint& from, const Vec2& to, Index head, Index left, bool is_curved) {
        const auto arc = static_cast<Index>(out_.arcs.size());
        const auto first_point = static_cast<Index>(out_.points.size());
        if (is_curved) sample_arc(left, from.site_after, from.position, to, 0);
        out_.arcs.push_back({from.node, head, left, from.site_after, first_point,
                             static_cast<Index>(out_.points.size()) - first_point});
        connect_open_branch(from.node, arc, true);
        connect_open_branch(head, arc, false);
    }

    // A branch that became a joint gets its third arc when that joint is used.
    void connect_open_branch(Index node, Index arc, bool at_tail) {
        const auto is_node = [&](Index branch) { return first_branch_node_ + branch == node; };
        const auto found = std::find_if(open_branches_.begin(), open_branches_.end(), is_node);
        if (found == open_branches_.end()) return;
        out_.branches[*found].arcs[2] = arc;
        out_.branches[*found].at_tail[2] = at_tail;
        open_branches_.erase(found);
    }

    // --- Geometry ------------------------------------------------------------------------------

    [[nodiscard]] Vec2 inside(const Vec2& p) const {
        // Towards the centroid until inside; only fallbacks come here.
        const Vec2 centroid = (corners_[0] + corners_[1] + corners_[2]) / 3;
        double keep = 1;
        for (int k = 0; k < 3; ++k) {
            const double at_p = signed_height(p, k);
            const double at_centroid = signed_height(centroid, k);
            if (at_p < 0 && at_centroid > 0)
                keep = std::min(keep, at_centroid / (at_centroid - at_p));
        }
        return centroid + keep * (p - centroid);
    }

    [[nodiscard]] double signed_height(const Vec2& p, int k) const {
        const Vec2& a = corners_[static_cast<std::size_t>(k)];
        const Vec2& b = corners_[static_cast<std::size_t>((k + 1) % 3)];
        const double length = (b - a).norm();
        return length > 0 ? cross(b - a, p - a) / length : 0;
    }

    [[nodiscard]] double outside(const Vec2& p) const {
        return std::max({0.0, -signed_height(p, 0), -signed_height(p, 1), -signed_height(p, 2)});
    }

    // By how much some other site than these is nearer at p.
    [[nodiscard]] double undercut(const Vec2& p, double distance, Index a, Index b, Index c) const {
        double least = distance;
        for (const PlanarRelay& relay : relays_) {
            if (relay.site == a || relay.site == b || relay.site == c) continue;
            least = std::min(least, reach(relay, p).distance);
        }
        return distance - least;
    }

    // Newton on equal distances from the sites before, at and after an interval.
    [[nodiscard]] BranchPoint find_branch(const Joint& before, const Joint& at,
                                          const Joint& after) const {
        const Index a = before.site_after;
        const Index b = at.site_after;
        const Index c = after.site_after;
        const Vec2 start = (at.position + after.position + before.position) / 3;
        Vec2 p = start;
        bool converged = false;
        double distance = 0;
        for (int i = 0; i < max_newton_steps; ++i) {
            const Reach ra = reach_from(relays_, a, p);
            const Reach rb = reach_from(relays_, b, p);
            const Reach rc = reach_from(relays_, c, p);
            distance = std::max({ra.distance, rb.distance, rc.distance});
            const Vec2 residual(ra.distance - rb.distance, rb.distance - rc.distance);
            if (!std::isfinite(distance)) break;
            if (residual.lpNorm<Eigen::Infinity>() <= convergence * (size_ + distance)) {
                converged = true;
                break;
            }
            Eigen::Matrix2d jacobian;
            jacobian.row(0) = (direction(p, ra) - direction(p, rb)).transpose();
            jacobian.row(1) = (direction(p, rb) - direction(p, rc)).transpose();
            const double determinant = jacobian.determinant();
            if (!(std::abs(determinant) > convergence)) break;
            Vec2 step = jacobian.inverse() * residual;
            const double norm = step.norm();
            if (norm > size_ / 2) step *= size_ / (2 * norm);
            p -= step;
        }
        const double gap = outside(p);
        if (!converged || gap > inside_tolerance * size_) {
            // Not a vertex of the diagram in here.
            return {start, reach_from(relays_, b, start).distance,
                    converged ? size_ + gap : 2 * size_};
        }
        return {gap > 0 ? inside(p) : p, distance, undercut(p, distance, a, b, c)};
    }

    [[nodiscard]] static Vec2 direction(const Vec2& p, const Reach& r) {
        const Vec2 d = p - r.from;
        const double norm = d.norm();
        return norm > 0 ? Vec2(d / norm) : Vec2(0, 0);
    }

    // Closing off an interval by one arc from its joint to the next: wrong where a third site is
    // nearer on the arc, and the less likely the farther the arc strays from its chord.
    [[nodiscard]] double lens_violation(const Joint& from, const Joint& to) const {
        const Vec2 middle = (from.position + to.position) / 2;
        Vec2 p;
        double distance;
        if (!project(from.site_after, to.site_after, from.position, to.position, p, distance)) {
            return 2 * size_;
        }
        constexpr double stray_weight = 1e-3;
        return undercut(p, distance, from.site_after, to.site_after, no_index) +
               stray_weight * (p - middle).norm();
    }

    // The point of the bisector of a and b opposite the middle of a chord; false where there is
    // none near. 1D Newton across the chord.
    [[nodiscard]] bool project(Index a, Index b, const Vec2& from, const Vec2& to, Vec2& p,
                               double& distance) const {
        const Vec2 chord = to - from;
        const double length = chord.norm();
        if (!(length > inside_tolerance * size_)) return false;
        const Vec2 normal(-chord.y() / length, chord.x() / length);
        const Vec2 middle = (from + to) / 2;
        double s = 0;
        for (int i = 0; i < max_newton_steps; ++i) {
            p = middle + s * normal;
            const Reach ra = reach_from(relays_, a, p);
            const Reach rb = reach_from(relays_, b, p);
            const double gap = ra.distance - rb.distance;
            distance = std::max(ra.distance, rb.distance);
            if (!std::isfinite(gap)) return false;
            if (std::abs(gap) <= convergence * (size_ + distance)) {
                return outside(p) <= inside_tolerance * size_;
            }
            const double slope = (direction(p, ra) - direction(p, rb)).dot(normal);
            if (!(std::abs(slope) > convergence)) return false;
            s = std::clamp(s - gap / slope, -length / 2, length / 2);
        }
        return false;
    }

    void sample_arc(Index a, Index b, const Vec2& from, const Vec2& to, int depth) {
        Vec2 p;
        double distance;
        if (depth == max_arc_depth || !project(a, b, from, to, p, distance)) return;
        if ((p - (from + to) / 2).norm() <= chord_tolerance_ * (to - from).norm()) return;
        sample_arc(a, b, from, p, depth + 1);
        out_.points.push_back(p);
        out_.point_distance.push_back(distance);
        sample_arc(a, b, p, to, depth + 1);
    }

    std::span<const PlanarRelay> relays_;
    const std::array<Vec2, 3>& corners_;
    double chord_tolerance_;
    LocalDiagram& out_;
    double size_;
    Index first_branch_node_ = 0;
    std::vector<Index> open_branches_;
};

}  // namespace

void solve_triangle(std::span<const PlanarRelay> relays, const std::array<Vec2, 3>& corners,
                    std::vector<Joint>& joints, Index first_branch_node, double chord_tolerance,
                    LocalDiagram& out) {
    TriangleSolver(relays, corners, chord_tolerance, out).run(joints, first_branch_node);
}

}  // namespace agvd
