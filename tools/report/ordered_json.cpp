#include "report/ordered_json.h"

#include <algorithm>
#include <utility>

namespace remesh {

OrderedJson::OrderedJson(std::initializer_list<Member> members)
    : kind_(Kind::Object), members_(members) {}

OrderedJson OrderedJson::object() {
    OrderedJson made;
    made.kind_ = Kind::Object;
    return made;
}

OrderedJson OrderedJson::array() {
    OrderedJson made;
    made.kind_ = Kind::Array;
    return made;
}

OrderedJson& OrderedJson::operator[](const std::string& key) {
    kind_ = Kind::Object;
    const auto found = std::find_if(members_.begin(), members_.end(),
                                    [&](const Member& member) { return member.key == key; });
    if (found != members_.end()) return found->value;
    members_.push_back({key, {}});
    return members_.back().value;
}

void OrderedJson::push_back(OrderedJson value) { members_.push_back({{}, std::move(value)}); }

std::string OrderedJson::text() const {
    std::string text;
    append(text, "\n");
    return text;
}

// As nlohmann-json writes it with two spaces for each level.
void OrderedJson::append(std::string& text, const std::string& line_end) const {
    if (kind_ == Kind::Leaf) {
        for (const char c : leaf_.dump(2, ' ', false, nlohmann::json::error_handler_t::replace)) {
            c == '\n' ? text += line_end : text += c;
        }
        return;
    }
    const bool is_object = kind_ == Kind::Object;
    text += is_object ? '{' : '[';
    for (const Member& member : members_) {
        if (&member != &members_.front()) text += ',';
        text += line_end + "  ";
        if (is_object) text += '"' + member.key + "\": ";
        member.value.append(text, line_end + "  ");
    }
    if (!members_.empty()) text += line_end;
    text += is_object ? '}' : ']';
}

}  // namespace remesh
