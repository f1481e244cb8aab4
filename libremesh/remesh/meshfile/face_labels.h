//! \file
//! Labels of faces by their names, such as materials. Private to the readers.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include "remesh/meshfile/mesh_attributes.h"

namespace remesh {

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

}  // namespace remesh
