//! \file
//! Windows: beams of straight shortest paths where they cross an edge; their memory; and their
//! children: the parts of a beam that leave the face behind the edge through its other sides.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "agvd/core/run_array.h"
#include "agvd/propagation/layout.h"

namespace agvd {

//! The straight paths from a site or pseudo-source through [begin, end] of a half-edge into its
//! face ([mitchell1987]). The image (x, y) of the source lies in the frame of the half-edge, y < 0.
//! The distance of a point p of the face through the window is at least weight + |image - p|, and a
//! real path exceeds that by at most `error`.
struct Window {
    double x, y;
    double weight;
    double begin, end;
    double at_begin, at_end;  //!< Distances at the ends of the interval.
    float error;
    bool is_served;  //!< The half-edges beyond the face have got their parts.

    //! Distance of a point of the edge. At the ends no root is taken.
    [[nodiscard]] double distance(double at) const {
        if (at == begin) return at_begin;
        if (at == end) return at_end;
        return weight + std::sqrt((at - x) * (at - x) + y * y);
    }
    //! The part over [from, to], which must lie inside [begin, end].
    [[nodiscard]] Window part(double from, double to) const {
        Window result = *this;
        result.at_begin = distance(from);
        result.at_end = distance(to);
        result.begin = from;
        result.end = to;
        return result;
    }
    //! Least distance over the interval. Without branches, which cannot be predicted.
    [[nodiscard]] double nearest() const {
        const std::array<double, 2> least{std::min(at_begin, at_end), weight - y};
        return least[static_cast<std::size_t>((begin < x) & (x < end))];
    }
};
static_assert(sizeof(Window) == 64);
static_assert(std::is_trivial_v<Window>);  // New memory is not initialized.

//! Runs of windows, known by number. A run has room for the next power of two and does not move;
//! given back, it is used again for its size while it is still in the cache.
class WindowStore {
public:
    //! Gives all runs back; keeps the memory.
    void clear() {
        runs_.clear();
        free_runs_.fill(no_index);
        next_block_ = 0;
        room_ = {};
    }
    //! \return the number of a run, whose windows (> 0) are to be written.
    [[nodiscard]] Index take(Index count) {
        const auto size_class = static_cast<int>(std::bit_width(count - 1));
        Index& free_run = free_runs_[static_cast<std::size_t>(size_class)];
        if (free_run == no_index) {
            const std::size_t size = std::size_t{1} << size_class;
            if (room_.size() < size) open_block(size);
            const Index run = runs_.push({room_.data(), count, no_index, size_class});
            room_ = room_.subspan(size);
            return run;
        }
        const Index run = free_run;
        free_run = runs_[run].next;
        runs_[run].count = count;
        return run;
    }
    void give_back(Index run) {
        Index& free_run = free_runs_[static_cast<std::size_t>(runs_[run].size_class)];
        runs_[run].next = free_run;
        free_run = run;
    }

    [[nodiscard]] Index room(Index run) const { return Index{1} << runs_[run].size_class; }
    //! \param count  of windows that the run has from now on, up to its room.
    void resize(Index run, Index count) { runs_[run].count = count; }

    [[nodiscard]] std::span<Window> operator[](Index run) {
        return {runs_[run].first, runs_[run].count};
    }
    [[nodiscard]] std::span<const Window> operator[](Index run) const {
        return {runs_[run].first, runs_[run].count};
    }
    //! Starts to load the first windows of a run.
    [[gnu::always_inline]] void prefetch(Index run) const {
        const Window* const first = runs_[run].first;
        for (Index i = 0; i < 4; ++i) __builtin_prefetch(first + i);
    }
    //! A link of a run in use, for lists of its owner.
    [[nodiscard]] Index& next(Index run) { return runs_[run].next; }

    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = runs_.bytes();
        for (const Block& block : blocks_) sum += block.size * sizeof(Window);
        return sum;
    }

private:
    struct Run {
        Window* first;
        Index count;
        Index next;
        int size_class;
    };
    struct Block {
        std::unique_ptr<Window[]> windows;
        std::size_t size;
    };

