#include "remesh/meshfile/atomic_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <system_error>
#include <utility>

#include "remesh/meshfile/source_file.h"
#include "remesh/meshfile/system_file.h"

namespace remesh {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int reason, const char* remedy) {
    throw IoError(joined(path.string(), ": cannot be written: ",
                         std::generic_category().message(reason), "; ", remedy));
}

constexpr const char* check_folder =
    "check that its folder exists and is writable, or write to another file";

// The end of a chain of symbolic links, whether or not it exists.
fs::path follow_links(const fs::path& path) {
    fs::path target = path;
    std::error_code none;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, none)); ++links) {
        if (links == 40) fail(path, ELOOP, "correct the symbolic links");
        target = target.parent_path() / fs::read_symlink(target, none);
    }
    return target;
}

void write_all(int fd, std::string_view bytes, const fs::path& path, const Progress& progress) {
    constexpr std::size_t most = 1 << 22;  // Some milliseconds.
    while (!bytes.empty()) {
        poll(progress, 0);
        const auto num = static_cast<unsigned>(std::min(most, bytes.size()));
        const ssize_t written = ::write(fd, bytes.data(), num);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            fail(path, errno,
                 errno == EPIPE ? "check the program that reads from it, or write to a file"
                                : "free some space, or write to another file");
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

// The file that becomes the target. Its destructor closes and removes it unless it was renamed.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        std::error_code none;
        const fs::file_status old = fs::status(target, none);
        if (fs::is_directory(old)) fail(target, EISDIR, "name a file in this folder");
        if (fs::exists(old) && !is_writable(target)) {
            fail(target, errno, "make the old file writable, or write to another file");
        }
        const std::string stem = ".remesh-" + std::to_string(::getpid()) + "-";
        for (int n = 0; fd_ < 0; ++n) {
            // A name of our own, not the target's with a suffix, which might be too long.
            name_ = target.parent_path() / (stem + std::to_string(n) + ".tmp");
            fd_ = open_new(name_);
            if (fd_ < 0 && errno != EEXIST) fail(target, errno, check_folder);
        }
        if (!fs::exists(old) || take_permissions(fd_, target)) return;
        const int reason = errno;
        discard();
        fail(target, reason, "write to another file");
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { discard(); }

    void write(std::string_view bytes, const Progress& progress) const {
        write_all(fd_, bytes, target_, progress);
    }

    // Some file systems report only on closing that they are full.
    void close() {
        if (fd_ < 0) return;
        const int fd = std::exchange(fd_, -1);
        if (::close(fd) != 0 && errno != EINTR)
            fail(target_, errno, "free some space, or write to another file");
    }

    void rename_to_target() {
        close();
        std::error_code failure;
        fs::rename(name_, target_, failure);
        if (failure) fail(target_, failure.value(), check_folder);
        name_.clear();
    }

private:
    void discard() {
        if (fd_ >= 0) ::close(fd_);
        std::error_code none;
        if (!name_.empty()) fs::remove(name_, none);
    }

    fs::path target_;
    fs::path name_;  // Empty once renamed.
    int fd_ = -1;
};

// True for a device or a pipe, also behind links, and for the standard output, even if that is a
// file: none of them must be replaced by a file of the same name. A pipe of the shell, such as
// /dev/fd/63, is a link to a name that no file has, so links are not followed before this.
bool is_special(const fs::path& target) {
    if (is_standard_output(target)) return true;
    std::error_code none;
    const fs::file_status status = fs::status(target, none);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write_directly(const fs::path& target, std::string_view bytes, const Progress& progress) {
    if (is_standard_output(target)) return write_all(STDOUT_FILENO, bytes, target, progress);
    const int fd = open_to_write(target);
    if (fd < 0) fail(target, errno, "check its permissions, or write to another file");
    try {
        write_all(fd, bytes, target, progress);
    } catch (...) {
        ::close(fd);
        throw;
    }
    ::close(fd);
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view bytes, const Progress& progress) {
    if (is_special(path)) return write_directly(path, bytes, progress);
    TemporaryFile file(follow_links(path));
    file.write(bytes, progress);
    poll(progress, 1);
    file.rename_to_target();
}

void write_files_atomically(std::span<const FileContent> files, const Progress& progress) {
    std::deque<TemporaryFile> temporaries;  // A deque: the objects must not move.
    for (const FileContent& file : files) {
        if (is_special(file.path)) continue;
        temporaries.emplace_back(follow_links(file.path)).write(file.bytes, progress);
    }
    for (const FileContent& file : files) {
        if (is_special(file.path)) write_directly(file.path, file.bytes, progress);
    }
    poll(progress, 1);
    for (TemporaryFile& temporary : temporaries) temporary.close();
    for (TemporaryFile& temporary : temporaries) temporary.rename_to_target();
}

void require_writable(const fs::path& path) {
    struct stat status {};
    if (is_standard_output(path) && ::fstat(STDOUT_FILENO, &status) != 0) {
        fail(path, errno, "open the standard output, or write to a file");
    }
    if (!is_special(path)) TemporaryFile file(follow_links(path));
}

}  // namespace remesh
