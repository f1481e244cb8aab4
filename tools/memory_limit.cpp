#include "memory_limit.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

namespace cli {
namespace {

constexpr std::pair<char, double> units[] = {
    {'T', 0x1p40}, {'G', 0x1p30}, {'M', 0x1p20}, {'K', 0x1p10}};

// The factor of a suffix; unset for an unknown one.
std::optional<double> unit_of(std::string_view suffix) {
    if (suffix.empty()) return 1;
    if (suffix == "%") return static_cast<double>(machine_memory()) / 100;
    for (const auto& [letter, bytes] : units) {
        if (suffix.size() == 1 && (suffix[0] == letter || suffix[0] == letter - 'A' + 'a')) {
            return bytes;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<std::size_t> parse_bytes(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (error != std::errc{} || !std::isfinite(number) || !(number > 0)) return std::nullopt;
    const std::string_view suffix(last, static_cast<std::size_t>(end - last));
    const std::optional<double> unit = unit_of(suffix);
    if (!unit || (suffix == "%" && number > 100)) return std::nullopt;
    const double bytes = std::floor(number * *unit);
    if (!(bytes >= 1 && bytes < 0x1p63)) return std::nullopt;
    return static_cast<std::size_t>(bytes);
}

std::string format_bytes(std::size_t bytes) {
    const auto size = static_cast<double>(bytes);
    char text[32];
    for (const auto& [letter, unit] : units) {
        if (size < unit) continue;
        std::snprintf(text, sizeof text, "%.3g%c", size / unit, letter);
        return text;
    }
    return std::to_string(bytes);
}

bool MemoryGuard::check() {
    is_over_ = is_over_ || (limit_.bytes > 0 && resident_memory() > limit_.bytes);
    return is_over_;
}

void MemoryGuard::require(const std::string& stage, std::size_t bytes) {
    const std::size_t needed = resident_memory() + bytes;
    if (limit_.bytes == 0 || needed <= limit_.bytes) return;
    is_over_ = true;
    throw error(stage, "some " + format_bytes(needed) + ", ");
}

OutOfMemory MemoryGuard::error(const std::string& stage, const std::string& needed) const {
    std::string text = "not enough memory";
    if (is_over_) {
        text += ": the program needs " + needed + "more than the " + format_bytes(limit_.bytes) +
                " of --memory-limit";
    }
    if (!stage.empty()) text += " (stage: " + stage + ")";
    text += "; " + memory_remedy(stage, limit_.engine);
    return OutOfMemory(is_over_ ? text + ", or raise --memory-limit" : text);
}

std::string memory_remedy(std::string_view stage, agvd::Engine engine) {
    if (stage == "propagate") {
        switch (engine) {
            case agvd::Engine::Window:
                return "use a larger --max-error, fewer --threads or more --samples";
            case agvd::Engine::Steiner:
                return "use fewer --steiner-points, a smaller --lambda or a smaller mesh";
        }
    }
    if (stage == "read") return "use a smaller mesh";
    if (stage == "clean") return "use a smaller mesh or fewer --samples";
    if (stage == "relax") return "use a smaller mesh, fewer --samples or --relax 0";
    if (stage == "delaunay") return "use fewer --samples, --delaunay extrinsic or --delaunay off";
    if (stage == "compare") return "use a smaller mesh, a larger --spacing or fewer --points";
    if (stage == "measure") return "use smaller meshes or fewer --samples";
    return "use fewer --samples or a smaller mesh";
}

}  // namespace cli
