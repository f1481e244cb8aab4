// An entry of --help has the names of an option in columns 3 to 28 and its text from column 31 on,
// or on the next line where the names are longer. tools/manual reads this form: two blanks or a
// line end come only after the names.
#include "help.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <vector>

#include "system/terminal.h"

namespace cli {
namespace {

constexpr std::array headings{heading::files,     heading::accuracy,   heading::count,
                              heading::place,     heading::promises,   heading::curves,
                              heading::regions,   heading::attributes, heading::relaxation,
                              heading::geodesics, heading::running};

constexpr std::size_t text_column = 30;
// If standard output is no terminal.
constexpr std::size_t usual_width = 80;
// Narrower texts are hard to read even on a narrow terminal, and so are wider ones on a wide one.
constexpr std::size_t least_width = 50, most_width = 100;

std::size_t help_width() {
    const std::size_t width = terminal_width(STDOUT_FILENO);
    return width == 0 ? usual_width : std::clamp(width, least_width, most_width);
}

std::string entry(const std::string& names, const std::string& text) {
    std::string line = "  " + names;
    line += line.size() + 2 <= text_column ? std::string(text_column - line.size(), ' ')
                                           : '\n' + std::string(text_column, ' ');
    return line + wrapped(text, text_column, help_width()) + '\n';
}

// CLI11 keeps them in the order of their addresses.
std::string names_of_options(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    names.reserve(options.size());
    for (const CLI::Option* option : options) names.push_back(option->get_name());
    std::sort(names.begin(), names.end());
    return CLI::detail::join(names, ", ");
}

// The names as CLI11 gives them, without the values of flags such as {false}, and the value.
std::string names_and_value(const CLI::Option& option) {
    std::string names;
    bool is_value = false;
    for (const char c : option.get_name(false, true)) {
        if (c == '{') is_value = true;
        if (!is_value) names += c;
        if (c == '}') is_value = false;
    }
    const std::string type = option.get_type_name();
    const bool is_flag = option.get_expected_min() == 0;  // Its value may be left out.
    if (is_flag) return type.empty() ? names : names + "[=" + type + ']';
    return option.get_type_size() == 0 || type.empty() ? names : names + ' ' + type;
}

class HelpFormatter : public CLI::Formatter {
public:
    [[nodiscard]] std::string make_option(const CLI::Option* option,
                                          bool is_positional) const override {
        std::string text = option->get_description();
        const auto add = [&text](const std::string& what, const std::string& value) {
            if (!value.empty()) text += ". " + what + ' ' + value;
        };
        if (option->get_type_size() != 0) add("Default:", option->get_default_str());
        if (!is_positional && option->get_required()) text += ". Required";
        add("Needs", names_of_options(option->get_needs()));
        add("Not with", names_of_options(option->get_excludes()));
        return entry(is_positional ? option->get_name(true) : names_and_value(*option), text);
    }

    [[nodiscard]] std::string make_subcommand(const CLI::App* command) const override {
        return entry(command->get_name(), command->get_description());
    }

    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override {
        std::string help = make_description(app) + make_usage(app, std::move(name));
        help += make_positionals(app);
        for (const std::string& heading : headings_of(*app)) {
            const std::vector<const CLI::Option*> options = options_of(*app, heading);
            if (!options.empty()) help += make_group(heading, false, options);
        }
        return help + make_subcommands(app, mode) + '\n' + make_footer(app);
    }

private:
    // Headings of its own first.
    static std::vector<std::string> headings_of(const CLI::App& app) {
        std::vector<std::string> all = app.get_groups();
        std::erase_if(all, [](const std::string& heading) {
            return std::find(headings.begin(), headings.end(), heading) != headings.end();
        });
        all.insert(all.end(), headings.begin(), headings.end());
        return all;
    }

    // As they were added, --help last.
    static std::vector<const CLI::Option*> options_of(const CLI::App& app,
                                                      const std::string& heading) {
        std::vector<const CLI::Option*> options = app.get_options([&](const CLI::Option* option) {
            return option->get_group() == heading && option->nonpositional();
        });
        std::stable_partition(options.begin(), options.end(), [&](const CLI::Option* option) {
            return option != app.get_help_ptr();
        });
        return options;
    }
};

}  // namespace

void start_group(CLI::App& app, const char* heading) { app.option_defaults()->group(heading); }

void format_help(CLI::App& app) {
    const auto formatter = std::make_shared<HelpFormatter>();
    std::vector<CLI::App*> apps = app.get_subcommands({});
    apps.push_back(&app);
    for (CLI::App* one : apps) {
        one->formatter(formatter);
        one->get_help_ptr()->group(heading::running);
    }
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
    std::string result;
    std::size_t column = indent;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const bool is_first = column == indent;
        if (!is_first && column + 1 + end > width) {
            result += '\n' + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            result += ' ';
            ++column;
        }
        result += text.substr(0, end);
        column += end;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

}  // namespace cli
