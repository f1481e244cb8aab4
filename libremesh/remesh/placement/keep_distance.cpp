// Faces are repaired one by one, the farthest first: vertices move off the surface if that is
// enough, else edges are divided. Then vertices go where all faces around are near. At last both
// surfaces are proved to be near each other; where they are not, faces are repaired again.
#include "remesh/placement/keep_distance.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "remesh/placement/bound_guard.h"
#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/distance_proof.h"
#include "remesh/placement/shape_steps.h"

namespace remesh::detail {
namespace {

// Share of the limit that edits aim at: points between those looked at may be farther off.
constexpr double aimed_share = 0.93;
// The same where vertices go, and the least quality of the triangles there: an angle of 40 degrees.
constexpr double thinned_share = 0.85, least_thinned_quality = 0.75;
// Gaps up to this share of the limit are small: vertices may go there.
constexpr double near_share = 0.5;
// An edit that does not reach the aim must bring the largest gap down to this share of it.
constexpr double least_progress = 0.85;
// A shorter step of a vertex, in limits, is none.
constexpr double least_step = 0.05;
// How far a face is moved towards the input: so that this share of the aim is left.
constexpr double share_left = 0.7;
// Triangles below this quality are improved beside a new vertex, by so many slides.
constexpr double wanted_quality = 0.7;
constexpr std::size_t slides_for_each = 12;
// A new vertex divides an edge near the gap, but not near an end of it.
constexpr double least_share = 0.35;
// Each finds fewer points than the one before, mostly, and proves again only what has changed.
constexpr int most_proofs = 100;
// Neighbours into which a vertex may be merged that are tried.
constexpr std::size_t most_targets = 2;

// All faces are tried by the first rule before the next one.
struct Rule {
    double least_quality;  // Of the triangles after an edit, unless they were worse before.
    int most_added;        // Vertices by one edit.
};
constexpr std::array rules{Rule{0.57, 4}, Rule{0.425, 4}, Rule{0.2, 12}};

class DistanceRepair {
public:
    DistanceRepair(EditedMesh& mesh, const DistanceLimit& limit, Index num_faces, Ticker& ticker)
        : mesh_(mesh),
          limit_(limit),
          aim_(aimed_share * limit.limit),
          bound_(mesh, limit.input.tree, limit.points, near_share * limit.limit, ticker),
          crossings_(mesh),
          steps_(mesh, num_faces, wanted_quality, ticker) {}

    //! Repairs the farthest face.
    //! \return false if it stays too far: then the other faces are not worth their time.
    bool repair_farthest() {
        const FarFaces faces = far_faces();
        if (faces.empty() || faces.top().first <= provable_share * limit_.limit) return true;
        return std::ranges::any_of(rules, [&](const Rule& rule) {
            rule_ = rule;
            return !repair(faces.top().second).empty();
        });
    }
    //! Repairs all faces that are too far, or up to one that cannot be.
    void run() {
        const double most = provable_share * limit_.limit;
        for (const Rule& rule : rules) {
            rule_ = rule;
            FarFaces faces = far_faces();
            while (!faces.empty()) {
                const auto [distance, f] = faces.top();
                faces.pop();
                if (!is_far(f) || bound_.gap_at(f).distance != distance) continue;
                const std::vector<Index> changed = repair(f);
                // After the last rule all was in vain.
                if (changed.empty() && &rule == &rules.back() && distance > most) return;
                for (const Index g : changed) push_far(g, faces);
            }
        }
    }
    //! Takes vertices away, the ones with the nearest faces around first.
    void thin() {
        rule_ = {least_thinned_quality, 0};
        num_slides_ = slides_for_each;
        std::vector<std::pair<double, Index>> order;
        for (Index v = 0; v < mesh_.num_vertices(); ++v) {
            if (is_to_spare(v)) order.emplace_back(gap_around(v), v);
        }
        std::sort(order.begin(), order.end());
        for (const auto& [gap, v] : order) {
            if (is_to_spare(v)) remove(v);
        }
    }
    //! Improves triangles by flips and slides.
    void improve_shapes() {
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            if (!steps_.is_bad(f)) continue;
            const EditedMesh::Mark before = mesh_.mark();
            steps_.allow_slides(slides_for_each);
            if (steps_.improve(f)) steps_.relax(before);
            if (measure(before, aim_)) {
                (void)take_over(before);
            } else {
                mesh_.take_back(before);
            }
        }
    }
    [[nodiscard]] double largest_gap() const {
        double largest = 0;
        for (const Index f : mesh_.faces()) largest = std::max(largest, bound_.gap_at(f).distance);
        return largest;
    }
    //! Takes a gap into account that was found elsewhere.
    void add(const FarPair& far) { bound_.add(far); }

private:
    using FarFaces = std::priority_queue<std::pair<double, Index>>;

