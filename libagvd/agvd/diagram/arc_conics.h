//! \file
//! Which conics an arc between two sites is made of.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "agvd/diagram/bisectors.h"
#include "agvd/diagram/conic.h"

namespace agvd {

//! Splits arcs into conics. Scratch memory is kept from arc to arc.
class ArcConics {
public:
    //! A part of an arc, up to where the next one begins.
    struct Part {
        Vec2 end;
        Conic conic;  //!< The left site first.
    };

    //! \param relays     of the site on the left of the arc, and on the right.
    //! \param ends       of the arc, on the bisector but for errors of distances.
    //! \param distances  of the ends.
    //! \param size       of the triangle.
    //! \return whether the relays agree with the distances. They must outlive follow().
    [[nodiscard]] bool begin(const std::array<Relays, 2>& relays, const Chord& ends,
                             const std::array<double, 2>& distances, double size);

    //! \return the parts in their order; none where distances contradict each other. Valid until
    //!         the next call.
    //! Cost: O(relays) quick steps for each part.
    [[nodiscard]] std::span<const Part> follow();

private:
    // A point that paths come straight from, to what they see between two rays.
    struct Source {
        Vec2 focus;
        double weight;
        // Of the left and the right ray, away from what is seen; 0: no ray.
        std::array<Vec2, 2> normals;
        bool is_bent;  // At the end of an interval: there is a straight path as short, or shorter.

        [[nodiscard]] double distance(const Vec2& p) const { return weight + (p - focus).norm(); }
        [[nodiscard]] bool has_ray(std::size_t side) const {
            return normals[side].x() != 0 || normals[side].y() != 0;
        }
        [[nodiscard]] Vec2 ray(std::size_t side) const;
        [[nodiscard]] double outside(std::size_t side, const Vec2& p) const {
            return normals[side].dot(p - focus);
        }
    };
    using Sources = std::array<const Source*, 2>;  // Of both sites.
    // A source that becomes the nearest of its site; null: the one so far does not see any more.
    struct Event {
        const Source* source = nullptr;
        std::size_t site = 0;
    };
    // What follows on the arc: as seen from the left site it goes counter-clockwise, so that paths
    // leave what their source sees by its left ray; those from the right site by the right one.
    struct Piece {
        Sources sources;  // The nearest.
        Conic conic;
        Vec2 from;
        std::optional<Vec2> to;  // The first event so far.
        Event next;
        std::optional<Vec2> apex;        // The conic lies in the triangle of these points.
        std::array<Vec2, 2> directions;  // Of the paths at `from`: unit vectors.
        std::array<double, 2> lengths;   // Of their last straight pieces.

        [[nodiscard]] bool is_before(const Vec2& p, const Vec2& q) const;
        void stop(const std::optional<Vec2>& at, const Event& event);
    };

    // A relay of a source.
    struct Entry {
        const PlanarRelay* relay;
        bool is_joined;  // Its interval begins where another one ends, or it has none.
    };

    void collect_sources(std::size_t site, Relays relays);
    [[nodiscard]] std::optional<std::size_t> window_beside(std::size_t window) const;
    void join(std::size_t site, std::size_t left, std::size_t right);
    void bend(std::size_t site, std::size_t window, std::size_t side);
    [[nodiscard]] bool goes_on(const Source& source, std::size_t site, const Vec2& p) const;
    [[nodiscard]] const Source* nearest(std::size_t site, const Vec2& p, bool behind) const;
    [[nodiscard]] Piece begin_piece(const Sources& sources, const Vec2& from,
                                    const Vec2& end) const;
    // Whether the conic does not come to what a source sees.
    [[nodiscard]] bool is_out_of_sight(const Source& source, const Piece& piece) const {
        if (!piece.apex) return false;
        const auto is_beyond = [&](std::size_t side) {
            return source.has_ray(side) && source.outside(side, piece.from) >= -equal_ &&
                   source.outside(side, *piece.to) >= -equal_ &&
                   source.outside(side, *piece.apex) >= -equal_;
        };
        return is_beyond(0) || is_beyond(1);
    }
    void stop_at_source(const Source& source, std::size_t site, Piece& piece) const;
    [[nodiscard]] bool find_parts();
    void add(const Part& part);
    [[nodiscard]] bool is_end(const Vec2& p) const;
    [[nodiscard]] bool is_on(const Conic& conic, const Vec2& p) const;
    [[nodiscard]] bool is_near(const Vec2& a, const Vec2& b) const;
    // So far outside rounding may put what a source sees.
    [[nodiscard]] double tolerance() const { return 16 * equal_; }

    std::array<std::vector<Source>, 2> sources_;
    std::vector<Entry> relays_;
    Chord ends_{};
    Sources first_{};  // The nearest at the arc's tail.
    double size_ = 0;
    double equal_ = 0;  // Distances that differ by less are equal.
    double blur_ = 0;   // By how much the distances of ends may differ.
    std::vector<Part> parts_;
};

}  // namespace agvd
