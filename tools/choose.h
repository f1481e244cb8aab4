//! \file
//! Choices of an option by their names, of the Python module and the npm package.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "agvd/core/error.h"

namespace cli {

//! \throw agvd::InvalidOption  no choice has this name; the text lists them.
template <typename Choice>
[[nodiscard]] Choice choose(const char* option, const std::string& name,
                            const std::vector<Choice>& choices, const char* (*name_of)(Choice)) {
    std::string names;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        if (name == name_of(choices[i])) return choices[i];
        names += (i == 0 ? "" : i + 1 < choices.size() ? ", " : " or ");
        names += name_of(choices[i]);
    }
    throw agvd::InvalidOption(std::string(option) + " is '" + name + "'; use " + names);
}

}  // namespace cli
