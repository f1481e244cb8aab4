#include "remesh/meshfile/mesh_attributes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace remesh {
namespace {

template <typename T>
bool is_whole_in(double value) {
    return value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max() &&
           value == std::floor(value);
}

}  // namespace

const Attribute* find_attribute(const std::vector<Attribute>& attributes, std::string_view name) {
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const Attribute& known) { return known.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

std::string names_of(const std::vector<Attribute>& attributes) {
    std::string text;
    for (const Attribute& attribute : attributes) {
        text += (text.empty() ? "" : ", ") + attribute.name;
    }
    return text;
}

bool is_color(std::string_view name) {
    return name == "red" || name == "green" || name == "blue" || name == "alpha";
}

bool is_label(const Attribute& attribute) {
    return is_integer(attribute.type) && !is_color(attribute.name);
}

bool is_value_of(NumberType type, double value) {
    switch (type) {
        case NumberType::Int8:
            return is_whole_in<std::int8_t>(value);
        case NumberType::UInt8:
            return is_whole_in<std::uint8_t>(value);
        case NumberType::Int16:
            return is_whole_in<std::int16_t>(value);
        case NumberType::UInt16:
            return is_whole_in<std::uint16_t>(value);
        case NumberType::Int32:
            return is_whole_in<std::int32_t>(value);
        case NumberType::UInt32:
            return is_whole_in<std::uint32_t>(value);
        case NumberType::Float32:
        case NumberType::Float64:
            break;
    }
    return true;
}

void spread_to_triangles(const std::vector<Index>& face_polygon, std::vector<Attribute>& of_faces) {
    for (Attribute& attribute : of_faces) {
        std::vector<double> values;
        values.reserve(face_polygon.size());
        for (const Index polygon : face_polygon) values.push_back(attribute.values[polygon]);
        attribute.values = std::move(values);
    }
}

}  // namespace remesh
