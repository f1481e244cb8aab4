//! \file
//! Exact distances by codes of others, such as those that the paper compares with.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "agvd/mesh/surface.h"

namespace bench {

struct OtherCode {
    std::string name;
    //! #V distances from the nearest site, on one thread; makes a mesh of its own. Sites are taken
    //! to lie at their nearest corners by MMP and VTP, which need a surface in one piece.
    std::vector<double> (*vertex_distances)(const agvd::Surface& surface,
                                            std::span<const agvd::SurfacePoint> sites);
    agvd::Index max_faces = agvd::no_index;  //!< More take too much memory.
};

//! Those that the build has: CGAL's ([xin2009]); where AGVD_PAPER_CODES is set also MMP in the
//! implementation of D. Kirsanov, the engine of the paper's Refs. 13 and 24, and VTP in that of its
//! authors, the engine of Ref. 14.
[[nodiscard]] std::vector<OtherCode> other_codes();

//! The arrays that both of these take: 3 #V, 3 #F.
struct FlatMesh {
    std::vector<double> coordinates;
    std::vector<unsigned> corners;
};

//! Those of MMP and VTP. \param sources  vertices, one at least.
[[nodiscard]] std::vector<double> mmp_distances(FlatMesh& mesh,
                                                std::span<const agvd::Index> sources);
[[nodiscard]] std::vector<double> vtp_distances(FlatMesh& mesh,
                                                std::span<const agvd::Index> sources);

}  // namespace bench
