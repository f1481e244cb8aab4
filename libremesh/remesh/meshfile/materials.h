//! \file
//! Colours, labels of faces by their names, and materials in the terms of glTF. Private to the
//! readers and writers.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "remesh/meshfile/mesh_file.h"

namespace remesh {

//! Collects the colours of the vertices, or of the faces, while a file is read.
class TextColors {
public:
    //! \param index    the element's; those before may have had no colour.
    //! \param numbers  what stands behind the element: none, or three or four if it has a colour.
    void take(std::size_t index, std::span<const double> numbers);
    //! Some word is not a number.
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

//! The colour of an element as text formats write it, with alpha 1 if there is none.
//! \param colors  see colors_of; not empty.
[[nodiscard]] std::array<float, 4> intensities(const std::vector<const Attribute*>& colors,
                                               std::size_t element);

//! The name without what text formats cannot hold: they have it on one line, and a backslash would
//! join that with the next one.
[[nodiscard]] std::string one_line(std::string name);

//! The name on one line, or with a number behind it if it is taken; takes it.
[[nodiscard]] std::string unique_name(const std::string& name, std::set<std::string>& taken);

//! Labels of faces, such as materials; they are numbered in the order of their first use.
class FaceLabels {
public:
    std::size_t number_of(const std::string& name) {
        const auto [entry, is_new] = numbers_.try_emplace(name, names_.size());
        if (is_new) names_.push_back(name);
        return entry->second;
    }
    //! A label without a name, that no name has.
    void begin_unnamed() { names_.emplace_back(); }
    //! Gives the label to further faces, until so many have one.
    void extend(std::size_t label, std::size_t num_faces) {
        values_.resize(num_faces, static_cast<double>(label));
    }
    //! Gives the label to the next faces.
    void add(std::size_t label, std::size_t num_faces) {
        extend(label, values_.size() + num_faces);
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

//! What a text holds; discarded if it is no JSON. As GltfDocument parses: a parser for other
//! iterators, or for JSON of another type, takes 10 kB.
[[nodiscard]] inline nlohmann::json parsed(const std::string& text) {
    return nlohmann::json::parse(text.data(), text.data() + text.size(), nullptr, false);
}

//! The text; bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string as_utf8(const std::string& name);

//! \param colors  sRGB by name, as #RRGGBB or #RRGGBBAA; others are left out.
[[nodiscard]] Materials materials_of_colors(const std::map<std::string, std::string>& colors);

//! Their base colours by name, as #RRGGBBAA.
[[nodiscard]] std::map<std::string, std::string> colors_of(const Materials& materials);

}  // namespace remesh
