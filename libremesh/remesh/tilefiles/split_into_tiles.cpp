// The first pass finds areas and planes, the second one divides the faces. Then each tile is looked
// at twice: for its parts and the edges at its rim, and, once it is known which parts and edges
// belong together, for the faces around its borders. The sites are placed on a mesh of these.
#include <algorithm>
#include <atomic>
#include <unordered_map>

#include "agvd/core/error.h"
#include "agvd/core/groups.h"
#include "agvd/core/number_text.h"
#include "agvd/core/random.h"
#include "agvd/core/union_find.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/curve_sites.h"
#include "remesh/curves/find_creases.h"
#include "remesh/sites/shares.h"
#include "remesh/tilefiles/each_tile.h"
#include "remesh/tilefiles/face_buckets.h"
#include "remesh/tilefiles/triangle_source.h"
#include "remesh/tiles/border_sites.h"
#include "remesh/tiles/cut_by_planes.h"
#include "remesh/tiles/join_parts.h"
#include "remesh/tiles/tiling.h"

namespace remesh {
namespace {

namespace fs = std::filesystem;

// Faces that are cut at once.
constexpr std::size_t faces_at_once = 1 << 16;
// Points by which planes are chosen.
constexpr std::size_t most_points = 1 << 18;

using Corners = std::array<Vec3, 3>;

// Shares of the time.
constexpr double surveyed = 0.1, divided = 0.5, parted = 0.75, banded = 0.9;

std::string text_of(const Vec3& position) {
    return "(" + number_text(position.x(), 12) + ", " + number_text(position.y(), 12) + ", " +
           number_text(position.z(), 12) + ")";
}

double area_of(const Corners& face) {
    return (face[1] - face[0]).cross(face[2] - face[0]).norm() / 2;
}

bool is_before(const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

// Points that stand for runs of faces, and the areas of these.
class Survey {
public:
    void add(const Corners& face) {
        const double area = area_of(face);
        area_ += area;
        if (num_faces_++ % run_ == 0) {
            if (points_.size() == most_points) halve();
            points_.emplace_back((face[0] + face[1] + face[2]) / 3);
            weights_.push_back(0);
        }
        weights_.back() += area;
    }

    [[nodiscard]] double area() const { return area_; }
    [[nodiscard]] PlaneTree divide(Index num_cells, Ticker ticker) const {
        return divide_by_planes(points_, weights_, num_cells, ticker);
    }

private:
    // Joins each two runs.
    void halve() {
        run_ *= 2;
        for (std::size_t i = 0; 2 * i < points_.size(); ++i) {
            points_[i] = points_[2 * i];
            weights_[i] = weights_[2 * i] + weights_[2 * i + 1];
        }
        points_.resize(points_.size() / 2);
        weights_.resize(points_.size());
    }

    double area_ = 0;
    std::uint64_t num_faces_ = 0, run_ = 1;
    std::vector<Vec3> points_;
    std::vector<double> weights_;
};

// An edge at the rim of a part; its face lies on its left.
struct RimEdge {
    Vec3 from, to;
    Index part;

    [[nodiscard]] bool is_upward() const { return is_before(from, to); }
    [[nodiscard]] const Vec3& low() const { return is_upward() ? from : to; }
    [[nodiscard]] const Vec3& high() const { return is_upward() ? to : from; }
    [[nodiscard]] double length() const { return (to - from).norm(); }
    [[nodiscard]] bool has_ends_of(const RimEdge& other) const {
        return low() == other.low() && high() == other.high();
    }
};

bool is_before(const RimEdge& a, const RimEdge& b) {
    if (a.low() != b.low()) return is_before(a.low(), b.low());
    if (a.high() != b.high()) return is_before(a.high(), b.high());
    return a.part < b.part;
}

// The faces of a cell of the tree that are connected by edges.
struct CellParts {
    std::vector<Index> part_of_face;
    std::vector<double> area, rim_length;  // By part.
    std::vector<RimEdge> rim;              // Parts of the cell.
};

// Whether a face has an edge, in this direction.
bool has_edge(const Triangle& t, Index from, Index to) {
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) ||
           (t[2] == from && t[0] == to);
}

CellParts find_parts(const TriangleMesh& mesh) {
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    const Groups faces_at = triangles_by_vertex(mesh.triangles, mesh.positions.size());
    const auto is_fewer = [&](Index a, Index b) {
        return faces_at.of(a).size() < faces_at.of(b).size();
    };
    UnionFind parts(num_faces);
    std::vector<Index> rim;  // Half-edges.
    for (Index h = 0; h < 3 * num_faces; ++h) {
        const Triangle& t = mesh.triangles[h / 3];
        const Index from = t[h % 3], to = t[(h % 3 + 1) % 3];
        bool is_rim = true;
        for (const Index other : faces_at.of(is_fewer(from, to) ? from : to)) {
            const bool is_across = has_edge(mesh.triangles[other], to, from);
            is_rim = is_rim && !is_across;
            if (is_across || has_edge(mesh.triangles[other], from, to)) parts.unite(h / 3, other);
        }
        if (is_rim) rim.push_back(h);
    }
    CellParts found;
    for (Index f = 0; f < num_faces; ++f) {
        if (parts.is_root(f)) {
            found.part_of_face.push_back(static_cast<Index>(found.area.size()));
            found.area.push_back(0);
            found.rim_length.push_back(0);
        } else {
            found.part_of_face.push_back(found.part_of_face[parts.root(f)]);
        }
        found.area[found.part_of_face[f]] += area_of(corners_of(mesh.view(), f));
    }
    for (const Index h : rim) {
        const Triangle& t = mesh.triangles[h / 3];
        const RimEdge edge{mesh.positions[t[h % 3]], mesh.positions[t[(h % 3 + 1) % 3]],
                           found.part_of_face[h / 3]};
        found.rim_length[edge.part] += edge.length();
        found.rim.push_back(edge);
    }
    return found;
}

// What cannot be cleaned has none: meshing its tile tells why.
double length_of_creases(const TriangleMesh& mesh, double spacing) try {
    const CleanResult clean = clean_input(mesh.view(), {.keep_slits = true, .num_threads = 1});
    const Surface surface = build_surface(clean.mesh.view(), 1);
    const auto is_crease = find_creases(surface, {.spacing = spacing, .num_threads = 1});
    double sum = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) sum += is_crease[e] * surface.length[e];
    return sum;
} catch (const InvalidInput&) {
    return 0;
}

class Splitter {
public:
    Splitter(const fs::path& file, const fs::path& folder, const SplitOptions& options)
        : source_(file), folder_(folder), options_(options) {
        plan_.input = file.string();
        plan_.input_bytes = source_.num_bytes();
        plan_.num_faces = source_.num_faces();
        plan_.num_samples = options.num_samples;
        plan_.samples_per_tile = options.samples_per_tile;
        plan_.seed = options.seed;
        plan_.relax_steps = options.relax_steps;
    }

