//! \file
//! Texts of the libraries and of the program in the words of another interface.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cli {

//! A word of the program or of the libraries, and what to write for it.
struct Term {
    std::string_view given, replacement;
};

//! How the words of an option's name are joined.
enum class NameStyle { Snake, Camel };

//! Replaces options of the program ("use more --samples", "leave out --strict") and fields of the
//! libraries' options ("num_samples is 0") by the names that callers write.
//! \param terms  what differs by more than the style; longer ones first.
[[nodiscard]] std::string in_terms(std::string text, std::span<const Term> terms, NameStyle style);

}  // namespace cli
