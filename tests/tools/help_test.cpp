#include "help.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "system/terminal.h"

namespace {

std::string help_of(CLI::App& app) {
    cli::format_help(app);
    return app.help();
}

TEST(Help, BreaksTextsBetweenWords) {
    EXPECT_EQ(cli::wrapped("", 4, 20), "");
    EXPECT_EQ(cli::wrapped("one two three", 4, 20), "one two three");
    EXPECT_EQ(cli::wrapped("one two three", 4, 17), "one two three");
    EXPECT_EQ(cli::wrapped("one two three", 4, 16), "one two\n    three");
    EXPECT_EQ(cli::wrapped("a word-that-is-too-long b", 2, 6), "a\n  word-that-is-too-long\n  b");
}

TEST(Help, KeepsLinesBelowEightyColumnsWithoutATerminal) {
    CLI::App app("About.", "program");
    std::string text;
    for (int i = 0; i < 60; ++i) text += "word ";
    app.add_option("--long", text, text + "end");
    std::istringstream lines(help_of(app));
    int num_lines = 0;
    for (std::string line; std::getline(lines, line); ++num_lines) {
        EXPECT_LE(line.size(), 80u) << line;
    }
    EXPECT_GE(num_lines, 8);
}

TEST(Help, PrintsHeadingsInOneOrderHoweverOptionsAreAdded) {
    CLI::App app("About.", "program");
    bool flag = false;
    cli::start_group(app, cli::heading::running);
    app.add_flag("--quick", flag, "Be quick");
    cli::start_group(app, cli::heading::files);
    app.add_flag("--file", flag, "Write a file");
    cli::start_group(app, "Others");
    app.add_flag("--other", flag, "Other");
    EXPECT_EQ(help_of(app),
              "About.\n"
              "Usage: program [OPTIONS]\n"
              "\n"
              "Others:\n"
              "  --other                     Other\n"
              "\n"
              "Input and output:\n"
              "  --file                      Write a file\n"
              "\n"
              "Running:\n"
              "  --quick                     Be quick\n"
              "  -h,--help                   Print this help message and exit\n"
              "\n");
}

TEST(Help, TellsDefaultsAndWhatExcludesEachOther) {
    CLI::App app("About.", "program");
    std::string value = "5";
    bool flag = false;
    auto* option =
        app.add_option("-v,--value", value, "A value")->type_name("V")->capture_default_str();
    auto* other = app.add_flag("--zero,!--no-zero", flag, "No value")->excludes(option);
    app.add_flag("--also{*}", value, "Another")->type_name("NAME")->needs(option);
    app.add_option("--a-name-that-fills-its-column", value, "Must be")
        ->required()
        ->excludes(option);
    EXPECT_TRUE(option->get_excludes().count(other) == 1);
    const std::string help = help_of(app);
    for (const char* entry :
         {"\n  -v,--value V                A value. Default: 5. Not with\n"
          "                              --a-name-that-fills-its-column, --zero\n",
          "\n  --zero,--no-zero            No value. Not with --value\n",
          "\n  --also[=NAME]               Another. Needs --value\n",
          "\n  --a-name-that-fills-its-column TEXT\n"
          "                              Must be. Required. Not with --value\n"}) {
        EXPECT_NE(help.find(entry), std::string::npos) << entry << help;
    }
}

TEST(Help, HasTheSameFormForSubcommands) {
    CLI::App app("About.", "program");
    CLI::App* const command = app.add_subcommand("command", "Do it");
    EXPECT_NE(help_of(app).find("\nSubcommands:\n  command                     Do it\n"),
              std::string::npos);
    EXPECT_NE(command->help().find("\nRunning:\n  -h,--help "), std::string::npos);
}

TEST(Help, FilesAreNoTerminals) { EXPECT_EQ(cli::terminal_width(-1), 0u); }

}  // namespace
