
#include "remesh/meshfile/materials.h"

#include <algorithm>

#include "agvd/core/portable_math.h"
#include "remesh/meshfile/text.h"

namespace remesh {
namespace {

using nlohmann::json;

const json::json_pointer base_color("/pbrMetallicRoughness/baseColorFactor");

// sRGB (IEC 61966-2-1), from 0 to 1.
double to_linear(double s) {
    return s <= 0.04045 ? s / 12.92 : portable::pow((s + 0.055) / 1.055, 2.4);
}
double from_linear(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * portable::pow(x, 1 / 2.4) - 0.055;
}

// Red, green and blue are linear there; empty: it is no colour.
json factor_of(const std::string& color) {
    if (!color.starts_with('#') || (color.size() != 7 && color.size() != 9)) return {};
    json factor = {1, 1, 1, 1};
    for (std::size_t k = 0; 2 * k + 1 < color.size(); ++k) {
        int byte = 0;
        const char* const digits = color.data() + 1 + 2 * k;
        if (std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2) return {};
        factor[k] = k < 3 ? to_linear(byte / 255.) : byte / 255.;
    }
    return factor;
}

}  // namespace

void TextColors::take(std::size_t index, std::span<const double> numbers) {
    if (numbers.empty()) return;
    const std::size_t num_parts = parts_[0].empty() ? numbers.size() : parts_[3].empty() ? 3 : 4;
    is_broken_ = is_broken_ || parts_[0].size() != index || numbers.size() != num_parts ||
                 num_parts < 3 || num_parts > 4;
    if (is_broken_) return;
    for (std::size_t k = 0; k < num_parts; ++k) parts_[k].push_back(numbers[k]);
}

void TextColors::finish(std::size_t num_elements, ElementKind kind, MeshAttributes& attributes) && {
    if (parts_[0].empty() && !is_broken_) return;
    bool is_intensity = true, is_byte = true;
    for (const std::vector<double>& part : parts_) {
        for (const double value : part) {
            is_intensity = is_intensity && value >= 0 && value <= 1;
            is_byte = is_byte && is_value_of(NumberType::UInt8, value);
        }
    }
    const bool is_vertex = kind == ElementKind::Vertex;
    if (is_broken_ || parts_[0].size() != num_elements || (!is_intensity && !is_byte)) {
        attributes.declined.push_back(
            {is_vertex ? "vertex colours" : "face colours",
             "not all elements have three or four numbers, from 0 to 1 or whole ones to 255"});
        return;
    }
    auto& target = is_vertex ? attributes.of_vertices : attributes.of_faces;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (parts_[k].empty()) continue;
        target.push_back({.name = color_names[k],
                          .type = is_intensity ? NumberType::Float64 : NumberType::UInt8,
                          .values = std::move(parts_[k]),
                          .is_intensity = is_intensity});
    }
}

std::vector<const Attribute*> colors_of(const std::vector<Attribute>& attributes) {
    std::vector<const Attribute*> colors;
    for (const char* name : color_names) {
        const Attribute* const part = find_attribute(attributes, name);
        if (part != nullptr) {
            colors.push_back(part);
        } else if (colors.size() < 3) {
            return {};
        }
    }
    return colors;
}

double intensity(const Attribute& part, std::size_t element) {
    const double value = part.values[element];
    return part.type == NumberType::UInt8    ? value / UINT8_MAX
           : part.type == NumberType::UInt16 ? value / UINT16_MAX
                                             : value;
}

std::array<float, 4> intensities(const std::vector<const Attribute*>& colors, std::size_t element) {
    std::array<float, 4> color{0, 0, 0, 1};
    for (std::size_t k = 0; k < colors.size(); ++k) {
        color[k] = static_cast<float>(intensity(*colors[k], element));
    }
    return color;
}

std::string one_line(std::string name) {
    std::erase_if(name, [](char c) { return (c >= 0 && c < ' ') || c == '\\'; });
    return name;
}

std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    const std::string begin = one_line(name);
    std::string result = begin;
    for (std::size_t i = 2; !taken.insert(result).second; ++i) result = joined(begin, "_", i);
    return result;
}

std::string as_utf8(const std::string& name) {
    return parsed(text_of(json(name))).get<std::string>();
}

Materials materials_of_colors(const std::map<std::string, std::string>& colors) {
    json list = json::array();
    for (const auto& [name, color] : colors) {
        const json factor = factor_of(color);
        if (factor.empty()) continue;
        json material = {{"name", name}};
        material[base_color] = factor;
        material["pbrMetallicRoughness"]["metallicFactor"] = 0;
        if (factor[3] != 1) material["alphaMode"] = "BLEND";
        list.push_back(std::move(material));
    }
    if (list.empty()) return {};
    return {.json = text_of(json{{"materials", list}})};
}

std::map<std::string, std::string> colors_of(const Materials& materials) {
    std::map<std::string, std::string> colors;
    const json root = parsed(materials.json);
    if (!root.is_object()) return colors;
    for (const json& material : root.value("materials", json::array())) {
        if (!material.is_object() || !material.contains("name") || !material["name"].is_string() ||
            !material.contains(base_color)) {
            continue;
        }
        std::string color = "#";
        for (const json& part : material[base_color]) {
            if (!part.is_number()) break;
            const double x = std::clamp(part.get<double>(), 0., 1.);
            const auto byte = std::lround(255 * (color.size() < 7 ? from_linear(x) : x));
            constexpr std::string_view digits = "0123456789ABCDEF";
            color += digits[static_cast<std::size_t>(byte / 16)];
            color += digits[static_cast<std::size_t>(byte % 16)];
        }
        if (color.size() == 9) colors[material["name"]] = color;
    }
    return colors;
}

}  // namespace remesh
