#include "message.h"

#include <memory>

namespace npm {

void Answer::add_bytes(const std::string& name, std::string bytes) {
    // Behind a pointer, as a short text would move with its owner.
    auto kept = std::make_shared<std::string>(std::move(bytes));
    add(name, "Uint8Array", kept->data(), kept->size());
    owned_.emplace_back(std::move(kept));
}

std::string Answer::text() const {
    Json all = json;
    all["arrays"] = arrays_;
    std::string text = all.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (!report.empty()) text.insert(1, "\"report\":" + report + ',');
    return text;
}

void Answer::add(const std::string& name, const char* type, const void* at, std::size_t count) {
    arrays_[name] = {
        {"type", type}, {"at", reinterpret_cast<std::uintptr_t>(at)}, {"count", count}};
}

}  // namespace npm
