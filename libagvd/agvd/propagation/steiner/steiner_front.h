//! \file
//! The wavefront of the Steiner engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/propagation/bucket_ring.h"
#include "agvd/propagation/retirement.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner/steiner_nodes.h"
#include "agvd/propagation/steiner/sweep.h"

namespace agvd {

//! The targets [begin, end) that a Steiner point serves across its edge ([meng2021]), numbered
//! counter-clockwise on the far side of a face: 1 to m on the next half-edge, m + 1 the apex, then
//! those on the previous half-edge.
struct TargetRange {
    Index begin;
    Index end;
};

//! A face in the frame of a half-edge. m points divide each other side into m + 1 intervals.
struct FarSide {
    double length;  //!< Of the half-edge.
    Vec2 apex;
    Index next_intervals;
    Index previous_intervals;

    //! Where a ray upwards from the base meets the far side, in target numbers (real).
    [[nodiscard]] double target_at(const Vec2& origin, const Vec2& direction) const {
        const double run = apex.y() * direction.x() / direction.y();
        if (run < apex.x() - origin.x()) {  // The apex lies to the right: the previous half-edge.
            const double shift =
                static_cast<double>(next_intervals) - static_cast<double>(previous_intervals);
            return previous_intervals * (2 - origin.x() / (apex.x() - run)) + shift;
        }
        return next_intervals * (length - origin.x()) / (run - apex.x() + length);
    }

    //! The targets in the strip of straight lines from the window of `parent`, below the base, to
    //! the window of `here`, on the base. Both windows extend by one spacing to either side.
    //! \param spacing         of the points on the base.
    //! \param parent_spacing  from the parent to its neighbour on its own edge, up to sign.
    [[nodiscard]] TargetRange visible_targets(const Vec2& here, double spacing, const Vec2& parent,
                                              const Vec2& parent_spacing) const {
        const Vec2 ahead = here - parent;
        const bool is_left = ahead.x() * parent_spacing.y() - ahead.y() * parent_spacing.x() > 0;
        const Vec2 turn = Vec2(spacing, 0) + (is_left ? -parent_spacing : parent_spacing);
        const Vec2 right = ahead + turn;
        const Vec2 left = ahead - turn;
        const double all = static_cast<double>(next_intervals) + previous_intervals;
        const double first = right.y() > 0 ? target_at(here, right) : 0;
        const double last = left.y() > 0 ? target_at(here, left) : all;
        return {static_cast<Index>(std::max(0.0, std::floor(first))),
                static_cast<Index>(std::min(all, std::ceil(last))) + 1};
    }
};

struct FrontEntry {
    double distance;
    Index site;
    Index node;

    auto operator<=>(const FrontEntry&) const = default;
};

//! The queue of searches that serve every node once, by buckets of distance + height (Sweep) and in
//! a bucket in the order (distance, site, node); WindowQueue is for those that may serve an item
//! again. Only the open bucket is a heap; a node that improves within its bucket is not pushed
//! again. The caller skips stale entries.
class FrontQueue {
public:
    //! \param bucket_width > 0, mesh units; no key may exceed 2^31 widths.
    explicit FrontQueue(double bucket_width) : width_(bucket_width), per_width_(1 / bucket_width) {}

    //! \param key  distance + height, >= 0.
    //! \param queued_in  the node's own memory of the bucket it waits in; no_index at first.
    void push(const FrontEntry& entry, double key, Index& queued_in) {
        const Index bucket = bucket_of(key);
        if (bucket <= buckets_.current()) {
            add(entry);
        } else if (queued_in != bucket) {
            queued_in = bucket;
            buckets_.push(bucket, entry.node);
        }
    }

    //! A node whose distance is not known yet, or what stands for several. Not while entries wait.
    void push_unknown(Index node, double key) { buckets_.push(bucket_of(key), node); }

    //! Makes pop() possible; false when nothing is left.
    //! \param load  load(node, bucket) returns the node's entry if it still waits in that bucket.
    template <typename Load>
    [[nodiscard]] bool refill(const Load& load) {
        while (heap_.empty()) {
            if (buckets_.empty()) return false;
            do {
                const Index node = buckets_.pop();
                if (const std::optional<FrontEntry> entry = load(node, buckets_.current())) {
                    add(*entry);
                }
            } while (buckets_.peek() != nullptr);
        }
        return true;
    }

    //! No entry has a key below this one.
    [[nodiscard]] double least_key() const { return (buckets_.current() - 1.0) * width_; }

    FrontEntry pop() {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        const FrontEntry result = heap_.back();
        heap_.pop_back();
        return result;
    }

    //! Bytes held. They never become fewer.
    [[nodiscard]] std::size_t bytes() const {
        return heap_.capacity() * sizeof(FrontEntry) + buckets_.bytes();
    }

private:
    [[nodiscard]] Index bucket_of(double key) const {
        return static_cast<Index>(key * per_width_) + 1;
    }
    void add(const FrontEntry& entry) {
        heap_.push_back(entry);
        std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }

    double width_;
    double per_width_;
    std::vector<FrontEntry> heap_;  // Of the open bucket.
    BucketRing<Index> buckets_;     // Numbered from 1.
};

//! One propagation over given Steiner points: run(), then retire_all(). Between the two the nodes
//! of faces that have not retired can be read.
class SteinerFront {
public:
    //! \param site_of_point  #sites: the numbers of the sites; those with the same number start at the
    //!                       same distance. Empty: their own.
    //! \param starts  by number: distances of the sites from themselves; empty: 0.
    //! \param counts  outlives the front, as the others do; NodeNumbers must suffice for it.
    SteinerFront(const Surface& surface, std::span<const SurfacePoint> sites,
                 std::span<const Index> site_of_point, std::span<const double> starts,
                 const SteinerCounts& counts);

    //! As SitePlacement::add_regions.
    void add_regions(std::span<const SiteShape> shapes, Index first) {
        placement_.add_regions(shapes, first);
    }

    //! Settles all nodes.
    //! \param retirement_interval  pops from one retirement to the next, > 0; infinity keeps all
    //!                             nodes.
    //! \param sink  gets the faces that retire.
    //! \throw Cancelled
    void run(double retirement_interval, const RetirementSink& sink, Poller& poller);
    //! Retires the faces that are left. Afterwards no point can be read.
    void retire_all(const RetirementSink& sink, Poller& poller);

    [[nodiscard]] const std::vector<SteinerNode>& vertices() const { return vertices_; }
    //! Nodes that were settled.
    [[nodiscard]] std::size_t num_pops() const { return num_pops_; }
    //! Most that was held at once.
    [[nodiscard]] std::size_t peak_bytes() const {
        return bytes_without_points() + peak_bytes_of_points_;
    }
    //! Beside the Steiner points, which are gone after retire_all().
    [[nodiscard]] std::size_t bytes_without_points() const {
        return vertices_.capacity() * sizeof(SteinerNode) + face_state_.capacity() +
               open_.capacity() * sizeof(Index) + queue_.bytes();
    }
    //! Node j of a half-edge: 0 is its tail, the others are its points, counted from the tail. A
    //! face on one side of the half-edge has not retired.
    [[nodiscard]] const SteinerNode& node(Index half_edge, Index j) const;

private:
    enum class FaceState : std::uint8_t { Untouched, Open, Retired };

    [[nodiscard]] Index number_of(Index point) const {
        return site_of_point_.empty() ? point : site_of_point_[point];
    }
    [[nodiscard]] bool refill();
    template <typename Height>
    void relax(SteinerNode& node, Index id, double distance, const Height& height, Index site,
               Index from, Index slot);
    [[nodiscard]] bool comes_first(Index from, Index slot, const SteinerNode& node) const;
    void relax_vertex(Index from, double distance, Index site, Index slot);
    void relax_points(Index from, Index begin, Index end, const Vec2& tail, const Vec2& along,
                      const Vec2& source, double base, Index site, Index slot);
    void relax_side(Index from, const Vec2& source, double base, Index site, Index slot);
    void await_sites();
    void start(const SurfacePoint& point, Index site);
    void serve_one_ring(Index vertex);
    void serve_onward(Index edge, Index point);
    [[nodiscard]] Vec2 slot_position(const SteinerNode& node, const Vec2& here) const;
    [[nodiscard]] Vec2 parent_spacing(const SteinerNode& node) const;

    // To be called when the front has come to a face.
    void open(Index face) {
        if (face_state_[face] != FaceState::Untouched) return;
        face_state_[face] = FaceState::Open;
        open_.push_back(face);
    }
    // Retires the open faces all of whose nodes have keys below `front`.
    void retire_behind(double front, const RetirementSink& sink, Poller& poller);
    void retire(Index face, RetiredFaces& retired);
    void hand_over(RetiredFaces& retired, const RetirementSink& sink, Poller& poller) const;
    [[nodiscard]] bool is_behind(Index face, double front) const;
    [[nodiscard]] bool are_all_from(Index half_edge, Index site);
    [[nodiscard]] bool is_mixed(Index face);
    void add_relay(Index half_edge, const Vec2& image, double weight, Index site,
                   std::vector<Relay>& relays) const;
    void collect(Index face, std::vector<Relay>& relays);
    void collect_across(Index h, Index twin, std::vector<Relay>& relays);

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    std::span<const Index> site_of_point_;
    std::span<const double> starts_;
    const SteinerCounts& counts_;
    SitePlacement placement_;
    NodeNumbers numbers_;
    Sweep sweep_;
    std::vector<Index> first_of_site_;  // By number, and one more: the first of its sites_.
    std::vector<SteinerNode> vertices_;
    SteinerPool pool_;
    FrontQueue queue_;
    std::vector<FaceState> face_state_;  // #F
    std::vector<Index> open_;
    std::vector<std::pair<Index, Index>> seen_slots_;  // Scratch: (slot, site).
    Ticker ticker_;                                    // Of run().
    std::size_t num_pops_ = 0;
    std::size_t peak_bytes_of_points_ = 0;
};

}  // namespace agvd
