//! \file
//! Texts of the libraries and of the program in the words of Python's callers.
#pragma once

#include <string>

namespace python {

//! Replaces options of the program ("use more --samples", "leave out --strict") and fields of the
//! libraries' options ("num_samples is 0") by the keywords that callers write ("use a larger n",
//! "leave out strict", "n is 0").
[[nodiscard]] std::string in_terms_of_python(std::string text);

}  // namespace python