    TilePlan run() {
        const PlaneTree tree = survey();
        FaceBuckets faces(folder_, tree.num_cells);
        divide(tree, faces);
        find_all_parts(faces);
        match_rims();
        sort_parts(faces);
        find_bands(faces);
        place_sites();
        write_tiles(faces);
        write_tile_plan(folder_, plan_);
        return std::move(plan_);
    }

private:
    // Work of one thread.
    template <typename Each>
    void for_each_face(double from, double to, const Each& each) {
        const Progress told = progress(from, to);
        Poller poller(told);
        Ticker ticker(poller);
        source_.rewind();
        Corners corners;
        for (std::uint64_t f = 0; source_.next(corners); ++f) {
            at_ = static_cast<double>(f) / static_cast<double>(plan_.num_faces);
            ticker.tick();
            const bool is_flat =
                corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
            if (!is_flat) each(corners);
        }
    }

    [[nodiscard]] Progress progress(double from, double to) {
        if (!options_.progress) return {};
        at_ = 0;
        return [this, from, to](double) { return options_.progress(from + at_ * (to - from)); };
    }

    template <typename Each>
    void for_each_cell(Index count, double from, double to, const Each& each) {
        const Progress told = progress(from, to);
        Poller poller(told);
        std::atomic<Index> num_done = 0;
        for_each_tile(
            count, options_.num_threads,
            [&](Index i) {
                each(i);
                at_ = static_cast<double>(++num_done) / count;
            },
            poller);
    }

