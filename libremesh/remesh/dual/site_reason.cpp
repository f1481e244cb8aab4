#include "remesh/dual/site_reason.h"

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

const char* place_text(SiteReason reason) {
    switch (reason) {
        case SiteReason::BoundaryCorner:
            return "at corners of the boundary";
        case SiteReason::WholeComponent:
            return "in cells that cover a whole component";
        case SiteReason::NoDisc:
            return "in cells that are not discs";
        case SiteReason::ClosedCurve:
            return "between cells that meet along a closed curve";
        case SiteReason::SeveralArcs:
            return "between cells that meet in more than one arc";
        case SiteReason::BoundaryAtBothEnds:
            return "between cells whose common arc has both ends on the boundary";
        case SiteReason::BoundaryTwice:
            return "in cells that meet the boundary more than once";
        case SiteReason::SameThirdCell:
            return "between cells that meet twice, each time with the same third cell";
        case SiteReason::NoSite:
            return "on components without a site";
        case SiteReason::SelfIntersection:
            return "where the mesh self-intersected";
    }
    return "for an unknown reason";
}

}  // namespace remesh