    // Blocks grow with what is in use, so that little is wasted.
    [[gnu::noinline]] void open_block(std::size_t size) {
        constexpr std::size_t least = 64, most = 4096;
        while (next_block_ < blocks_.size() && blocks_[next_block_].size < size) ++next_block_;
        if (next_block_ == blocks_.size()) {
            const std::size_t wanted = blocks_.empty() ? least : 2 * blocks_.back().size;
            size = std::max(size, std::min(wanted, most));
            blocks_.push_back({std::make_unique_for_overwrite<Window[]>(size), size});
        }
        const Block& block = blocks_[next_block_++];
        room_ = {block.windows.get(), block.size};
    }

    RunArray<Run> runs_;
    std::array<Index, 33> free_runs_{};  // By size class: list of runs.
    std::vector<Block> blocks_;
    std::size_t next_block_ = 0;
    std::span<Window> room_;  // The free part of the block in use.
};

//! A ray that passes the end of a window by at most this, relative to the length of the edge or to
//! the distance of the image if that is less, counts as straight.
inline constexpr double grazing = 1e-10;

//! A share of the edge: of a site nearer to a vertex, rounding may hide which faces it sees.
inline constexpr double near_vertex = 1e-4;

//! A vector in the frame whose x axis is the unit vector `axis`.
[[nodiscard]] inline Vec2 into(const Vec2& axis, const Vec2& v) {
    return {axis.x() * v.x() + axis.y() * v.y(), axis.x() * v.y() - axis.y() * v.x()};
}

//! Sine of the angle of a beam. A narrower one is dropped as rounding: the beams beside it reach
//! the same by paths longer by the square of this.
inline constexpr double negligible_beam = 1e-13;

//! A share of a distance and an edge by which two ways to compute a distance may differ: a bound
//! along edges must not remove the window of the same path.
inline constexpr double path_rounding = 1e-12;

//! A share of the edge: the error of coordinates after some changes of frame.
inline constexpr double frame_rounding = 1e-14;

//! Where the paths along the edge from its two ends meet, clamped to an interval. A window that is
//! beaten there is beaten on all of the interval.
inline double meeting_point(double tail_bound, double head_bound, double length, double begin,
                            double end) {
    return std::min(std::max(begin, (head_bound + length - tail_bound) / 2), end);
}

//! The face above a half-edge: tail at (0, 0), head at (length, 0). Windows leave through the next
//! half-edge (right) and the previous one (left). Numbers: compilers split and rejoin vectors.
struct WindowFace {
    WindowFace(const Corners& corners, Index base_half_edge)
        : half_edge(base_half_edge),
          base(corners[half_edge]),
          next(corners[Surface::next(half_edge)]),
          previous(corners[Surface::previous(half_edge)]),
          length(base.length),
          apex_x(base.turn.x() * length),
          apex_y(base.turn.y() * length),
          right_x((length - apex_x) / next.length),
          right_y(-apex_y / next.length),
          left_x(apex_x / previous.length),
          left_y(apex_y / previous.length) {}

    Index half_edge;
    const Corner& base;
    const Corner& next;
    const Corner& previous;
    double length;
    double apex_x, apex_y;
    double right_x, right_y;  // Unit vector from the apex to the head.
    double left_x, left_y;    // From the tail to the apex.
    double tail_bound = 0, head_bound = 0, apex_bound = 0;
    Index apex_record = no_index;
};

//! The part of a window on one side of a limit. The limit may be the ray to the apex.
struct WindowPart {
    const Window* window = nullptr;
    double limit = 0;
    bool is_apex = false;
};

//! The paths that a child is compared with.
struct Rivals {
    double begin_bound, end_bound;  //!< Of the ends of its edge.
    double length;                  //!< Of the edge.
    double spare;      //!< How much longer the child's way to its end beside the corner behind it
                       //!< is than the bound of that corner.
    double corner_sq;  //!< Squared distance of that end from the corner.
};

