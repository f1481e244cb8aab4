#include "remesh/tilefiles/tile_file.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "agvd/core/error.h"
#include "agvd/core/random.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {
namespace {

namespace fs = std::filesystem;

// The first bytes of the files; the number is that of the format.
constexpr std::string_view tile_mark = "remesh tile 1\n", mesh_mark = "remesh tile mesh 1\n";
constexpr int plan_version = 1;

fs::path numbered(const fs::path& folder, Index tile, const char* extension) {
    std::string name = std::to_string(tile);
    if (name.size() < 5) name.insert(0, 5 - name.size(), '0');
    return folder / (name + extension);
}

std::string read_bytes(const fs::path& path) {
    const Progress none;
    Poller poller(none);
    return load_file(path, poller).bytes;
}

// A file whose mark and plan are checked.
class MarkedFile {
public:
    MarkedFile(fs::path path, std::string_view mark, std::uint64_t plan)
        : path_(std::move(path)),
          bytes_(read_bytes(path_)),
          reader_(path_, std::string_view(bytes_).substr(std::min(mark.size(), bytes_.size()))) {
        if (!bytes_.starts_with(mark)) reader_.fail();
        if (reader_.take_count() != plan) {
            throw IoError(path_.string() +
                          ": belongs to another plan; remove it, and make it again");
        }
    }
    MarkedFile(const MarkedFile&) = delete;
    MarkedFile& operator=(const MarkedFile&) = delete;
    ~MarkedFile() = default;

    ByteReader& reader() { return reader_; }

private:
    fs::path path_;
    std::string bytes_;
    ByteReader reader_;
};

void append_position(std::string& bytes, const Vec3& position) {
    for (const double x : position) append(bytes, x);
}

template <typename Items, typename Append>
void append_items(std::string& bytes, const Items& items, const Append& append_item) {
    append(bytes, static_cast<std::uint64_t>(items.size()));
    for (const auto& item : items) append_item(item);
}

std::string marked(std::string_view mark, std::uint64_t plan) {
    std::string bytes(mark);
    append(bytes, plan);
    return bytes;
}

}  // namespace

fs::path plan_path(const fs::path& folder) { return folder / "plan.json"; }
fs::path tile_path(const fs::path& folder, Index tile) { return numbered(folder, tile, ".tile"); }
fs::path mesh_path(const fs::path& folder, Index tile) { return numbered(folder, tile, ".mesh"); }

std::int64_t euler_of(const Topology& topology) {
    std::int64_t sum = 0;
    for (const ComponentTopology& component : topology.components) sum += component.euler;
    return sum;
}

std::uint64_t identity_of(const TilePlan& plan) {
    std::uint64_t sum = plan_version;
    const auto add = [&](std::uint64_t value) { sum = mix_bits(sum ^ value); };
    for (const std::uint64_t value :
         {plan.input_bytes, plan.num_faces, std::bit_cast<std::uint64_t>(plan.area),
          std::bit_cast<std::uint64_t>(plan.spacing), std::uint64_t{plan.num_samples},
          std::uint64_t{plan.samples_per_tile}, plan.seed,
          static_cast<std::uint64_t>(plan.relax_steps)}) {
        add(value);
    }
    return sum;
}

void write_tile_plan(const fs::path& folder, const TilePlan& plan) {
    const nlohmann::ordered_json json{{"version", plan_version},
                                      {"input", plan.input},
                                      {"input_bytes", plan.input_bytes},
                                      {"faces", plan.num_faces},
                                      {"area", plan.area},
                                      {"spacing", plan.spacing},
                                      {"samples", plan.num_samples},
                                      {"samples_per_tile", plan.samples_per_tile},
                                      {"seed", plan.seed},
                                      {"relax_steps", plan.relax_steps},
                                      {"border_sites", plan.num_sites},
                                      {"border_euler", plan.border_euler},
                                      {"crease_length", plan.crease_length},
                                      {"vertices", plan.num_vertices}};
    write_file_atomically(plan_path(folder), json.dump(1) + "\n");
}

TilePlan read_tile_plan(const fs::path& folder) {
    const fs::path path = plan_path(folder);
    if (!fs::exists(path)) {
        throw IoError(path.string() + ": is not there; split a file into this folder first");
    }
    TilePlan plan;
    try {
        const auto json = nlohmann::json::parse(read_bytes(path));
        if (json.at("version") != plan_version) {
            throw IoError(path.string() + ": is of another version; split the file again");
        }
        json.at("input").get_to(plan.input);
        json.at("input_bytes").get_to(plan.input_bytes);
        json.at("faces").get_to(plan.num_faces);
        json.at("area").get_to(plan.area);
        json.at("spacing").get_to(plan.spacing);
        json.at("samples").get_to(plan.num_samples);
        json.at("samples_per_tile").get_to(plan.samples_per_tile);
        json.at("seed").get_to(plan.seed);
        json.at("relax_steps").get_to(plan.relax_steps);
        json.at("border_sites").get_to(plan.num_sites);
        json.at("border_euler").get_to(plan.border_euler);
        plan.crease_length = json.value("crease_length", 0.0);
        json.at("vertices").get_to(plan.num_vertices);
    } catch (const nlohmann::json::exception&) {
        throw IoError(path.string() + ": is damaged; remove it, and split the file again");
    }
    return plan;
}

