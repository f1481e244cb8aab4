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

    //! \param relays  of the site on the left of the arc, and on the right.
    //! \param ends    of the arc, on the bisector but for errors of distances.
    //! \param size    of the triangle.
    //! \return in their order; none where distances contradict each other. Valid until the next
    //!         call.
    //! Cost: O(relays) for each part.
    [[nodiscard]] std::span<const Part> split(const std::array<Relays, 2>& relays,
                                              const Chord& ends, double size);

private:
    // A point that paths come straight from, to what they see between two directions.
    struct Source {
        Vec2 focus;
        double weight;
        std::array<Vec2, 2> rays;  // Sees what lies right of the first and left of the second.
        std::array<bool, 2> has_ray;
        bool is_bent;  // At the end of an interval: there is a straight path as short, or shorter.

        [[nodiscard]] double distance(const Vec2& p) const { return weight + (p - focus).norm(); }
        [[nodiscard]] bool sees(const Vec2& p) const {
            return (!has_ray[0] || cross(rays[0], p - focus) <= 0) &&
                   (!has_ray[1] || cross(rays[1], p - focus) >= 0);
        }
    };
    // A point of the bisector, and the nearest source of either site there.
    struct Middle {
        Vec2 point;
        std::array<const Source*, 2> sources;
        [[nodiscard]] Conic conic() const {
            return {{sources[0]->focus, sources[1]->focus},
                    {sources[0]->weight, sources[1]->weight}};
        }
    };
    // How far a conic goes from a point of it: against the arc's direction, and along it.
    struct Reached {
        const Conic& conic;
        Vec2 from, right;                 // A point of it, and its gradient there.
        std::array<Vec2, 2> ends;         // `from` where nothing ends it.
        std::array<double, 2> length_sq;  // Infinity there.
    };

    void join_windows(Relays relays);
    void collect_sources(std::size_t site, Relays relays);
    [[nodiscard]] std::array<const Source*, 2> nearest(const Vec2& p) const;
    [[nodiscard]] std::optional<Middle> find_middle(const Chord& part) const;
    static void shorten(Reached& reached, const std::optional<Vec2>& at);
    [[nodiscard]] Reached reach_ends(const Conic& conic, const Vec2& from, const Chord& part) const;
    void stop_at_source(const Source& source, std::size_t site, Reached& reached) const;
    [[nodiscard]] bool split_part(const Chord& part);
    void add(const Part& part);
    [[nodiscard]] double slack(double distance) const;
    [[nodiscard]] bool is_near(const Vec2& a, const Vec2& b, double distance) const;

    std::vector<PlanarRelay> windows_;
    std::array<std::vector<Source>, 2> sources_;
    double size_ = 0;
    double blur_ = 0;  // Where ends lie off the bisector, parts as short as that may have no conic.
    int parts_left_ = 0;
    bool has_failed_ = false;
    std::vector<Part> parts_;
};

}  // namespace agvd
