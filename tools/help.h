//! \file
//! How --help looks: options under headings, lines that fit into the terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace cli {

//! Headings of --help, which prints them in this order.
namespace heading {
inline constexpr const char* files = "Input and output";
inline constexpr const char* accuracy = "Accuracy";
inline constexpr const char* count = "How many";
inline constexpr const char* place = "Where";
inline constexpr const char* promises = "Bounds";
inline constexpr const char* curves = "Creases and boundary";
inline constexpr const char* attributes = "Attributes";
inline constexpr const char* regions = "Regions";
inline constexpr const char* relaxation = "Relaxation and placement";
inline constexpr const char* geodesics = "Geodesics";
inline constexpr const char* running = "Running";
}  // namespace heading

//! Options that are added to `app` from now on stand under this heading.
void start_group(CLI::App& app, const char* heading);

//! Gives --help of `app` and its subcommands the form above. Call it once all options are added.
void format_help(CLI::App& app);

//! Breaks a text between words.
//! \param indent  columns before each line but the first.
//! \param width   most columns of a line, `indent` included; longer words stand alone.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);

}  // namespace cli
