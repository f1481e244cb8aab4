#include "agvd/diagram/bisector_arc.h"

#include "agvd/diagram/conic.h"

namespace agvd {

const char* name_of(ArcKind kind) {
    switch (kind) {
        case ArcKind::Line:
            return "line";
        case ArcKind::Hyperbola:
            return "hyperbola";
        default:
            return "chord";
    }
}

Vec2 point_on_arc(const BisectorArc& arc, double share) {
    if (share <= 0) return arc.begin;
    if (share >= 1) return arc.end;
    if (arc.kind != ArcKind::Hyperbola) return (1 - share) * arc.begin + share * arc.end;
    return Conic{arc.focus, arc.weight}.opposite(arc.begin, arc.end, share);
}

}  // namespace agvd
