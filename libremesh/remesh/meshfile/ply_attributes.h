//! \file
//! Properties of a PLY file that are neither coordinates nor corners. Private to the reader.
#pragma once

#include <algorithm>

#include "remesh/meshfile/ply_values.h"

namespace remesh {

//! Takes the values of an element's other properties, one element after the other.
class PlyAttributes {
public:
    //! Decides which properties are carried over. Those that are not are listed in `attributes`,
    //! with the reason, and so is the type of normals.
    //! \param used  properties that the reader needs itself.
    //! \param file  without with_attributes nothing is carried over.
    PlyAttributes(const PlyElement& element, ElementKind kind,
                  const std::vector<const PlyProperty*>& used, const SourceFile& file,
                  MeshAttributes& attributes);

    //! Reads or skips a value.
    //! \param property  index in the element; none of those that are used.
    template <typename Values>
    void take(Values& values, std::size_t property) {
        const PlyProperty& type = element_.properties[property];
        if (column_[property] == no_column) {
            skip_property(values, type, file_);
            return;
        }
        const std::optional<double> value = values.attribute(type.type);
        Column& column = columns_[column_[property]];
        column.is_broken = column.is_broken || !value;
        column.attribute.values.push_back(value.value_or(0));
    }

    //! Moves the attributes to `attributes`; those that hold other words than numbers are declined.
    void finish(MeshAttributes& attributes) &&;

private:
    static constexpr std::size_t no_column = ~std::size_t{0};
    struct Column {
        Attribute attribute;
        bool is_broken = false;
    };

    const PlyElement& element_;
    ElementKind kind_;
    const SourceFile& file_;
    std::vector<std::size_t> column_;  // By property: index into columns_.
    std::vector<Column> columns_;
};

}  // namespace remesh
