//! \file
//! The keys of reports, and those that docs/report.md tells of.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

namespace report_keys {

//! Objects that docs/report.md describes once, and keys that depend on the run.
inline std::string name_of(const std::string& path, const std::string& key) {
    static const std::map<std::string, std::string> common = {
        {"output", "MESH"},
        {"input_topology", "MESH"},
        {"original", "MESH"},
        {"result", "MESH"},
        {"input_repair", "REPAIR"},
        {"original_repair", "REPAIR"},
        {"distance.original_to_result", "DISTANCE"},
        {"distance.result_to_original", "DISTANCE"},
        {"distance.two_sided", "DISTANCE"},
        {"bisector_error_a", "BISECTORS"},
        {"bisector_error_b", "BISECTORS"},
    };
    if (path == "stage_seconds") return path + ".*";
    if (path.empty() || key.starts_with("self_intersecting_")) {
        return path.empty() ? key : path + '.' + key;
    }
    const auto found = common.find(path);
    return (found == common.end() ? path : found->second) + '.' + key;
}

struct Keys {
    std::set<std::string> values;   //!< Such as "relaxation[].sites".
    std::set<std::string> objects;  //!< Keys of objects and of arrays of objects.
    std::set<std::string> nulls;    //!< Those of the values that are null or hold a null.
};

inline void add_keys(const nlohmann::json& object, const std::string& path, Keys& keys) {
    for (const auto& [key, value] : object.items()) {
        const std::string name = name_of(path, key);
        const bool is_array = value.is_array() && !value.empty() && value[0].is_object();
        if (value.is_object() || is_array) {
            keys.objects.insert(name);
            add_keys(is_array ? value[0] : value, name + (is_array ? "[]" : ""), keys);
        } else {
            keys.values.insert(name);
            const auto is_null = [](const nlohmann::json& one) { return one.is_null(); };
            const bool has_null =
                value.is_array() && std::any_of(value.begin(), value.end(), is_null);
            if (value.is_null() || has_null) keys.nulls.insert(name);
        }
    }
}

inline Keys keys_of(const std::string& report) {
    Keys keys;
    add_keys(nlohmann::json::parse(report), "", keys);
    return keys;
}

//! Those in the tables under "## TITLE" for each of the titles, in rows that hold `word`.
inline std::set<std::string> documented(const std::set<std::string>& titles,
                                        const std::string& word = "") {
    std::ifstream file(std::filesystem::path(AGVD_DOCS_DIR) / "report.md");
    std::set<std::string> keys;
    static const std::regex code("`([^`]+)`");
    bool is_wanted = false;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("## ")) is_wanted = titles.contains(line.substr(3));
        if (!is_wanted || !line.starts_with("| `") || line.find(word) == line.npos) continue;
        const std::string names = line.substr(2, line.find(" |", 2) - 2);
        for (auto i = std::sregex_iterator(names.begin(), names.end(), code);
             i != std::sregex_iterator(); ++i) {
            keys.insert((*i)[1]);
        }
    }
    return keys;
}

//! Expects that the tables list all values of the report, and nothing that it does not have.
inline void expect_documented(const std::string& report, const std::set<std::string>& titles) {
    const Keys keys = keys_of(report);
    const std::set<std::string> told = documented(titles);
    for (const std::string& key : keys.values) {
        EXPECT_TRUE(told.contains(key)) << "docs/report.md does not tell of " << key;
    }
    for (const std::string& key : told) {
        EXPECT_TRUE(keys.values.contains(key) || keys.objects.contains(key))
            << "docs/report.md tells of " << key << ", which no report has";
    }
}

//! Expects that no value is null but those of which the tables say so. A number that is not finite
//! is null in a report.
inline void expect_nulls_documented(const std::string& report,
                                    const std::set<std::string>& titles) {
    const std::set<std::string> told = documented(titles, "null");
    for (const std::string& key : keys_of(report).nulls) {
        EXPECT_TRUE(told.contains(key)) << key << " is null";
    }
}

}  // namespace report_keys
