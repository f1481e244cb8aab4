#include "remesh/sites/minimum_samples.h"

#include <algorithm>
#include <cmath>

namespace remesh {

Index minimum_samples(int genus, int boundary_loops) {
    if (boundary_loops == 0) {
        if (genus == 2) return 10;  // The only orientable surface above the bound.
        return static_cast<Index>(std::ceil((7 + std::sqrt(1.0 + 48.0 * genus)) / 2));
    }
    // E <= V (V - 1) / 2 with all vertices on the boundary; each loop has three vertices of its
    // own.
    const double euler = 2.0 - 2.0 * genus - boundary_loops;
    const double bound = std::ceil((5 + std::sqrt(25 - 24 * euler)) / 2);
    return std::max(static_cast<Index>(bound), static_cast<Index>(3 * boundary_loops));
}

Index minimum_samples(const Topology& topology) {
    Index needed = 0;
    for (const ComponentTopology& c : topology.components) {
        needed += minimum_samples(c.genus, c.boundary_loops);
    }
    return needed;
}

}  // namespace remesh
