//! \file
//! The report page: one HTML file that shows an original and its remesh, and all figures.
#pragma once

#include <string>

#include "page/page_mesh.h"
#include "report/report.h"

namespace page {

//! What the page tells.
struct Page {
    std::string version = {};  //!< Of the program.
    std::string command = {};  //!< Makes the same page again; see to_shell.
    //! JSON: the settings, repairs and warnings of the run. Empty: there was no run.
    std::string report = {};
    std::string original_name = {};      //!< Of the file.
    std::string result_name = {};        //!< Of the file.
    agvd::MeshView original = {};        //!< As it was read.
    agvd::MeshView result = {};          //!< As it was written.
    remesh::Evaluation evaluation = {};  //!< Of the two.
    std::vector<double> targets = {};    //!< Edge length at each vertex of the result, or none.
    FaceLabels original_labels = {};     //!< Of one property of both meshes, or none.
    FaceLabels result_labels = {};       //!< Of the same property, or none.
    //! Red, green and blue of vertices, 0 to 255, or none.
    std::vector<VertexValues> original_colors = {};
    std::vector<VertexValues> result_colors = {};  //!< See original_colors.
    Polylines cells = {};                          //!< On the original.
    remesh::RemeshOptions options = {};            //!< Of creases and threads.
};

//! The whole file. The same bytes for the same page, whatever the number of threads.
//! \pre require_viewer() does not throw.
//! \throw agvd::Cancelled  the progress callback returned false.
//! Cost: O(n log n); meshes of more than most_faces (page/thin_mesh.h) are remeshed.
[[nodiscard]] std::string format_page(const Page& page, const agvd::Progress& progress = {});

}  // namespace page
