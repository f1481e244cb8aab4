// The C++ side of tests/python/overhead.py: for each line on standard input it remeshes the mesh to
// that many vertices, finds the vertices' places on the input and writes the report, as the module
// does, and prints the seconds: of the clock, of all cores, and of the clock for remesh::remesh()
// alone.
#include <chrono>
#include <ctime>
#include <iostream>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/transfer/transfer.h"
#include "report/report.h"

int main(int argc, char** argv) {
    try {
        if (argc != 2) throw agvd::InvalidOption("usage: remesh_python_baseline MESH");
        const remesh::MeshFile input = remesh::read_mesh(argv[1]);
        for (agvd::Index num_samples = 0; std::cin >> num_samples;) {
            const remesh::RemeshOptions options{.num_samples = num_samples};
            const std::clock_t cpu_start = std::clock();
            const auto start = std::chrono::steady_clock::now();
            const auto seconds = [&] {
                const std::chrono::duration<double> d = std::chrono::steady_clock::now() - start;
                return d.count();
            };
            const remesh::RemeshResult result = remesh::remesh(input.mesh.view(), options);
            const double of_remesh = seconds();
            const remesh::InputMap map =
                remesh::map_to_input(input.mesh.view(), result.mesh.view(), result.sites);
            const std::string report = remesh::to_json(result, {.options = options});
            const double of_clock = seconds();
            const double of_cores = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
            if (map.vertices.size() != num_samples || report.empty()) return 1;
            std::cout << of_clock << ' ' << of_cores << ' ' << of_remesh << std::endl;
        }
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
    return 0;
}
