#include "remesh/io/vtk_output.h"

#include <algorithm>

#include "remesh/io/append_number.h"
#include "remesh/io/text_colors.h"

namespace remesh {

std::vector<VtkOutputArray> arrays_of(const std::vector<Attribute>& attributes) {
    std::vector<VtkOutputArray> arrays;
    const std::vector<const Attribute*> colors = colors_of(attributes);
    if (!colors.empty()) {
        arrays.push_back({colors.size() == 4 ? "RGBA" : "RGB", NumberType::UInt8, colors});
    }
    for (const Attribute& attribute : attributes) {
        if (std::find(colors.begin(), colors.end(), &attribute) != colors.end()) continue;
        arrays.push_back({attribute.name,
                          attribute.is_intensity ? NumberType::Float32 : attribute.type,
                          {&attribute}});
    }
    return arrays;
}

void append_values(const VtkOutputArray& array, std::size_t num_elements, std::endian order,
                   agvd::Ticker& ticker, std::string& bytes) {
    const bool is_color = array.parts.size() > 1;
    for (std::size_t i = 0; i < num_elements; ++i) {
        ticker.tick();
        for (const Attribute* part : array.parts) {
            const double value = is_color ? 255 * intensity(*part, i) : part->values[i];
            append_number(bytes, array.type, value, order);
        }
    }
}

}  // namespace remesh
