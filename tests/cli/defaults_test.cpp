// What the help calls a default is one: typed, it changes nothing.
#include <map>
#include <sstream>

#include "cli/remesh_program.h"
#include "support/shapes.h"

using RemeshDefaults = Remesh;

namespace {

// By long name of an option: what follows "Default:" in its help.
std::map<std::string, std::string> defaults_in(const std::string& help) {
    std::map<std::string, std::string> defaults;
    std::istringstream text(help);
    std::string line, option, before;
    for (std::string word; std::getline(text, line);) {
        const std::size_t name = line.find("--");
        if (name != std::string::npos && name < 8) {
            std::istringstream start(line.substr(name));
            start >> option;
            option = option.substr(0, option.find_first_of(",["));
        }
        std::istringstream words(line);
        while (words >> word) {
            const bool is_value = before == "Default:";
            before = word;
            if (!is_value) continue;
            while (word.ends_with('.')) word.pop_back();
            defaults[option] = word;
        }
    }
    return defaults;
}

}  // namespace

TEST_F(RemeshDefaults, TypedTheyChangeNoByte) {
    const std::map<std::string, std::string> defaults = defaults_in(remesh({"--help"}).out);
    EXPECT_EQ(defaults.at("--max-error"), "0.0001");
    EXPECT_EQ(defaults.at("--relax"), "60");
    EXPECT_EQ(defaults.at("--samples"), "2000");
    const std::string in = put("in.ply", shapes::torus(60, 30));
    const auto mesh_with = [&](std::vector<std::string> options) {
        options.insert(options.end(), {in, at("out.ply")});
        const auto outcome = remesh(options);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return bytes("out.ply");
    };
    const std::string by_default = mesh_with({});
    EXPECT_GT(by_default.size(), 10'000u);
    // Options that are refused without another one.
    const std::map<std::string, std::vector<std::string>> needed{
        {"--gradation", {"--adaptive"}},
        {"--lambda", {"--engine", "steiner"}},
        {"--steiner-points", {"--engine", "steiner"}}};
    std::size_t num_tried = 0;
    for (const auto& [option, value] : defaults) {
        const auto others = needed.find(option);
        std::vector<std::string> options;
        if (others != needed.end()) options = others->second;
        const std::string expected = options.empty() ? by_default : mesh_with(options);
        options.insert(options.end(), {option, value});
        EXPECT_EQ(mesh_with(options), expected) << option << ' ' << value;
        ++num_tried;
    }
    EXPECT_GE(num_tried, 20u);
}
