//! \file
//! Attributes as VTK's files hold them, in both formats. Private to the writers of VTK.
#pragma once

#include <bit>
#include <string>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/meshfile/mesh_attributes.h"

namespace remesh {

//! Colours make one array of bytes, "wind_0", "wind_1" and so on one array "wind", every other
//! attribute an array of its own.
struct VtkOutputArray {
    std::string name;
    NumberType type;
    std::vector<const Attribute*> parts;  //!< One for each component.
    bool is_color = false;
};

//! The arrays of some attributes, which outlive them.
[[nodiscard]] std::vector<VtkOutputArray> arrays_of(const std::vector<Attribute>& attributes);

//! Appends the numbers of all elements.
void append_values(const VtkOutputArray& array, std::size_t num_elements, std::endian order,
                   Ticker& ticker, std::string& bytes);

}  // namespace remesh