    PlaneTree survey() {
        Survey survey;
        for_each_face(0, surveyed, [&](const Corners& face) { survey.add(face); });
        if (!(survey.area() > 0)) {
            throw InvalidInput(plan_.input + ": has no face with an area; export it again");
        }
        plan_.area = survey.area();
        plan_.spacing = detail::spacing_of(plan_.num_samples, plan_.area);
        const Index num_cells = num_tiles_for(plan_.num_samples, plan_.samples_per_tile);
        tile_area_ = plan_.area / num_cells;
        const Progress told = progress(surveyed, surveyed);
        Poller poller(told);
        return survey.divide(num_cells, Ticker(poller));
    }

    void divide(const PlaneTree& tree, FaceBuckets& faces) {
        WeldedFaces some;
        const auto cut = [&] {
            const TriangleMesh mesh = some.take();
            const CutMesh parts =
                cut_by_planes(mesh.view(), tree, snap_to_plane * plan_.spacing, {});
            for (Index f = 0; f < parts.cell.size(); ++f) {
                faces.add(parts.cell[f], corners_of(parts.mesh.view(), f));
            }
        };
        for_each_face(surveyed, divided, [&](const Corners& face) {
            some.add(face);
            if (some.size() == faces_at_once) cut();
        });
        if (some.size() > 0) cut();
        faces.flush();
    }

    void find_all_parts(const FaceBuckets& faces) {
        std::vector<CellParts> found(faces.size());
        std::vector<double> creases(faces.size());
        for_each_cell(faces.size(), divided, parted, [&](Index cell) {
            const TriangleMesh mesh = faces.read(cell);
            found[cell] = find_parts(mesh);
            found[cell].part_of_face = {};
            creases[cell] = length_of_creases(mesh, plan_.spacing);
        });
        for (const double length : creases) plan_.crease_length += length;
        for (CellParts& cell : found) {
            first_part_.push_back(static_cast<Index>(area_.size()));
            for (RimEdge& edge : cell.rim) {
                edge.part += first_part_.back();
                rim_.push_back(edge);
            }
            area_.insert(area_.end(), cell.area.begin(), cell.area.end());
            rim_length_.insert(rim_length_.end(), cell.rim_length.begin(), cell.rim_length.end());
            cell = {};
        }
        first_part_.push_back(static_cast<Index>(area_.size()));
    }

    // Finds borders, and which parts belong together.
    void match_rims() {
        std::sort(rim_.begin(), rim_.end(),
                  [](const RimEdge& a, const RimEdge& b) { return is_before(a, b); });
        std::vector<PartBorder> borders;
        std::vector<RimEdge> matched;
        for (std::size_t i = 0; i < rim_.size();) {
            std::size_t end = i + 1;
            while (end < rim_.size() && rim_[end].has_ends_of(rim_[i])) ++end;
            const bool is_border = cell_of_part(rim_[i].part) != cell_of_part(rim_[end - 1].part);
            if (is_border) {
                require_pair(i, end);
                borders.push_back({rim_[i].part, rim_[i + 1].part, rim_[i].length()});
                matched.insert(matched.end(), {rim_[i], rim_[i + 1]});
            }
            i = end;
        }
        const std::vector<Index> joined = join_parts(area_, borders, least_share * tile_area_);
        for (Index part = 0; part < joined.size(); ++part) {
            cell_.push_back(cell_of_part(joined[part]));
        }
        rim_.clear();
        for (std::size_t i = 0; i < matched.size(); i += 2) {
            if (cell_[matched[i].part] == cell_[matched[i + 1].part]) {
                for (const std::size_t side : {i, i + 1}) {
                    rim_length_[matched[side].part] -= matched[side].length();
                }
                continue;
            }
            rim_.insert(rim_.end(), {matched[i], matched[i + 1]});
        }
    }

