//! \file
//! Colours in text formats: three or four numbers behind a vertex or face. Private to the readers
//! and writers of OBJ and OFF.
#pragma once

#include <array>
#include <span>

#include "remesh/meshfile/mesh_attributes.h"

namespace remesh {

//! Collects the colours of the vertices, or of the faces, while a file is read.
class TextColors {
public:
    //! \param index    the element's; those before may have had no colour.
    //! \param numbers  what stands behind the element: none, or three or four if it has a colour.
    void take(std::size_t index, std::span<const double> numbers);
    //! Some word is no number.
    void spoil() { is_broken_ = true; }

    //! Adds red, green, blue, and alpha if there is one. They are declined unless all elements have
    //! such numbers, from 0 to 1 or whole ones up to 255.
    void finish(std::size_t num_elements, ElementKind kind, MeshAttributes& attributes) &&;

private:
    std::array<std::vector<double>, 4> parts_;
    bool is_broken_ = false;
};

//! Red, green, blue and perhaps alpha of elements; empty without the first three.
[[nodiscard]] std::vector<const Attribute*> colors_of(const std::vector<Attribute>& attributes);

//! A part of a colour from 0 to 1.
[[nodiscard]] double intensity(const Attribute& part, std::size_t element);

}  // namespace remesh
