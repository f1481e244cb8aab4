// Bisectors as arcs of conics, whose foci are images of the sites, or of the pseudo-sources that
// paths from these bend at.
#include "agvd/diagram/conic.h"
#include "agvd/diagram/diagram.h"

namespace agvd {

const char* arc_kind_name(ArcKind kind) {
    return kind == ArcKind::Line ? "line" : kind == ArcKind::Hyperbola ? "hyperbola" : "chord";
}

Vec2 point_on_arc(const BisectorArc& arc, double share) {
    if (share <= 0) return arc.begin;
    if (share >= 1) return arc.end;
    if (arc.kind == ArcKind::Chord) return (1 - share) * arc.begin + share * arc.end;
    return Conic{arc.focus, arc.weight}.between(arc.begin, arc.end, share);
}

std::array<Vec3, 2> foci_in_space(const Surface& surface, const BisectorArc& arc) {
    const Index h = 3 * arc.face.value();
    const Vec2& apex = surface.apex[h];
    const auto in_space = [&](const Vec2& p) {
        const double at_apex = p.y() / apex.y();
        const double at_head = (p.x() - at_apex * apex.x()) / surface.length_of(h);
        return position(surface.mesh.view(), {arc.face, {1 - at_apex - at_head, at_head, at_apex}});
    };
    return {in_space(arc.focus[0]), in_space(arc.focus[1])};
}

}  // namespace agvd
