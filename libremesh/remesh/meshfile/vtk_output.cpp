#include "remesh/meshfile/vtk_output.h"

#include <algorithm>
#include <utility>

#include "remesh/meshfile/append_number.h"
#include "remesh/meshfile/text_colors.h"
#include "remesh/meshfile/vtk_data.h"

namespace remesh {

namespace {

NumberType stored_type(const Attribute& attribute) {
    return attribute.is_intensity ? NumberType::Float32 : attribute.type;
}

// Whether the attribute goes on where the array ends.
bool is_next_part(const Attribute& attribute, const VtkOutputArray& array) {
    return attribute.name == array.name + '_' + std::to_string(array.parts.size()) &&
           stored_type(attribute) == array.type && array.parts.size() < most_vtk_components;
}

}  // namespace

std::vector<VtkOutputArray> arrays_of(const std::vector<Attribute>& attributes) {
    std::vector<VtkOutputArray> arrays;
    const std::vector<const Attribute*> colors = colors_of(attributes);
    if (!colors.empty()) {
        arrays.push_back({colors.size() == 4 ? "RGBA" : "RGB", NumberType::UInt8, colors, true});
    }
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const Attribute& first = attributes[i];
        if (std::find(colors.begin(), colors.end(), &first) != colors.end()) continue;
        VtkOutputArray whole{first.name, stored_type(first), {&first}};
        if (first.name.ends_with("_0")) {
            whole.name.resize(first.name.size() - 2);
            while (i + 1 < attributes.size() && is_next_part(attributes[i + 1], whole))
                whole.parts.push_back(&attributes[++i]);
            if (whole.parts.size() == 1) whole.name = first.name;
        }
        arrays.push_back(std::move(whole));
    }
    return arrays;
}

void append_values(const VtkOutputArray& array, std::size_t num_elements, std::endian order,
                   Ticker& ticker, std::string& bytes) {
    for (std::size_t i = 0; i < num_elements; ++i) {
        ticker.tick();
        for (const Attribute* part : array.parts) {
            const double value = array.is_color ? 255 * intensity(*part, i) : part->values[i];
            append_number(bytes, array.type, value, order);
        }
    }
}

}  // namespace remesh
