// Any allocation may fail. The call then throws std::bad_alloc and has changed nothing; the next
// call gives what it always gives. The build with sanitizers sees leaks.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <new>
#include <optional>

#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "support/points.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

// Operators new know nothing else. All calls below run on one thread.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
bool is_counting = false;
std::size_t num_allocations = 0;
std::size_t failing_allocation = 0;  // Counted from 0.
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

bool fails_now() { return is_counting && num_allocations++ == failing_allocation; }

// Not inline: gcc would see std::free for what it takes for another operator new.
[[gnu::noinline]] void release(void* memory) { std::free(memory); }

void* checked(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

// The forms for arrays end in these.
void* operator new(std::size_t size) {
    return checked(fails_now() ? nullptr : std::malloc(size == 0 ? 1 : size));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return fails_now() ? nullptr : std::malloc(size == 0 ? 1 : size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto align = static_cast<std::size_t>(alignment);
    return checked(fails_now() ? nullptr
                               : std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace {

using agvd::TriangleMesh;

bool operator==(const TriangleMesh& a, const TriangleMesh& b) {
    return a.positions == b.positions && a.triangles == b.triangles;
}

// Runs `call` with a counter on.
// \return the number of its allocations.
std::size_t count(std::size_t failing, const std::function<void()>& call) {
    struct Counting {
        Counting() { is_counting = true; }
        Counting(const Counting&) = delete;
        Counting& operator=(const Counting&) = delete;
        ~Counting() { is_counting = false; }
    };
    num_allocations = 0;
    failing_allocation = failing;
    const Counting counting;
    call();
    return num_allocations;
}

// Lets allocations of make() fail, one in each call: all of them, or some 2000 evenly chosen ones.
template <typename Result>
void expect_each_may_fail(const std::function<Result()>& make,
                          const std::function<void(const Result&)>& expect_same,
                          const std::function<void()>& after_failure = {}) {
    constexpr std::size_t none = ~std::size_t{0}, most_calls = 2000;
    std::optional<Result> first;
    const std::size_t all = count(none, [&] { first = make(); });
    expect_same(*first);
    const std::size_t step = all / most_calls + 1;
    std::size_t num_failed = 0, num_calls = 0;
    for (std::size_t failing = 0; failing < all; failing += step) {
        ++num_calls;
        try {
            // std::stable_sort does without its buffer, so that some calls succeed.
            std::optional<Result> result;
            count(failing, [&] { result = make(); });
            expect_same(*result);
        } catch (const std::bad_alloc&) {
            ++num_failed;
            if (after_failure) after_failure();
        }
    }
    EXPECT_GE(num_calls, std::min<std::size_t>(all, most_calls / 2));
    EXPECT_GE(num_failed, num_calls * 9 / 10);
    expect_same(make());
}

class FailingAllocations : public Scratch {};

}  // namespace

TEST_F(FailingAllocations, OfARemeshThrow) {
    const TriangleMesh mesh = shapes::join(shapes::subdivide(shapes::cube()), shapes::grid(3));
    const TriangleMesh before = mesh;
    const remesh::RemeshOptions options{.num_samples = 40, .relax_steps = 3, .num_threads = 1};
    const TriangleMesh expected = remesh::remesh(mesh.view(), options).mesh;
    expect_each_may_fail<TriangleMesh>(
        [&] { return remesh::remesh(mesh.view(), options).mesh; },
        [&](const TriangleMesh& result) { EXPECT_TRUE(result == expected); });
    EXPECT_TRUE(mesh == before);
}

TEST_F(FailingAllocations, OfADiagramThrow) {
    const TriangleMesh mesh = shapes::jitter(shapes::torus(8, 6), 0.05, 1);
    const agvd::Surface input = agvd::build_surface(mesh.view());
    for (const agvd::Engine engine : {agvd::Engine::Window, agvd::Engine::Steiner}) {
        const auto make = [&] {
            const agvd::IntrinsicTriangulation base(input);
            const auto sites = points::scattered(base.surface(), 7, 3);
            const auto propagation =
                propagate(base.surface(), sites, {.engine = engine, .num_threads = 1});
            return build_diagram(base.surface(), sites, propagation, {.num_threads = 1}).cell_area;
        };
        const std::vector<double> expected = make();
        expect_each_may_fail<std::vector<double>>(
            make, [&](const std::vector<double>& area) { EXPECT_EQ(area, expected); });
    }
}

TEST_F(FailingAllocations, OfReadingAndWritingLeaveTheOldFile) {
    const TriangleMesh mesh = shapes::sphere(1), old = shapes::cube();
    for (const char* name : {"mesh.ply", "mesh.obj", "mesh.off", "mesh.stl"}) {
        SCOPED_TRACE(name);
        const auto path = std::filesystem::path(at(name)),
                   other = std::filesystem::path(at(std::string("b-") + name));
        remesh::write_mesh(path, mesh.view());
        const TriangleMesh expected = remesh::read_mesh(path).mesh;
        expect_each_may_fail<TriangleMesh>(
            [&] { return remesh::read_mesh(path).mesh; },
            [&](const TriangleMesh& result) { EXPECT_TRUE(result == expected); });

        remesh::write_mesh(other, old.view());
        const TriangleMesh before = remesh::read_mesh(other).mesh;
        expect_each_may_fail<bool>(
            [&] {
                remesh::write_mesh(other, mesh.view());
                return true;
            },
            [&](bool) {
                EXPECT_TRUE(remesh::read_mesh(other).mesh == expected);
                remesh::write_mesh(other, old.view());
            },
            [&] { EXPECT_TRUE(remesh::read_mesh(other).mesh == before); });
    }
    EXPECT_EQ(num_files(), 8u);
}
