//! \file
//! The page of a diagram: one HTML file that shows cells, bisectors, sites and lines of equal
//! distance on their mesh.
#pragma once

#include <string>
#include <vector>

#include "agvd/diagram/diagram.h"
#include "page/page_mesh.h"

namespace page {

//! What the page tells.
struct DiagramPage {
    std::string version = {};             //!< Of the program.
    std::string command = {};             //!< Makes the same page again; see to_shell.
    std::string engine = {};              //!< Of the distances.
    std::string name = {};                //!< Of the file of the mesh.
    agvd::MeshView mesh = {};             //!< On which the diagram is drawn.
    std::vector<agvd::Vec3> sites = {};   //!< Where points among them are.
    Polylines site_lines = {};            //!< Lines among them, and the rims of regions.
    Polylines bisectors = {};             //!< Between cells.
    Polylines isolines = {};              //!< Of equal distance ...
    double isoline_step = 0;              //!< ... at multiples of this one; 0: there are none.
    double certified_error = 0;           //!< Of the distances.
    std::vector<std::string> warnings{};  //!< All texts that the caller warned with.
    int num_threads = 0;                  //!< >= 0; 0: all cores.
};

//! The whole file. The same bytes for the same page, whatever the number of threads.
//! \param diagram  on page.mesh.
//! \pre require_viewer() does not throw.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(n); a mesh of more than most_faces (page/thin_mesh.h) is remeshed.
[[nodiscard]] std::string format_page(const DiagramPage& page, const agvd::Diagram& diagram,
                                      const agvd::Progress& progress = {});

}  // namespace page
