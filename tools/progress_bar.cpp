#include "progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "system/terminal.h"

namespace cli {
namespace {

constexpr std::size_t longest_bar = 30, shortest_bar = 5;
// If the terminal does not tell its width.
constexpr std::size_t default_width = 80;

// "1:05", "1:02:03".
std::string clock_text(std::chrono::seconds time) {
    const long long s = time.count();
    char text[32];
    if (s < 3600) {
        std::snprintf(text, sizeof text, "%lld:%02lld", s / 60, s % 60);
    } else {
        std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", s / 3600, s / 60 % 60, s % 60);
    }
    return text;
}

}  // namespace

std::string progress_line(const ProgressState& state, std::size_t width) {
    const double fraction = std::clamp(state.fraction, 0.0, 1.0);
    char percent[16];
    std::snprintf(percent, sizeof percent, "%3d %%", static_cast<int>(100 * fraction));
    std::string text = std::string(percent) + "  " + state.stage;
    if (state.run > 1) text += ", run " + std::to_string(state.run);
    text += "  " + clock_text(state.elapsed);
    if (state.left) text += ", " + clock_text(*state.left) + " left";
    const std::size_t room = width > 0 ? width - 1 : 0;
    constexpr std::size_t around = 3;  // [, ] and a blank.
    if (room < text.size() + around + shortest_bar) return text.substr(0, room);
    const std::size_t length = std::min(longest_bar, room - text.size() - around);
    const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(length));
    return '[' + std::string(filled, '#') + std::string(length - filled, ' ') + "] " + text;
}

std::string progress_json(const ProgressState& state) {
    char fraction[16];
    std::snprintf(fraction, sizeof fraction, "%.3f", std::clamp(state.fraction, 0.0, 1.0));
    return std::string("{\"progress\": ") + fraction + ", \"stage\": \"" + state.stage +
           "\", \"run\": " + std::to_string(state.run) + '}';
}

ProgressBar::ProgressBar(bool is_shown, ProgressForm form)
    : form_(form),
      is_shown_(form == ProgressForm::Json || (is_shown && ::isatty(STDERR_FILENO) == 1)) {}

void ProgressBar::draw(const ProgressState& state) {
    if (!is_shown_) return;
    if (form_ == ProgressForm::Json) {
        std::fprintf(stderr, "%s\n", progress_json(state).c_str());
        return;
    }
    const std::size_t width = terminal_width(STDERR_FILENO);
    std::string line = progress_line(state, width == 0 ? default_width : width);
    if (line == line_) return;
    clear();
    line_ = std::move(line);
    std::fputs(line_.c_str(), stderr);
}

void ProgressBar::clear() {
    if (!line_.empty()) std::fputs("\r\x1b[K", stderr);
    line_.clear();
}

}  // namespace cli
