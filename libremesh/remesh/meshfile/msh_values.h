//! \file
//! Values of nodes and elements in Gmsh's .msh files: sections NodeData and ElementData. Private to
//! their reader.
#pragma once

#include "remesh/meshfile/msh_elements.h"
#include "remesh/meshfile/msh_scanner.h"
#include "remesh/meshfile/vtk_data.h"

namespace remesh {

//! The arrays of nodes or of faces.
class MshValues {
public:
    explicit MshValues(ElementKind kind) : kind_(kind) {}

    //! Reads the content of a section. What has no value for each element will be declined.
    //! \param elements  those of the mesh, at least one; others in the section do not count.
    //! \throw IoError  damaged.  \throw Cancelled
    void read(MshScanner& scan, const MshTags& elements, Ticker& ticker);

    //! Adds what was read, as VTK's arrays are.
    //! \throw IoError  other elements followed the values.
    void add_to(MeshAttributes& attributes, std::size_t num_elements, const SourceFile& file) const;

private:
    ElementKind kind_;
    std::vector<VtkArray> arrays_;
    std::vector<DeclinedAttribute> declined_;
};

}  // namespace remesh
