#include "options.h"

#include <fast_float/fast_float.h>
#include <charconv>
#include <cmath>

#include "agvd/mesh/scale.h"
#include "nearest_name.h"

namespace npm {
namespace {

// What JSON does not hold comes in parentheses: "(NaN)", "(function)".
std::string shown(const Json& value) {
    if (!value.is_string()) return value.dump();
    const std::string text = value.get<std::string>();
    const bool is_special = text.starts_with('(') && text.ends_with(')');
    return is_special ? text.substr(1, text.size() - 2) : "'" + text + "'";
}

[[noreturn]] void refuse(const char* name, const Json& value, const std::string& remedy) {
    throw agvd::InvalidOption(std::string(name) + " is " + shown(value) + "; use " + remedy);
}

// The number before a final percent sign.
std::optional<double> percent_of(const Json& value) {
    if (!value.is_string()) return std::nullopt;
    const std::string text = value.get<std::string>();
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = fast_float::from_chars(text.data(), end, number);
    const bool is_percent = error == std::errc{} && end - last == 1 && *last == '%';
    return is_percent && std::isfinite(number) && number > 0 ? std::optional(number) : std::nullopt;
}

double diagonal(const agvd::MeshView& mesh) {
    const agvd::MeshBox box = agvd::box_of(mesh);
    return box.is_empty() ? 0 : (box.high - box.low).norm();
}

}  // namespace

const Json* Options::find(const char* name) {
    known_.insert(name);
    const auto found = given_.find(name);
    return found == given_.end() || found->is_null() ? nullptr : &*found;
}

bool Options::has(const char* name) { return find(name) != nullptr; }

std::optional<double> Options::number(const char* name) {
    const Json* const value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number()) refuse(name, *value, "a finite number");
    return value->get<double>();
}

std::optional<double> Options::whole(const char* name, double least, double most) {
    const Json* const value = find(name);
    if (value == nullptr) return std::nullopt;
    const double number = value->is_number() ? value->get<double>() : least - 1;
    if (number != std::floor(number) || number < least || number > most) {
        refuse(name, *value,
               "a whole number from " + Json(static_cast<std::int64_t>(least)).dump() + " to " +
                   Json(static_cast<std::int64_t>(most)).dump());
    }
    return number;
}

std::optional<bool> Options::optional_flag(const char* name) {
    const Json* const value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_boolean()) refuse(name, *value, "true or false");
    return value->get<bool>();
}

bool Options::flag(const char* name) { return optional_flag(name).value_or(false); }

std::optional<std::string> Options::text(const char* name) {
    const Json* const value = find(name);
    if (value == nullptr) return std::nullopt;
    if (!value->is_string()) refuse(name, *value, "a text");
    return value->get<std::string>();
}

std::optional<double> Options::length(const char* name, const agvd::MeshView& mesh) {
    const Json* const value = find(name);
    if (value == nullptr) return std::nullopt;
    if (const auto percent = percent_of(*value)) return *percent * diagonal(mesh) / 100;
    if (!value->is_number() || !(value->get<double>() > 0)) {
        refuse(name, *value,
               "a number above 0, or a percentage of the diagonal of the mesh (such as '2%')");
    }
    return value->get<double>();
}

std::optional<double> Options::count(const char* name, std::size_t all) {
    const Json* const value = find(name);
    if (value == nullptr) return std::nullopt;
    if (const auto percent = percent_of(*value)) {
        return std::max(1.0, std::round(*percent / 100 * static_cast<double>(all)));
    }
    constexpr double most = std::numeric_limits<agvd::Index>::max();
    const double number = value->is_number() ? value->get<double>() : 0;
    if (number != std::floor(number) || number < 1 || number > most) {
        refuse(name, *value,
               "a whole number of 1 or more, or a percentage of the input's vertices (such as "
               "'10%')");
    }
    return number;
}

void Options::require_known() const {
    for (const auto& [name, value] : given_.items()) {
        if (known_.contains(name)) continue;
        const std::vector<std::string> names(known_.begin(), known_.end());
        const std::string meant = cli::nearest_name(name, names);
        throw agvd::InvalidOption(
            "there is no option '" + name + "'; " +
            (meant.empty() ? "leave it out" : "did you mean '" + meant + "'?"));
    }
}

}  // namespace npm
