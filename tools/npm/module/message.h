//! \file
//! What crosses the border between JavaScript and the module: a JSON text, and arrays of numbers
//! that it describes.
#pragma once

#include <any>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "agvd/core/types.h"

namespace npm {

//! That of the readers of glTF: another one, with the keys in order, takes 15 kB.
using Json = nlohmann::json;

//! A call as JavaScript wrote it. Its arrays stand in the memory of the module until the call
//! returns.
class Request {
public:
    //! \param text  an object: `call` names the function, `arrays` has for each name an address
    //!              `at` and a number of elements `count`; all else belongs to the function.
    explicit Request(std::string_view text)
        : json_(Json::parse(text.data(), text.data() + text.size())) {}

    [[nodiscard]] const Json& json() const { return json_; }
    [[nodiscard]] bool has_array(const char* name) const { return json_["arrays"].contains(name); }

    //! The array of that name, of numbers of this type; none: empty.
    template <typename Number>
    [[nodiscard]] std::span<const Number> array(const std::string& name) const {
        const Json& arrays = json_["arrays"];
        const auto found = arrays.find(name);
        if (found == arrays.end()) return {};
        const auto at = (*found)["at"].get<std::uintptr_t>();
        return {reinterpret_cast<const Number*>(at), (*found)["count"].get<std::size_t>()};
    }

private:
    Json json_;
};

//! What a call returns. It owns its arrays.
class Answer {
public:
    //! All that is no array.
    Json json = Json::object();
    //! A JSON text, which becomes the value of the key `report`. Empty: there is none.
    std::string report;

    //! Adds an array of numbers. \param values  numbers, or rows of numbers without gaps.
    template <typename Number, typename Row>
    void add(const std::string& name, std::vector<Row> values) {
        static_assert(sizeof(Row) % sizeof(Number) == 0);
        const std::size_t count = values.size() * (sizeof(Row) / sizeof(Number));
        add(name, name_of<Number>(), values.data(), count);
        owned_.emplace_back(std::move(values));
    }
    //! Adds bytes.
    void add_bytes(const std::string& name, std::string bytes);

    //! The text for JavaScript: `json` and the keys `report` and `arrays`, each with `type`, `at`
    //! and `count`.
    [[nodiscard]] std::string text() const;

private:
    template <typename Number>
    [[nodiscard]] static const char* name_of() {
        if constexpr (std::is_same_v<Number, double>) return "Float64Array";
        if constexpr (std::is_same_v<Number, agvd::Index>) return "Uint32Array";
        if constexpr (std::is_same_v<Number, std::int32_t>) return "Int32Array";
    }
    void add(const std::string& name, const char* type, const void* at, std::size_t count);

    Json arrays_ = Json::object();
    std::vector<std::any> owned_;
};

}  // namespace npm