    enum class Kind : std::uint8_t {
        Move,     // Moves a corner, or all, by the gap.
        Divide,   // Divides an edge, then others as long as that is needed.
        Inscribe  // Puts a corner, or all, onto the surface, then divides edges likewise.
    };
    struct Edit {
        Kind kind;
        Index k;  // The edge or corner.
    };
    static constexpr Index all_corners = 3;

    [[nodiscard]] bool is_far(Index f) const {
        return mesh_.face(f).is_there && bound_.gap_at(f).distance > aim_;
    }
    void push_far(Index f, FarFaces& faces) const {
        if (is_far(f)) faces.emplace(bound_.gap_at(f).distance, f);
    }

    [[nodiscard]] FarFaces far_faces() const {
        FarFaces faces;
        for (const Index f : mesh_.faces()) push_far(f, faces);
        return faces;
    }

    // \return the faces changed.
    std::vector<Index> repair(Index f) {
        const std::array<Index, 3> edges = edges_by_length(f);
        std::vector<Index> changed;
        for (Index k = 0; k <= all_corners; ++k) {
            if (try_edit({Kind::Move, k}, f, aim_, changed)) return changed;
        }
        const double most = std::max(aim_, least_progress * bound_.gap_at(f).distance);
        // Slides carry the offsets of vertices elsewhere, which may do harm.
        for (const std::size_t num_slides : {std::size_t{0}, slides_for_each}) {
            num_slides_ = num_slides;
            for (const Index k : edges) {
                if (try_edit({Kind::Divide, k}, f, most, changed)) return changed;
            }
            for (const Index k : {all_corners, Index{0}, Index{1}, Index{2}}) {
                if (try_edit({Kind::Inscribe, k}, f, most, changed)) return changed;
            }
        }
        return changed;
    }
    // \param most  the largest gap afterwards.
    // \param[out] changed  faces, if the edit stays.
    bool try_edit(const Edit& edit, Index f, double most, std::vector<Index>& changed) {
        const EditedMesh::Mark before = mesh_.mark();
        if (apply(edit, f) && (edit.kind == Kind::Move ? measure(before, most) : divide(before)) &&
            farthest_.second.distance <= most) {
            changed = take_over(before);
            return true;
        }
        mesh_.take_back(before);
        return false;
    }
    bool apply(const Edit& edit, Index f) {
        const Gap& gap = bound_.gap_at(f);
        if (edit.kind == Kind::Divide) return split(f, edit.k, gap);
        const Triangle corners = mesh_.face(f).corner;
        const bool is_all = edit.k == all_corners;
        const Vec3 way = (is_all ? 1 - share_left * aim_ / gap.distance : 1) * gap.way;
        bool is_done = false;
        for (Index k = 0; k < 3; ++k) {
            if (!is_all && edit.k != k) continue;
            const Vec3 before = mesh_.at(corners[k]);
            const bool is_put =
                edit.kind == Kind::Move ? move(corners[k], way) : put_onto_surface(corners[k]);
            const double step = (mesh_.at(corners[k]) - before).norm();
            is_done = is_done || (is_put && step > least_step * limit_.limit);
        }
        return is_done;
    }
    // Divides the farthest of the faces changed until all are near enough.
    // \return false if the edit may not stay.
    bool divide(const EditedMesh::Mark& before) {
        for (int num_added = 0;; ++num_added) {
            if (!measure(before, infinity)) return false;
            const auto [f, gap] = farthest_;
            if (gap.distance <= aim_ || num_added == rule_.most_added) return true;
            if (!split(f, edges_by_length(f)[0], gap)) return false;
        }
    }
    // The edges of a face, the longest first.
    [[nodiscard]] std::array<Index, 3> edges_by_length(Index f) const {
        const Triangle& t = mesh_.face(f).corner;
        std::array<Index, 3> edges{0, 1, 2};
        std::ranges::stable_sort(edges, std::greater<>(), [&](Index k) {
            return (mesh_.at(t[k]) - mesh_.at(t[(k + 1) % 3])).squaredNorm();
        });
        return edges;
    }
    bool move(Index v, const Vec3& way) {
        return limit_.may_leave_surface && mesh_.mobility(v) == Mobility::Free &&
               mesh_.put_offset(v, mesh_.offset(v) + way);
    }
    // The input may lie off the surface, if that is a coarser one.
    bool put_onto_surface(Index v) {
        Vec3 offset = Vec3::Zero();
        if (limit_.may_leave_surface && mesh_.mobility(v) == Mobility::Free) {
            const Vec3 on_surface = mesh_.at(v) - mesh_.offset(v);
            offset = limit_.input.tree.query(mesh_.at(v)).position - on_surface;
        }
        return mesh_.put_offset(v, offset);
    }
    // Divides edge k of a face near a gap, by a vertex on the surface.
    bool split(Index f, Index k, const Gap& gap) {
        const Triangle& corners = mesh_.face(f).corner;
        const Vec3 &a = mesh_.at(corners[k]), &b = mesh_.at(corners[(k + 1) % 3]);
        const Vec3 along = b - a;
        const double length = along.norm();
        if (!(length > 0)) return false;
        const double share =
            std::clamp(along.dot(gap.at - a) / (length * length), least_share, 1 - least_share);
        if (std::min(share, 1 - share) * length < limit_.least_edge) return false;
        const EditedMesh::Mark before = mesh_.mark();
        const Index added = mesh_.split(f, k, share);
        if (added == no_index || !put_onto_surface(added)) return false;
        steps_.allow_slides(num_slides_);
        steps_.relax(before);
        return true;
    }

