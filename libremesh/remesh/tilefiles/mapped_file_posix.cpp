#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "remesh/tilefiles/mapped_file.h"

namespace remesh {

int MappedFile::map(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return errno;
    struct stat status {};
    int reason = 0;
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
        size_ = static_cast<std::size_t>(status.st_size);
        void* const data = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0);
        reason = errno;
        if (data != MAP_FAILED) data_ = data;
    }
    ::close(file);
    return reason;
}

MappedFile::~MappedFile() { ::munmap(data_, size_); }

}  // namespace remesh