    void require_pair(std::size_t begin, std::size_t end) const {
        const RimEdge& edge = rim_[begin];
        if (end - begin == 2 && edge.from == rim_[begin + 1].to) return;
        throw InvalidInput(
            plan_.input + ": at the edge from " + text_of(edge.from) + " to " + text_of(edge.to) +
            (end - begin == 2 ? ", the border of a tile, two faces do not run the "
                                "same way"
                              : ", the border of a tile, more than two faces meet") +
            "; clean the mesh first, or choose another number of vertices for a tile");
    }

    [[nodiscard]] Index cell_of_part(Index part) const {
        return static_cast<Index>(std::upper_bound(first_part_.begin(), first_part_.end(), part) -
                                  first_part_.begin() - 1);
    }

    // Takes the faces of small parts to their tiles.
    void sort_parts(FaceBuckets& faces) {
        const Index num_cells = faces.size();
        std::vector<std::uint8_t> loses(num_cells, 0);
        for (Index part = 0; part < cell_.size(); ++part) {
            const Index cell = cell_of_part(part);
            if (cell_[part] != cell) loses[cell] = 1;
        }
        for (Index cell = 0; cell < num_cells; ++cell) {
            if (loses[cell] == 0) continue;
            const TriangleMesh mesh = faces.read(cell);
            const CellParts parts = find_parts(mesh);
            WeldedFaces left;
            for (Index f = 0; f < mesh.triangles.size(); ++f) {
                const Index to = cell_[first_part_[cell] + parts.part_of_face[f]];
                if (to == cell) {
                    left.add(corners_of(mesh.view(), f));
                } else {
                    moved_.emplace_back(to, corners_of(mesh.view(), f));
                }
            }
            faces.replace(cell, left.take().view());
        }
        for (const auto& [to, corners] : moved_) faces.add(to, corners);
        faces.flush();
        moved_ = {};
        cell_of_tile_ = distinct(cell_);
    }

    // The faces at the vertices of borders.
    void find_bands(FaceBuckets& faces) {
        std::unordered_map<Vec3, Index, PositionHash> on_border;
        for (const RimEdge& edge : rim_) on_border.try_emplace(edge.from, 0);
        const auto num_tiles = static_cast<Index>(cell_of_tile_.size());
        std::vector<std::vector<Corners>> bands(num_tiles);
        for_each_cell(num_tiles, parted, banded, [&](Index tile) {
            const TriangleMesh mesh = faces.read(cell_of_tile_[tile]);
            for (Index f = 0; f < mesh.triangles.size(); ++f) {
                const Corners corners = corners_of(mesh.view(), f);
                if (std::ranges::any_of(corners,
                                        [&](const Vec3& p) { return on_border.contains(p); })) {
                    bands[tile].push_back(corners);
                }
            }
        });
        WeldedFaces band;
        for (Index tile = 0; tile < num_tiles; ++tile) {
            for (const Corners& corners : bands[tile]) {
                band.add(corners);
                tile_of_face_.push_back(tile);
            }
        }
        band_ = band.take();
    }

