#include "remesh/io/read_sites.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "agvd/core/error.h"
#include "agvd/mesh/closest_point.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::SurfacePoint;

constexpr double sum_tolerance = 1e-6;  // Seven decimals survive, as a careful text file has them.

std::string read_text(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string text;
    if (!std::filesystem::is_directory(path) && in) {
        text.assign(std::istreambuf_iterator<char>(in), {});
    }
    if (text.empty()) {
        throw agvd::IoError(path.string() +
                            ": the file of sites cannot be read or is empty; check " +
                            "the path and its permissions");
    }
    return text;
}

class SiteReader {
public:
    SiteReader(const std::filesystem::path& path, const agvd::MeshView& mesh)
        : path_(path), mesh_(mesh) {}

    std::vector<SurfacePoint> read(std::string_view text) {
        std::vector<SurfacePoint> sites;
        while (!text.empty()) {
            ++line_;
            const std::size_t end = std::min(text.find('\n'), text.size());
            split(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
            if (!words_.empty()) sites.push_back(read_site());
        }
        if (sites.empty()) {
            throw agvd::IoError(path_.string() + ": the file holds no site; write lines like " +
                                "\"v INDEX\", \"f FACE B0 B1 B2\" or \"p X Y Z\"");
        }
        return sites;
    }

private:
    void split(std::string_view line) {
        words_.clear();
        line = line.substr(0, line.find('#'));
        for (;;) {
            const std::size_t begin = line.find_first_not_of(" \t\r");
            if (begin == std::string_view::npos) return;
            const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
            words_.push_back(line.substr(begin, end - begin));
            line.remove_prefix(end);
        }
    }

    SurfacePoint read_site() {
        const std::string_view kind = words_[0];
        if (kind == "v" && words_.size() == 2) {
            return at_vertex(index(words_[1], mesh_.positions.size(), "vertex"));
        }
        if (kind == "f" && words_.size() == 5) {
            const Index face = index(words_[1], mesh_.triangles.size(), "face");
            return {agvd::FaceId(face), barycentric()};
        }
        if (kind == "p" && words_.size() == 4) {
            if (!tree_) tree_.emplace(mesh_);
            return tree_->query({number(words_[1]), number(words_[2]), number(words_[3])}).point;
        }
        throw agvd::IoError(where() +
                            "this is no site; write \"v INDEX\", \"f FACE B0 B1 B2\" or " +
                            "\"p X Y Z\"");
    }

    SurfacePoint at_vertex(Index vertex) {
        if (lowest_corner_.empty()) {
            lowest_corner_.assign(mesh_.positions.size(), agvd::no_index);
            for (auto corner = static_cast<Index>(3 * mesh_.triangles.size()); corner-- > 0;) {
                lowest_corner_[mesh_.triangles[corner / 3][corner % 3]] = corner;
            }
        }
        const Index corner = lowest_corner_[vertex];
        if (corner == agvd::no_index) {
            throw agvd::InvalidInput(where() + "vertex " + std::to_string(vertex) +
                                     " is in no face; name a vertex of the surface");
        }
        SurfacePoint site{agvd::FaceId(corner / 3), {0, 0, 0}};
        site.barycentric[corner % 3] = 1;
        return site;
    }

    std::array<double, 3> barycentric() const {
        std::array<double, 3> b{number(words_[2]), number(words_[3]), number(words_[4])};
        const double sum = b[0] + b[1] + b[2];
        if (*std::min_element(b.begin(), b.end()) < 0 || !(std::abs(sum - 1) <= sum_tolerance)) {
            throw agvd::InvalidInput(where() + "barycentric coordinates must not be negative and " +
                                     "must sum to 1 within 1e-6; correct them");
        }
        for (double& x : b) x /= sum;
        return b;
    }

    Index index(std::string_view word, std::size_t count, const char* what) const {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_too_long = error == std::errc::result_out_of_range;
        if (end != word.data() + word.size() || (error != std::errc{} && !is_too_long)) {
            throw agvd::IoError(where() + "\"" + std::string(word) + "\" is no " + what +
                                " index; write a whole number, counted from 0");
        }
        if (is_too_long || value >= count) {
            throw agvd::InvalidInput(where() + what + " " + std::string(word) +
                                     " does not exist, the mesh has " + std::to_string(count) +
                                     " (counted from 0); correct the index");
        }
        return static_cast<Index>(value);
    }

    double number(std::string_view word) const {
        if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
            throw agvd::IoError(where() + "\"" + std::string(word) +
                                "\" is no finite number; correct it");
        }
        return value;
    }

    std::string where() const { return path_.string() + ":" + std::to_string(line_) + ": "; }

    const std::filesystem::path& path_;
    const agvd::MeshView& mesh_;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_;  // Of the current line.
    std::vector<Index> lowest_corner_;     // #V, made for the first `v`.
    std::optional<agvd::ClosestPointTree> tree_;
};

}  // namespace

std::vector<SurfacePoint> read_sites(const std::filesystem::path& path,
                                     const agvd::MeshView& mesh) {
    return SiteReader(path, mesh).read(read_text(path));
}

}  // namespace remesh
