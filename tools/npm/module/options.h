//! \file
//! Options of a call, as JavaScript's callers name them.
#pragma once

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "agvd/core/error.h"
#include "agvd/mesh/mesh.h"
#include "choose.h"
#include "message.h"

namespace npm {

//! Reads options one by one; each read option is known. What JSON does not hold
//! comes as a text in parentheses, such as "(NaN)".
class Options {
public:
    //! \param given  an object; outlives this.
    explicit Options(const Json& given) : given_(given) {}

    //! Whether the option is given.
    [[nodiscard]] bool has(const char* name);
    //! A finite number.
    //! \throw agvd::InvalidOption  it is none, as likewise below.
    [[nodiscard]] std::optional<double> number(const char* name);
    //! A whole number in these bounds.
    [[nodiscard]] std::optional<double> whole(const char* name, double least, double most);
    //! true or false; not given: false.
    [[nodiscard]] bool flag(const char* name);
    [[nodiscard]] std::optional<bool> optional_flag(const char* name);
    [[nodiscard]] std::optional<std::string> text(const char* name);
    //! A length above 0 in mesh units, or a percentage of the diagonal such as "2%".
    [[nodiscard]] std::optional<double> length(const char* name, const agvd::MeshView& mesh);
    //! A number of 1 or more, or a percentage of `all` such as "10%".
    [[nodiscard]] std::optional<double> count(const char* name, std::size_t all);
    //! Sets `value` to the choice of that name, if it is given.
    template <typename Choice>
    void choose(const char* name, Choice& value, const std::vector<Choice>& choices,
                const char* (*name_of)(Choice)) {
        if (const auto chosen = text(name)) {
            value = cli::choose<Choice>(name, *chosen, choices, name_of);
        }
    }

    //! Declares an option that is an array: JavaScript has checked it.
    void know(const char* name) { known_.insert(name); }
    //! \throw agvd::InvalidOption  an option was given that was not read.
    void require_known() const;

    //! The value; nullptr: not given.
    [[nodiscard]] const Json* find(const char* name);

private:
    const Json& given_;
    std::set<std::string> known_;
};

}  // namespace npm