    // Places the sites of the borders, and shares out the other vertices.
    void place_sites() {
        const auto num_tiles = static_cast<Index>(cell_of_tile_.size());
        border_.resize(num_tiles);
        std::vector<double> inner(num_tiles), border_length(num_tiles, 0);
        std::vector<double> area(num_tiles, 0), rim_length(num_tiles, 0);
        for (Index part = 0; part < cell_.size(); ++part) {
            const Index tile = rank_of(cell_of_tile_, cell_[part]);
            area[tile] += area_[part];
            rim_length[tile] += rim_length_[part];
        }
        if (!band_.triangles.empty()) {
            CleanResult clean = clean_input(
                band_.view(), {.keep_slits = true, .num_threads = options_.num_threads});
            const Surface surface = build_surface(clean.mesh.view(), options_.num_threads);
            std::vector<std::uint8_t> is_border(surface.num_edges(), 0);
            const auto tile_of = [&](Index h) {
                return tile_of_face_[clean.face_origin[Surface::face(h)]];
            };
            std::size_t count = 0;
            for (Index e = 0; e < surface.num_edges(); ++e) {
                const Index h = surface.edge_half[e], twin = surface.twin[h];
                if (twin == no_index || tile_of(h) == tile_of(twin)) continue;
                is_border[e] = 1;
                ++count;
                border_length[tile_of(h)] += surface.length[e];
                border_length[tile_of(twin)] += surface.length[e];
            }
            if (2 * count != rim_.size()) {
                throw InvalidInput(plan_.input +
                                   ": the surface is not clean at the borders of tiles; clean the "
                                   "mesh first, or choose another number of vertices for a tile");
            }
            const CurveNetwork network = find_network(surface, is_border, plan_.spacing);
            const BorderSites sites =
                border_sites(surface, is_border, network,
                             even_positions(surface, network, plan_.spacing,
                                            curve_intervals(surface, network, plan_.spacing)),
                             plan_.spacing);
            plan_.num_sites = sites.num_sites;
            take_borders(surface, is_border, sites, tile_of);
        }
        for (Index tile = 0; tile < num_tiles; ++tile) {
            const double boundary = std::max(rim_length[tile] - border_length[tile], 0.0);
            inner[tile] =
                boundary / plan_.spacing +
                std::max(detail::inner_sites(area[tile], rim_length[tile], plan_.spacing), 0.0);
        }
        const Index left = plan_.num_samples - std::min(plan_.num_samples, plan_.num_sites);
        plan_.num_vertices = detail::apportion(inner, left);
        for (Index tile = 0; tile < num_tiles; ++tile) {
            std::vector<Index> numbers;
            for (const Border& edge : border_[tile]) {
                for (const auto& [share, number] : edge.sites) numbers.push_back(number);
            }
            plan_.num_vertices[tile] += static_cast<Index>(distinct(std::move(numbers)).size());
        }
    }

    // Sorts the edges of borders and their sites by tile.
    template <typename TileOf>
    void take_borders(const Surface& surface, std::span<const std::uint8_t> is_border,
                      const BorderSites& sites, const TileOf& tile_of) {
        std::vector<Index> num_borders(surface.num_vertices(), 0);
        auto next = sites.sites.begin();
        for (Index e = 0; e < surface.num_edges(); ++e) {
            if (is_border[e] == 0) continue;
            const Index h = surface.edge_half[e], twin = surface.twin[h];
            Border edge{surface.mesh.positions[surface.tail(h)],
                        surface.mesh.positions[surface.head(h)],
                        {}};
            for (; next != sites.sites.end() && next->edge == e; ++next) {
                edge.sites.emplace_back(next->share, next->number);
            }
            border_[tile_of(h)].push_back(edge);
            std::swap(edge.from, edge.to);
            std::ranges::reverse(edge.sites);
            for (auto& [share, number] : edge.sites) share = 1 - share;
            border_[tile_of(twin)].push_back(std::move(edge));
            ++num_borders[surface.tail(h)];
            ++num_borders[surface.head(h)];
            --plan_.border_euler;
        }
        // A vertex has a copy in each sector between borders.
        for (Index v = 0; v < num_borders.size(); ++v) {
            if (num_borders[v] == 0) continue;
            plan_.border_euler += num_borders[v] - (surface.is_boundary_vertex(v) ? 0 : 1);
        }
    }

