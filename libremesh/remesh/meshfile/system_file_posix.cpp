#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "remesh/meshfile/system_file.h"

namespace remesh {

int open_to_read(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

int open_to_write(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
}

int open_new(const std::filesystem::path& path) {
    return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
}

bool is_writable(const std::filesystem::path& path) { return ::access(path.c_str(), W_OK) == 0; }

bool take_permissions(int fd, const std::filesystem::path& old) {
    struct stat status {};
    if (::stat(old.c_str(), &status) != 0) return false;
    // Owner first: changing it clears the set-user bit. Only root may, so a failure is no error.
    if (::fchown(fd, status.st_uid, status.st_gid) != 0) errno = 0;
    return ::fchmod(fd, status.st_mode & 07777) == 0;
}

bool wait_to_read(int fd) {
    constexpr int milliseconds = 20;
    struct pollfd waiting {
        fd, POLLIN, 0
    };
    return ::poll(&waiting, 1, milliseconds) != 0;
}

}  // namespace remesh
