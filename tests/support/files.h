//! \file
//! Files for tests: a folder of their own, and the real meshes if present.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace files {

//! A new folder that is removed with the object, including its content.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "remesh-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code none;
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all, none);
        std::filesystem::remove_all(path_, none);
    }

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }
    [[nodiscard]] std::size_t num_entries() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline void write(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

[[nodiscard]] inline std::string read(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

//! "data/NAME": a mesh of the project. Any other name: a real mesh of the folder in AGVD_MESHES, or
//! of the default one. It may not exist: tests then skip, and say so.
[[nodiscard]] inline std::filesystem::path find_mesh(const std::string& name) {
    constexpr std::string_view ours = "data/";
    if (name.starts_with(ours)) {
        return std::filesystem::path(AGVD_DATA_DIR) / name.substr(ours.size());
    }
    const char* const folder = std::getenv("AGVD_MESHES");
    return std::filesystem::path(folder != nullptr ? folder : AGVD_MESHES_DEFAULT) / name;
}

}  // namespace files
