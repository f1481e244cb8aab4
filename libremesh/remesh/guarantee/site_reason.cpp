#include "remesh/guarantee/site_reason.h"

namespace remesh {

const char* to_text(SiteReason reason) {
    switch (reason) {
        case SiteReason::BoundaryCorner:
            return "a corner of the boundary";
        case SiteReason::WholeComponent:
            return "covers a whole component";
        case SiteReason::NoDisc:
            return "is not a disc";
        case SiteReason::ClosedCurve:
            return "meets along a closed curve";
        case SiteReason::SeveralArcs:
            return "meets in more than one arc";
        case SiteReason::BoundaryAtBothEnds:
            return "meets the boundary at both ends of its arc with";
        case SiteReason::BoundaryTwice:
            return "meets the boundary more than once";
        case SiteReason::SameThirdCell:
            return "meets twice, each time with the same third cell,";
        case SiteReason::NoSite:
            return "no site on a component";
        case SiteReason::SelfIntersection:
            return "self-intersects";
    }
    return "unknown";
}

}  // namespace remesh