    // Finds the farthest of the faces changed.
    // \return false if they may not stay, by their shape or intersections, or are beyond `most`.
    bool measure(const EditedMesh::Mark& before, double most) {
        const double least = mesh_.has_bounds() ? low_quality : rule_.least_quality;
        if (!steps_.keeps_quality(before, least)) return false;
        const std::vector<Index> changed = mesh_.changed_since(before);
        farthest_ = bound_.measure(changed, most);
        return farthest_.second.distance <= most && crossings_.accepts(changed);
    }
    // After measure(), of the same changes.
    std::vector<Index> take_over(const EditedMesh::Mark& before) {
        std::vector<Index> changed = mesh_.changed_since(before);
        bound_.take_over(changed);
        crossings_.take_over();
        return changed;
    }

    [[nodiscard]] double gap_around(Index v) const {
        double largest = 0;
        for (const Index f : mesh_.faces_at(v)) {
            largest = std::max(largest, bound_.gap_at(f).distance);
        }
        return largest;
    }
    [[nodiscard]] bool is_to_spare(Index v) const {
        return !mesh_.faces_at(v).empty() && mesh_.mobility(v) < Mobility::Node &&
               gap_around(v) <= near_share * limit_.limit;
    }
    void remove(Index v) {
        std::vector<Index> neighbours;
        for (const Index f : mesh_.faces_at(v)) {
            for (const Index w : mesh_.face(f).corner) {
                if (w != v) neighbours.push_back(w);
            }
        }
        std::vector<std::pair<double, Index>> targets;
        for (const Index w : distinct(std::move(neighbours))) {
            const EditedMesh::Mark before = mesh_.mark();
            if (mesh_.collapse(v, w)) targets.emplace_back(-steps_.worst_since(before), w);
            mesh_.take_back(before);
        }
        std::sort(targets.begin(), targets.end());
        targets.resize(std::min(targets.size(), most_targets));
        for (const auto& [quality, w] : targets) {
            const EditedMesh::Mark before = mesh_.mark();
            (void)mesh_.collapse(v, w);
            steps_.allow_slides(num_slides_);
            steps_.relax(before);
            if (keeps_edges(before) && measure(before, thinned_share * limit_.limit)) {
                (void)take_over(before);
                return;
            }
            mesh_.take_back(before);
        }
    }
    // Whether no edge of the faces changed is too long.
    [[nodiscard]] bool keeps_edges(const EditedMesh::Mark& before) const {
        const std::vector<Index> changed = mesh_.changed_since(before);
        return std::ranges::all_of(changed, [&](Index f) {
            return !mesh_.face(f).is_there ||
                   longest_edge_of(mesh_.corners_of(f)) <= limit_.most_edge;
        });
    }

    EditedMesh& mesh_;
    const DistanceLimit& limit_;
    const double aim_;
    BoundGuard bound_;
    CrossingGuard<EditedMesh> crossings_;
    ShapeSteps steps_;
    Rule rule_ = rules[0];
    std::size_t num_slides_ = 0;      // Beside each new vertex.
    std::pair<Index, Gap> farthest_;  // Found by measure().
};

}  // namespace

std::optional<double> keep_distance(const MeshCurves& curves, std::span<const Mobility> mobility,
                                    const DistanceLimit& limit, PlacedMesh& mesh,
                                    const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    EditedMesh edited(curves, mesh, mobility, ShapeMeasure(limit.bounds));
    DistanceRepair repair(edited, limit, curves.surface().num_faces(), ticker);
    DistanceProof proof(edited, limit.input, limit.limit, limit.num_threads, poller);
    // What could not be repaired needs no proof.
    const auto may_be_near = [&] { return repair.largest_gap() <= provable_share * limit.limit; };
    if (repair.repair_farthest()) repair.run();
    if (may_be_near()) {
        repair.thin();
        repair.improve_shapes();
    }
    bool is_near = false;
    for (int round = 0; round < most_proofs && !is_near && may_be_near(); ++round) {
        const std::vector<FarPair> far = proof.run();
        is_near = far.empty();
        for (const FarPair& pair : far) repair.add(pair);
        if (!is_near) repair.run();
    }
    std::vector<Index> numbers;
    mesh = edited.result(numbers);
    if (!is_near) return std::nullopt;
    return repair.largest_gap();
}

}  // namespace remesh::detail