//! Whether a child is wide enough, and no path around its edge or the corner behind is shorter.
inline bool lives(const Window& child, const Rivals& rivals) {
    const auto& [begin_bound, end_bound, length, spare, corner_sq] = rivals;
    const double to_begin = child.at_begin - child.weight;
    const double to_end = child.at_end - child.weight;
    const double at = meeting_point(begin_bound, end_bound, length, child.begin, child.end);
    const double around = std::min(begin_bound + at, end_bound + length - at) - child.weight +
                          path_rounding * (child.at_begin + length);
    const bool is_wide =
        ((child.begin - child.end) * child.y > negligible_beam * to_begin * to_end) |
        ((child.begin < child.x) & (child.x < child.end) & (child.y < 0));
    return is_wide & (around >= 0) &
           (around * around >= (at - child.x) * (at - child.x) + child.y * child.y) &
           ((spare <= 0) | (corner_sq >= spare * spare));
}

//! The part of a window in the frame of an edge behind it, where its image is at (x, y).
inline Window part_behind(const Window& w, double x, double y, double begin, double end) {
    return {x,
            y,
            w.weight,
            begin,
            end,
            w.weight + std::sqrt((begin - x) * (begin - x) + y * y),
            w.weight + std::sqrt((end - x) * (end - x) + y * y),
            w.error,
            false};
}

//! Writes the part that goes on through the next half-edge. In the frame beyond it the apex is at
//! 0, and a point of the base s before the head is at (length, 0) - s (right_x, sine).
//! \return false if the child is dropped. Without branches, which could not be predicted.
inline bool pass_right(const WindowPart& part, const WindowFace& face, Window& child) {
    const Window& w = *part.window;
    const double length = face.next.length;
    const double sine = face.apex_y / length;  // Of the angle at the head.
    const double dx = w.x - face.apex_x;
    const double dy = w.y - face.apex_y;
    const double x = dx * face.right_x + dy * face.right_y;
    const double y = dy * face.right_x - dx * face.right_y;
    const auto seen_at = [&](double at) {
        const double s = face.length - at;
        const double from_x = length - s * face.right_x;
        return x + (from_x - x) * y / (y + s * sine);
    };
    const double begin = part.is_apex ? 0.0 : std::max(seen_at(part.limit), 0.0);
    const double end = w.end == face.length ? length : std::min(seen_at(w.end), length);
    child = part_behind(w, x, y, begin, end);
    const double tail_x = length - face.length * face.right_x;
    const double tail_y = -face.length * sine;
    const double to_tail = (tail_x - end) * (tail_x - end) + tail_y * tail_y;
    return lives(
        child, {face.apex_bound, face.head_bound, length,
                child.at_end - face.tail_bound - path_rounding * (child.at_end + length), to_tail});
}

//! The same through the previous half-edge: the tail at 0, the apex at `length`.
inline bool pass_left(const WindowPart& part, const WindowFace& face, Window& child) {
    const Window& w = *part.window;
    const double length = face.previous.length;
    const double x = w.x * face.left_x + w.y * face.left_y;
    const double y = w.y * face.left_x - w.x * face.left_y;
    const auto seen_at = [&](double at) {
        return x + (at * face.left_x - x) * y / (y + at * face.left_y);
    };
    const double begin = w.begin == 0 ? 0.0 : std::max(seen_at(w.begin), 0.0);
    const std::array ends{std::min(seen_at(part.limit), length), length};
    const double end = ends[static_cast<std::size_t>(part.is_apex)];
    child = part_behind(w, x, y, begin, end);
    const double head_x = face.length * face.left_x;
    const double head_y = -face.length * face.left_y;
    const double to_head = (head_x - begin) * (head_x - begin) + head_y * head_y;
    return lives(
        child,
        {face.tail_bound, face.apex_bound, length,
         child.at_begin - face.head_bound - path_rounding * (child.at_begin + length), to_head});
}

}  // namespace agvd
