#include "remesh/io/read_sites.h"

#include <cmath>
#include <optional>

#include "agvd/mesh/closest_point.h"
#include "remesh/io/text_scanner.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::SurfacePoint;

constexpr double sum_tolerance = 1e-6;  // Seven decimals in a text file are enough.

class SiteReader {
public:
    SiteReader(const SourceFile& file, const agvd::MeshView& mesh, const agvd::Progress& progress)

        : file_(file),
          mesh_(mesh),
          progress_(progress),
          ticker_(file.ticker),
          scan_(file, 0, {.comment = '#'}) {}

    std::vector<SurfacePoint> read() {
        std::vector<SurfacePoint> sites;
        while (scan_.find_word()) {
            ticker_.tick(16);
            start_ = scan_.offset();
            sites.push_back(read_site());
            if (scan_.has_word()) scan_.fail_expecting("the end of the line");
        }
        if (sites.empty()) {
            scan_.fail_malformed(
                "the file holds no site; write lines \"v INDEX\", \"f FACE B0 B1 B2\" or "
                "\"p X Y Z\"");
        }
        return sites;
    }

private:
    SurfacePoint read_site() {
        const std::string_view kind = scan_.word();
        if (kind == "v") return vertex_site();
        if (kind == "f") return face_site();
        if (kind == "p") {
            const agvd::Vec3 point = scan_.point();
            if (!tree_) tree_.emplace(mesh_, progress_);
            return tree_->query(point).point;
        }
        file_.fail_malformed(start_, "a site begins with v, f or p, not with " + in_quotes(kind) +
                                         "; correct the line or begin it with #");
    }

    Index index(const char* what, const char* plural, std::size_t count) {
        const std::int64_t value = scan_.integer(("a " + std::string(what) + " index").c_str());
        if (value < 0 || static_cast<std::uint64_t>(value) >= count) {
            file_.fail_unusable(start_, "the site names " + std::string(what) + " " +
                                            std::to_string(value) + ", but the mesh has only " +
                                            std::to_string(count) + " " + plural +
                                            ", counted from 0; correct the line");
        }
        return static_cast<Index>(value);
    }

    SurfacePoint vertex_site() {
        const Index vertex = index("vertex", "vertices", mesh_.positions.size());
        if (lowest_corner_.empty()) {
            lowest_corner_.assign(mesh_.positions.size(), agvd::no_index);
            for (auto corner = static_cast<Index>(3 * mesh_.triangles.size()); corner-- > 0;) {
                lowest_corner_[mesh_.triangles[corner / 3][corner % 3]] = corner;
            }
        }
        const Index corner = lowest_corner_[vertex];
        if (corner == agvd::no_index) {
            file_.fail_unusable(start_, "vertex " + std::to_string(vertex) +
                                            " is in no face; use a vertex of a face");
        }
        SurfacePoint site{agvd::FaceId(corner / 3), {0, 0, 0}};
        site.barycentric[corner % 3] = 1;
        return site;
    }

    SurfacePoint face_site() {
        SurfacePoint site{agvd::FaceId(index("face", "faces", mesh_.triangles.size())), {}};
        auto& b = site.barycentric;
        for (double& x : b) x = scan_.number("a barycentric coordinate");
        const double sum = b[0] + b[1] + b[2];
        const bool is_inside = b[0] >= 0 && b[1] >= 0 && b[2] >= 0;
        if (!is_inside || !(std::abs(sum - 1) <= sum_tolerance)) {
            file_.fail_unusable(start_,
                                "the barycentric coordinates are negative or do not sum to 1 "
                                "within 1e-6; correct them, or write the point as \"p X Y Z\"");
        }
        for (double& x : b) x /= sum;
        return site;
    }

    const SourceFile& file_;
    const agvd::MeshView& mesh_;
    const agvd::Progress& progress_;
    agvd::Ticker ticker_;
    TextScanner scan_;
    std::size_t start_ = 0;                       // Of the current line's first word.
    std::vector<Index> lowest_corner_;            // #V, made for the first `v`.
    std::optional<agvd::ClosestPointTree> tree_;  // Made for the first `p`.
};

}  // namespace

std::vector<SurfacePoint> read_sites(const std::filesystem::path& path, const agvd::MeshView& mesh,
                                     const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    const SourceFile file = load_file(path, poller);
    return SiteReader(file, mesh, progress).read();
}

}  // namespace remesh
