// Draws line charts as SVG text. An axis collects the values to be shown, then chooses its range
// and ticks: powers of ten (with 2 and 5 where there are few) on logarithmic axes, otherwise steps
// of 1, 2 or 5 times a power of ten. Series differ by colour and have a legend.
#include "bench/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace bench {
namespace {

// Pixels.
constexpr double width = 460, height = 340;
constexpr double left = 62, right = 16, top = 34, bottom = 84;
constexpr std::array colours{"#1b6ca8", "#d1495b", "#2e8b57", "#b8860b",
                             "#6a4c93", "#444444", "#00a3a3", "#e07a1f"};

// One direction of a plot.
class Axis {
public:
    Axis(bool is_log, bool is_from_zero, double from, double to)
        : is_log_(is_log), is_from_zero_(is_from_zero), from_(from), to_(to) {}

    void include(double value) {
        low_ = std::min(low_, scaled(value));
        high_ = std::max(high_, scaled(value));
    }
    void finish() {
        if (low_ > high_) low_ = high_ = 0;
        if (is_from_zero_) low_ = std::min(low_, 0.0);
        if (high_ - low_ < 1e-12) high_ = low_ + 1;
        if (!is_from_zero_) {  // A little room, since no axis is at 0.
            const double room = 0.04 * (high_ - low_);
            low_ -= room;
            high_ += room;
        } else {
            high_ += 0.05 * (high_ - low_);
        }
    }
    [[nodiscard]] bool shows(double value) const {
        return std::isfinite(value) && (!is_log_ || value > 0);
    }
    [[nodiscard]] double pixel(double value) const {
        return from_ + (scaled(value) - low_) / (high_ - low_) * (to_ - from_);
    }
    [[nodiscard]] std::vector<double> ticks() const {
        std::vector<double> ticks;
        if (is_log_) {
            const bool is_dense = high_ - low_ < 2.2;
            for (double decade = std::floor(low_); decade <= high_; ++decade) {
                for (const double step : {1.0, 2.0, 5.0}) {
                    if (step != 1 && !is_dense) continue;
                    const double at = decade + std::log10(step);
                    if (at >= low_ && at <= high_) ticks.push_back(std::pow(10, at));
                }
            }
            return ticks;
        }
        const double rough = (high_ - low_) / 5;
        const double decade = std::pow(10, std::floor(std::log10(rough)));
        const double step = decade * (rough < 2 * decade ? 2 : rough < 5 * decade ? 5 : 10);
        for (double i = std::ceil(low_ / step); i * step <= high_; ++i) ticks.push_back(i * step);
        return ticks;
    }

private:
    [[nodiscard]] double scaled(double value) const { return is_log_ ? std::log10(value) : value; }

    bool is_log_, is_from_zero_;
    double from_, to_;  // Pixels.
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

std::string text_of(double value) {
    std::ostringstream text;
    text.precision(4);
    text << value;
    return text.str();
}

void add_text(std::ostringstream& svg, double x, double y, const std::string& text,
              const char* anchor, const char* more = "") {
    svg << "<text x=\"" << x << "\" y=\"" << y << "\" text-anchor=\"" << anchor << "\" " << more
        << ">";
    for (const char c : text) {
        if (c == '<' || c == '&') {
            svg << (c == '<' ? "&lt;" : "&amp;");
        } else {
            svg << c;
        }
    }
    svg << "</text>\n";
}

void add_frame(std::ostringstream& svg, const Plot& plot, const Axis& x, const Axis& y) {
    svg << "<rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << width - left - right
        << "\" height=\"" << height - top - bottom << "\" fill=\"none\" stroke=\"#888\"/>\n";
    for (const double tick : x.ticks()) {
        svg << "<path d=\"M" << x.pixel(tick) << ' ' << top << "V" << height - bottom
            << "\" stroke=\"#ddd\"/>\n";
        add_text(svg, x.pixel(tick), height - bottom + 14, text_of(tick), "middle");
    }
    for (const double tick : y.ticks()) {
        svg << "<path d=\"M" << left << ' ' << y.pixel(tick) << "H" << width - right
            << "\" stroke=\"#ddd\"/>\n";
        add_text(svg, left - 5, y.pixel(tick) + 4, text_of(tick), "end");
    }
    add_text(svg, width / 2, 20, plot.title, "middle", "font-weight=\"bold\"");
    add_text(svg, (left + width - right) / 2, height - bottom + 30, plot.x_label, "middle");
    const std::string turn =
        "transform=\"rotate(-90 14 " + text_of((top + height - bottom) / 2) + ")\"";
    add_text(svg, 14, (top + height - bottom) / 2, plot.y_label, "middle", turn.c_str());
}

void add_legend(std::ostringstream& svg, std::size_t i, const std::string& name) {
    constexpr std::size_t columns = 3;
    const double x = left + static_cast<double>(i % columns) * 132;
    const double y = height - 36 + static_cast<double>(i / columns) * 15;
    svg << "<path d=\"M" << x << ' ' << y - 4 << "h16\" stroke=\"" << colours[i % colours.size()]
        << "\" stroke-width=\"2\"/>\n";
    add_text(svg, x + 20, y, name, "start");
}

std::string draw(const Plot& plot) {
    Axis x(plot.is_log_x, !plot.is_log_x, left, width - right);
    Axis y(plot.is_log_y, !plot.is_log_y && plot.is_y_from_zero, height - bottom, top);
    const auto is_level = [](const Series& series) { return series.points.size() == 1; };
    const auto shows = [&](const Series& series, const std::pair<double, double>& point) {
        return (is_level(series) || x.shows(point.first)) && y.shows(point.second);
    };
    for (const Series& series : plot.series) {
        for (const auto& point : series.points) {
            if (!shows(series, point)) continue;
            if (!is_level(series)) x.include(point.first);
            y.include(point.second);
        }
    }
    x.finish();
    y.finish();
    std::ostringstream svg;
    add_frame(svg, plot, x, y);
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const Series& series = plot.series[i];
        const char* const colour = colours[i % colours.size()];
        std::ostringstream path, dots;
        for (const auto& point : series.points) {
            if (!shows(series, point)) continue;
            if (is_level(series)) {
                path << 'M' << left << ' ' << y.pixel(point.second) << 'H' << width - right;
                break;
            }
            const double px = x.pixel(point.first), py = y.pixel(point.second);
            path << (path.str().empty() ? 'M' : 'L') << px << ' ' << py;
            dots << "<circle cx=\"" << px << "\" cy=\"" << py << "\" r=\"2.5\" fill=\"" << colour
                 << "\"/>\n";
        }
        const char* const dash = is_level(series) ? " stroke-dasharray=\"6 4\"" : "";
        svg << "<path d=\"" << path.str() << "\" fill=\"none\" stroke=\"" << colour
            << "\" stroke-width=\"1.8\"" << dash << "/>\n"
            << dots.str();
        add_legend(svg, i, series.name);
    }
    return svg.str();
}

}  // namespace

std::string to_svg(std::span<const Plot> plots) {
    std::ostringstream svg;
    const double total = width * static_cast<double>(plots.size());
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << total << ' ' << height
        << "\" width=\"" << total << "\" height=\"" << height
        << "\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" "
           "fill=\"white\"/>\n";
    for (std::size_t i = 0; i < plots.size(); ++i) {
        svg << "<g transform=\"translate(" << width * static_cast<double>(i) << ")\">\n"
            << draw(plots[i]) << "</g>\n";
    }
    return svg.str() + "</svg>\n";
}

}  // namespace bench
