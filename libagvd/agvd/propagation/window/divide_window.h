//! \file
//! A window meets the apex of the face behind its edge: it reaches the apex, and is divided there.
#pragma once

#include <algorithm>
#include <cmath>

#include "agvd/propagation/window/front_state.h"
#include "agvd/propagation/window/reach_vertex.h"
#include "agvd/propagation/window/window_rays.h"

namespace agvd {

//! Reaches the apex along a ray that bends at one end of a window. That gives a bound only.
inline void reach_bent(FrontState& front, const WindowFace& face, double distance, double at,
                       float error) {
    const VertexRecord& apex = front.vertices.records[face.apex_record];
    const Vec2 rest(face.apex_x - at, face.apex_y);
    const double limit = apex.upper - error - distance;
    if (!(limit > 0 && rest.squaredNorm() < limit * limit)) return;  // Most end here: no root.
    front.vertices.lower_bound(face.apex_record, distance + rest.norm() + error);
}

//! Reaches the apex along a straight ray.
//! \return the distance of the apex.
inline double reach_apex(FrontState& front, const Window& w, double ray, const WindowFace& face) {
    const Vec2 to_image(w.x - face.apex_x, w.y - face.apex_y);
    const double at_apex = w.weight + to_image.norm();
    // A merged window's end ray touches the apex on one side only, and others go past it on
    // the other side in other directions.
    const bool touches = w.error > 0 && !(w.begin < ray && ray < w.end);
    const VertexRecord& apex = front.vertices.records[face.apex_record];
    const bool may_be_pseudo_source =
        front.input.max_error > 0 && front.input.surface.can_be_pseudo_source[apex.vertex] != 0;
    if (at_apex < apex.low || may_be_pseudo_source) {
        reach_vertex(front, face.apex_record,
                     {at_apex, w.error, touches ? no_index : Surface::previous(face.half_edge),
                      into(Vec2(-face.left_x, -face.left_y), to_image)});
    } else {
        front.vertices.lower_bound(face.apex_record, at_apex + w.error);
    }
    return at_apex;
}

//! Splits a window at the ray to the apex. One angle, one split: rays that cross the best one on
//! its way to the apex lead nowhere ([chen1990]).
[[nodiscard]] inline Division split(const Window& w, double ray, double at_apex, EdgeRecord& edge) {
    Division division{{&w, ray, true}, {&w, ray, true}};
    if (at_apex < edge.apex_distance) {
        if (at_apex + w.error < edge.apex_distance) {
            edge.apex_distance = at_apex + w.error;
            edge.apex_ray = ray;
        }
    } else if (ray < edge.apex_ray) {
        division.right = {edge.apex_ray < w.end ? &w : nullptr, edge.apex_ray, false};
    } else {
        division.left = {w.begin < edge.apex_ray ? &w : nullptr, edge.apex_ray, false};
    }
    return division;
}

//! Reaches the apex, and decides which part of a window goes on to the right and to the left.
[[nodiscard]] inline Division divide(FrontState& front, const Window& w, EdgeRecord& edge,
                                     const WindowFace& face) {
    const double ray = (w.x * face.apex_y - w.y * face.apex_x) / (face.apex_y - w.y);
    const double slack =
        grazing * std::min(face.length, std::min(w.at_begin, w.at_end) - w.weight) +
        frame_rounding * face.length;
    if (ray < w.begin - slack) {
        reach_bent(front, face, w.at_begin, w.begin, w.error);
    } else if (ray > w.end + slack) {
        reach_bent(front, face, w.at_end, w.end, w.error);
    } else {
        const double at_apex = reach_apex(front, w, ray, face);
        if (w.begin < ray && ray < w.end) return split(w, ray, at_apex, edge);
    }
    if (ray <= w.begin) return {{&w, w.begin, false}, {}};
    return {{}, {&w, w.end, false}};
}

}  // namespace agvd
