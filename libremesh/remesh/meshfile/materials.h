//! \file
//! Colours in text formats: three or four numbers behind a vertex or face. Private to the readers
//! and writers of OBJ and OFF.
//! Labels of faces by their names, such as materials. Private to the readers.
//! Materials in the terms of glTF, and their colours in those of 3MF. Private to the readers and
//! writers.
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "remesh/meshfile/read_mesh.h"

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

//! The name without what text formats cannot hold: they have it on one line, and a backslash would
//! join that with the next one.
inline std::string one_line(std::string name) {
    std::erase_if(name, [](char c) { return (c >= 0 && c < ' ') || c == '\\'; });
    return name;
}

//! The name on one line, or with a number behind it if it is taken; takes it.
inline std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    const std::string begin = one_line(name);
    std::string result = begin;
    for (std::size_t i = 2; !taken.insert(result).second; ++i) {
        result = begin + '_' + std::to_string(i);
    }
    return result;
}

//! Numbers names in the order of their first use.
class FaceLabels {
public:
    //! \param name  see one_line.
    std::size_t number_of(std::string name) {
        name = one_line(std::move(name));
        const auto [entry, is_new] = numbers_.try_emplace(name, names_.size());
        if (is_new) names_.push_back(std::move(name));
        return entry->second;
    }
    //! Gives the label to the next faces.
    void add(std::size_t label, std::size_t num_faces) {
        values_.resize(values_.size() + num_faces, static_cast<double>(label));
    }
    [[nodiscard]] std::size_t num_labels() const { return names_.size(); }
    //! Whether a label has a name that is not empty.
    [[nodiscard]] bool has_names() const {
        return num_labels() > 1 || (num_labels() == 1 && !names_[0].empty());
    }

    [[nodiscard]] Attribute finish(const char* name) && {
        return {.name = name,
                .type = NumberType::Int32,
                .values = std::move(values_),
                .names = std::move(names_)};
    }

private:
    std::map<std::string, std::size_t> numbers_;
    std::vector<std::string> names_;
    std::vector<double> values_;
};

//! The JSON; bytes that are no UTF-8 are replaced, so that none is refused.
template <typename Json>
std::string text_of(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

//! Likewise.
[[nodiscard]] std::string as_utf8(const std::string& name);

//! \param colors  sRGB by name, as #RRGGBB or #RRGGBBAA; others are left out.
[[nodiscard]] Materials materials_of_colors(const std::map<std::string, std::string>& colors);

//! Their base colours by name, as #RRGGBBAA.
[[nodiscard]] std::map<std::string, std::string> colors_of(const Materials& materials);

}  // namespace remesh
