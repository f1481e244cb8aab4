#include <sys/stat.h>

#include "system/same_place.h"

namespace cli {

std::string place_of(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    struct stat file {};
    if (::stat(path.c_str(), &file) == 0) {
        return std::to_string(file.st_dev) + ' ' + std::to_string(file.st_ino);
    }
    return fs::weakly_canonical(fs::absolute(path)).string();
}

}  // namespace cli