void append_mesh(std::string& bytes, const MeshView& mesh) {
    append_items(bytes, mesh.positions, [&](const Vec3& p) { append_position(bytes, p); });
    append_items(bytes, mesh.triangles, [&](const Triangle& t) {
        for (const Index v : t) append(bytes, v);
    });
}

void write_tile(const fs::path& folder, Index number, const TileFile& tile) {
    std::string bytes = marked(tile_mark, tile.plan);
    append(bytes, tile.num_vertices);
    append_mesh(bytes, tile.mesh.view());
    append_items(bytes, tile.border,
                 [&](const auto& edge) { append_all(bytes, edge[0], edge[1]); });
    append_items(bytes, tile.sites, [&](const TileSite& site) {
        append_all(bytes, site.edge, site.share, site.number);
    });
    write_file_atomically(tile_path(folder, number), bytes);
}

void write_tile_mesh(const fs::path& folder, Index number, const TileMeshFile& mesh) {
    std::string bytes = marked(mesh_mark, mesh.plan);
    append(bytes, static_cast<std::uint64_t>(mesh.euler));
    append_mesh(bytes, mesh.mesh.view());
    append_items(bytes, mesh.foot, [&](const Vec3& p) { append_position(bytes, p); });
    append_items(bytes, mesh.border_site, [&](Index site) { append(bytes, site); });
    append_mesh(bytes, mesh.strip.view());
    append_items(bytes, mesh.near, [&](Index v) { append(bytes, v); });
    append_items(bytes, mesh.points, [&](const SurfacePoint& point) {
        append(bytes, point.face.value());
        for (const double weight : point.barycentric) append(bytes, weight);
    });
    write_file_atomically(mesh_path(folder, number), bytes);
}

TileFile read_tile(const fs::path& folder, Index number, std::uint64_t plan) {
    MarkedFile file(tile_path(folder, number), tile_mark, plan);
    ByteReader& reader = file.reader();
    TileFile tile{.plan = plan, .num_vertices = reader.take_index()};
    tile.mesh = reader.take_mesh();
    tile.border = reader.take_all([&] {
        const Index from = reader.take_index(), to = reader.take_index();
        return std::array{from, to};
    });
    tile.sites = reader.take_all([&] {
        TileSite site{};
        site.edge = reader.take_index();
        site.share = reader.take_real();
        site.number = reader.take_index();
        return site;
    });
    const auto is_vertex = [&](Index v) { return v < tile.mesh.positions.size(); };
    const bool is_whole =
        std::ranges::all_of(tile.border,
                            [&](const auto& e) { return is_vertex(e[0]) && is_vertex(e[1]); }) &&
        std::ranges::all_of(tile.sites,
                            [&](const TileSite& s) { return s.edge < tile.border.size(); });
    if (!is_whole || !reader.is_at_end()) reader.fail();
    return tile;
}

TileMeshFile read_tile_mesh(const fs::path& folder, Index number, std::uint64_t plan) {
    MarkedFile file(mesh_path(folder, number), mesh_mark, plan);
    ByteReader& reader = file.reader();
    TileMeshFile mesh{.plan = plan, .euler = static_cast<std::int64_t>(reader.take_count())};
    mesh.mesh = reader.take_mesh();
    mesh.foot = reader.take_all([&] { return reader.take_position(); });
    mesh.border_site = reader.take_all([&] { return reader.take_index(); });
    mesh.strip = reader.take_mesh();
    mesh.near = reader.take_all([&] { return reader.take_index(); });
    mesh.points = reader.take_all([&] {
        SurfacePoint point{FaceId(reader.take_index()), {}};
        for (double& weight : point.barycentric) weight = reader.take_real();
        return point;
    });
    const std::size_t num_vertices = mesh.mesh.positions.size();
    const bool is_whole =
        mesh.foot.size() == num_vertices && mesh.border_site.size() == num_vertices &&
        mesh.near.size() == mesh.points.size() &&
        std::ranges::all_of(mesh.near, [&](Index v) { return v < num_vertices; }) &&
        std::ranges::all_of(mesh.points, [&](const SurfacePoint& p) {
            return p.face.value() < mesh.strip.triangles.size();
        });
    if (!is_whole || !reader.is_at_end()) reader.fail();
    return mesh;
}

void ByteReader::fail() const {
    throw IoError(path_.string() + ": is damaged; remove it, and make it again");
}

template <typename T>
T ByteReader::take() {
    require(sizeof(T));
    const T value = load<T>(left_.data());
    left_.remove_prefix(sizeof(T));
    return value;
}

std::uint64_t ByteReader::take_count() { return take<std::uint64_t>(); }
Index ByteReader::take_index() { return take<Index>(); }
double ByteReader::take_real() { return take<double>(); }

Vec3 ByteReader::take_position() {
    Vec3 position;
    for (double& x : position) x = take<double>();
    return position;
}

TriangleMesh ByteReader::take_mesh() {
    TriangleMesh mesh;
    mesh.positions = take_all([&] { return take_position(); });
    mesh.triangles = take_all([&] {
        Triangle t{};
        for (Index& v : t) v = take_index();
        return t;
    });
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            if (v >= mesh.positions.size()) fail();
        }
    }
    return mesh;
}

}  // namespace remesh
