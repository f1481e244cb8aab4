//! \file
//! JSON whose keys keep the order in which they were set. A small class in place of nlohmann's
//! ordered_json, which takes 40 kB of code beside that of nlohmann::json.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace remesh {

//! A value: null, what nlohmann::json holds, an object or an array of such values.
class OrderedJson {
public:
    struct Member;

    OrderedJson() = default;
    template <typename Value>
    requires(!std::is_same_v<Value, OrderedJson> &&
             std::is_constructible_v<nlohmann::json, const Value&>) OrderedJson(const Value& value)
        : leaf_(value) {}
    OrderedJson(std::initializer_list<Member> members);

    [[nodiscard]] static OrderedJson object();
    [[nodiscard]] static OrderedJson array();

    //! The value of a key, which is added if it is not there.
    //! \pre this is an object, or null, which becomes one. \param key  plain ASCII.
    OrderedJson& operator[](const std::string& key);
    //! \pre this is an array.
    void push_back(OrderedJson value);

    //! Over several lines; bytes that are not UTF-8 are replaced, NaN and infinity are null.
    [[nodiscard]] std::string text() const;

private:
    enum class Kind { Leaf, Object, Array };

    void append(std::string& text, const std::string& line_end) const;

    Kind kind_ = Kind::Leaf;
    nlohmann::json leaf_;
    std::vector<Member> members_;  // Elements of an array have no key.
};

struct OrderedJson::Member {
    std::string key;
    OrderedJson value;
};

}  // namespace remesh
