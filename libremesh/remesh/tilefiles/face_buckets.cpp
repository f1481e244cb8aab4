#include "remesh/tilefiles/face_buckets.h"

#include <fstream>
#include <system_error>

#include "agvd/core/error.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {
namespace {

namespace fs = std::filesystem;

// Faces in memory, of one bucket and of all: some 80 bytes each.
constexpr std::size_t most_waiting = 1 << 15, most_waiting_in_all = 1 << 22;

}  // namespace

FaceBuckets::FaceBuckets(fs::path folder, Index count)
    : folder_(std::move(folder)), waiting_(count) {
    for (Index bucket = 0; bucket < count; ++bucket) fs::remove(path(bucket));
}

FaceBuckets::~FaceBuckets() {
    std::error_code none;
    for (Index bucket = 0; bucket < size(); ++bucket) fs::remove(path(bucket), none);
}

fs::path FaceBuckets::path(Index bucket) const {
    return folder_ / ("faces-" + std::to_string(bucket) + ".tmp");
}

void FaceBuckets::add(Index bucket, const std::array<Vec3, 3>& corners) {
    waiting_[bucket].add(corners);
    ++num_waiting_;
    if (waiting_[bucket].size() >= most_waiting) flush(bucket);
    if (num_waiting_ >= most_waiting_in_all) flush();
}

void FaceBuckets::flush() {
    for (Index bucket = 0; bucket < size(); ++bucket) flush(bucket);
}

void FaceBuckets::flush(Index bucket) {
    if (waiting_[bucket].size() == 0) return;
    num_waiting_ -= waiting_[bucket].size();
    std::string bytes;
    append_mesh(bytes, waiting_[bucket].take().view());
    std::ofstream file(path(bucket), std::ios::binary | std::ios::app);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) {
        throw IoError(path(bucket).string() +
                      ": cannot be written; free some space, or name another folder");
    }
}

TriangleMesh FaceBuckets::read(Index bucket) const {
    const fs::path name = path(bucket);
    if (!fs::exists(name)) return {};
    const Progress none;
    Poller poller(none);
    const std::string bytes = load_file(name, poller).bytes;
    ByteReader reader(name, bytes);
    TriangleMesh first = reader.take_mesh();
    if (reader.is_at_end()) return first;
    WeldedFaces faces;
    const auto add = [&](const TriangleMesh& mesh) {
        for (Index f = 0; f < mesh.triangles.size(); ++f) faces.add(corners_of(mesh.view(), f));
    };
    add(first);
    first = {};
    while (!reader.is_at_end()) add(reader.take_mesh());
    return faces.take();
}

void FaceBuckets::replace(Index bucket, const MeshView& mesh) {
    std::string bytes;
    append_mesh(bytes, mesh);
    write_file_atomically(path(bucket), bytes);
}

}  // namespace remesh
