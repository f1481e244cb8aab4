#include "examples/example.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "agvd/core/error.h"

namespace example {

int run(int argc, const char* const* argv, const char* usage, std::size_t fewest, std::size_t most,
        const std::function<void(const Arguments&)>& job) {
    const Arguments arguments(argv + 1, argv + argc);
    const bool is_help = arguments.size() == 1 && arguments[0] == "--help";
    if (is_help || arguments.size() < fewest || arguments.size() > most) {
        std::fputs(usage, is_help ? stdout : stderr);
        return is_help ? 0 : 2;
    }
    try {
        job(arguments);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 1;
    }
}

double number(const std::string& text, const std::string& name, double least, double most) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(value >= least && value <= most)) {
        std::ostringstream message;
        message << name << " is " << text << "; give a number from " << least << " to " << most;
        throw agvd::InvalidOption(message.str());
    }
    return value;
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    file.close();
    if (!file) throw agvd::IoError(path.string() + ": cannot be written; check the folder");
}

void write_lines(const std::filesystem::path& path, const std::vector<Line>& lines) {
    std::ostringstream text;
    text.precision(17);
    std::size_t num_points = 0;
    for (const Line& line : lines) {
        for (const agvd::Vec3& p : line) {
            text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
        }
        text << 'l';
        for (std::size_t i = 0; i < line.size(); ++i) text << ' ' << ++num_points;
        text << '\n';
    }
    write_file(path, text.str());
}

double length_of(const Line& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
    return length;
}

}  // namespace example