    void write_tiles(const FaceBuckets& faces) {
        const std::uint64_t identity = identity_of(plan_);
        for_each_cell(plan_.num_tiles(), banded, 1, [&](Index number) {
            TileFile tile{.plan = identity, .num_vertices = plan_.num_vertices[number]};
            tile.mesh = faces.read(cell_of_tile_[number]);
            std::unordered_map<Vec3, Index, PositionHash> ends;
            for (const Border& edge : border_[number]) ends.try_emplace(edge.from, no_index);
            for (const Border& edge : border_[number]) ends.try_emplace(edge.to, no_index);
            for (Index v = 0; v < tile.mesh.positions.size(); ++v) {
                const auto found = ends.find(tile.mesh.positions[v]);
                if (found != ends.end()) found->second = v;
            }
            for (const Border& edge : border_[number]) {
                for (const auto& [share, site] : edge.sites) {
                    tile.sites.push_back({static_cast<Index>(tile.border.size()), share, site});
                }
                tile.border.push_back({ends.at(edge.from), ends.at(edge.to)});
            }
            write_tile(folder_, number, tile);
        });
    }

    // An edge of a border, its tile on its left, with the shares and numbers of its sites.
    struct Border {
        Vec3 from, to;
        std::vector<std::pair<double, Index>> sites;
    };

    TriangleSource source_;
    const fs::path& folder_;
    const SplitOptions& options_;
    TilePlan plan_;
    double tile_area_ = 0;
    std::atomic<double> at_ = 0;  // Share of a step.
    // Parts of cells are numbered by cell.
    std::vector<Index> first_part_;          // By cell, and behind the last one.
    std::vector<double> area_, rim_length_;  // By part.
    std::vector<Index> cell_;                // By part: that whose tile it belongs to.
    std::vector<RimEdge> rim_;               // First all, then those on borders: two at one place.
    std::vector<std::pair<Index, Corners>> moved_;  // Cell, face.
    std::vector<Index> cell_of_tile_;
    TriangleMesh band_;                        // The faces at the vertices of borders.
    std::vector<Index> tile_of_face_;          // Of these.
    std::vector<std::vector<Border>> border_;  // By tile.
};

void check_options(const SplitOptions& options) {
    const auto require = [](bool is_fine, const std::string& text) {
        if (!is_fine) throw InvalidOption(text);
    };
    require(options.num_samples >= 1, "num_samples is 0; use 1 or more");
    require(options.samples_per_tile >= least_samples_per_tile,
            "samples_per_tile is " + std::to_string(options.samples_per_tile) + "; use " +
                std::to_string(least_samples_per_tile) + " or more");
    require(options.relax_steps >= 1,
            "relax_steps is " + std::to_string(options.relax_steps) + "; use 1 or more");
    check_num_threads(options.num_threads);
}

// Whether a plan is what these arguments give.
bool is_plan_of(const TilePlan& plan, const fs::path& file, const SplitOptions& options) {
    return plan.input == file.string() && plan.input_bytes == fs::file_size(file) &&
           plan.num_samples == options.num_samples &&
           plan.samples_per_tile == options.samples_per_tile && plan.seed == options.seed &&
           plan.relax_steps == options.relax_steps;
}

}  // namespace

TilePlan split_into_tiles(const fs::path& file, const fs::path& folder,
                          const SplitOptions& options) {
    check_options(options);
    if (fs::exists(plan_path(folder))) {
        TilePlan plan = read_tile_plan(folder);
        if (fs::exists(file) && is_plan_of(plan, file, options)) return plan;
        throw InvalidOption(folder.string() +
                            ": has the tiles of another file or of other options; remove them, or "
                            "name another folder");
    }
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) {
        throw IoError(folder.string() + ": cannot be made: " + failure.message() +
                      "; name another folder");
    }
    return Splitter(file, folder, options).run();
}

}  // namespace remesh
