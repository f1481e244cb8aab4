// make_variants: writes dirty meshes, named by number, origin and damage
// (017_bunny_holes_flips.ply), for scripts/corpus. Each has one to three kinds of damage; the first
// ones take turns.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli.h"
#include "make_data/data_files.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/damages.h"
#include "support/delta_shapes.h"
#include "support/junction_shapes.h"
#include "support/random_meshes.h"
#include "support/random_surfaces.h"

namespace fs = std::filesystem;

namespace {

using agvd::Index;
using agvd::TriangleMesh;

constexpr std::size_t most_faces = 150'000;  // Of a mesh to damage: some damage doubles it.

struct Base {
    std::string name;
    TriangleMesh mesh;
};

std::vector<Base> data_meshes() {
    std::vector<Base> bases;
    for (const make_data::DataFile& file : make_data::data_files()) {
        bases.push_back({fs::path(file.name).stem().string(), file.make()});
    }
    return bases;
}

std::vector<Base> read_all(const std::vector<fs::path>& paths) {
    std::vector<Base> bases;
    for (const fs::path& path : paths) {
        TriangleMesh mesh = remesh::read_mesh(path).mesh;
        if (mesh.triangles.size() > most_faces) continue;
        bases.push_back({path.stem().string(), std::move(mesh)});
    }
    return bases;
}

Base any_shape(Dice& dice) {
    const auto any_of = [&](std::span<const char* const> names) {
        return names[dice.count(0, static_cast<Index>(names.size()) - 1)];
    };
    const std::uint64_t seed = dice.count(0, 1'000'000);
    switch (dice.count(0, 3)) {
        case 0: {
            const char* const family = any_of(random_meshes::families());
            return {family, random_meshes::make(family, seed)};
        }
        case 1: {
            const char* const family = any_of(delta_shapes::families());
            return {family, delta_shapes::make(family, seed)};
        }
        case 2: {
            const char* const family = any_of(random_surfaces::families());
            return {family, random_surfaces::make(family, seed)};
        }
        default: {
            const auto junctions = shapes::straight_junctions();
            const auto& shape = junctions[dice.count(0, static_cast<Index>(junctions.size()) - 1)];
            return {shape.name, shape.mesh};
        }
    }
}

// `first` and up to two others, in any order.
std::vector<std::string> any_kinds(const char* first, Dice& dice) {
    const auto kinds = damages::kinds();
    std::vector<std::string> chosen{first};
    for (Index more = dice.count(0, 2); more > 0; --more) {
        const std::string kind = kinds[dice.count(0, static_cast<Index>(kinds.size()) - 1)];
        if (std::find(chosen.begin(), chosen.end(), kind) == chosen.end()) chosen.push_back(kind);
    }
    std::swap(chosen.front(), chosen[dice.count(0, static_cast<Index>(chosen.size()) - 1)]);
    return chosen;
}

// STL holds floats: too short for slivers, and for spikes of the largest meshes.
const char* any_extension(const TriangleMesh& mesh, const std::vector<std::string>& kinds,
                          Dice& dice) {
    const Index drawn = dice.count(0, 2);
    double largest = 0;
    for (const agvd::Vec3& p : mesh.positions) {
        largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
    }
    const bool needs_doubles =
        largest > 1e30 || std::find(kinds.begin(), kinds.end(), "slivers") != kinds.end();
    if (drawn == 0) return ".off";
    return drawn == 1 && !needs_doubles ? ".stl" : ".ply";
}

// An identifier: what is not a letter or a digit is part of no name.
std::string plain(std::string name) {
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
    }
    return name;
}

struct Arguments {
    fs::path folder;
    Index count = 0;
    std::uint64_t seed = 0;
    std::vector<fs::path> meshes;
};

void make_variants(const Arguments& arguments) {
    fs::create_directories(arguments.folder);
    const std::vector<Base> own = data_meshes(), given = read_all(arguments.meshes);
    for (Index i = 0; i < arguments.count; ++i) {
        cli::stop_if_interrupted();
        Dice dice(agvd::random_bits(arguments.seed, 0, i));
        const auto any_of = [&](const std::vector<Base>& bases) {
            return bases[dice.count(0, static_cast<Index>(bases.size()) - 1)];
        };
        Base base;
        if (!given.empty() && dice.one_in(3)) {
            base = any_of(given);
        } else {
            base = dice.one_in(2) ? any_of(own) : any_shape(dice);
        }
        const auto kinds = any_kinds(damages::kinds()[i % damages::kinds().size()], dice);
        std::string name = std::to_string(1000 + i).substr(1) + '_' + plain(base.name);
        for (const std::string& kind : kinds) {
            base.mesh = damages::apply(kind, std::move(base.mesh), dice);
            name += '_' + kind;
        }
        name += any_extension(base.mesh, kinds, dice);
        remesh::write_mesh(arguments.folder / name, base.mesh.view());
    }
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Writes dirty meshes for scripts/corpus; the same ones for the same seed.",
                 "make_variants");
    app.add_option("FOLDER", arguments.folder, "Folder to write to")->required();
    app.add_option("COUNT", arguments.count, "Number of meshes")
        ->required()
        ->check(CLI::Range(Index{1}, Index{1000}));
    app.add_option("SEED", arguments.seed, "Of all choices")->required();
    app.add_option("MESH", arguments.meshes,
                   "Meshes to damage besides the generated ones; larger ones than 150 000 faces "
                   "are skipped");
    return cli::run(app, argc, argv, [&] { make_variants(arguments); });
}
