#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "system/memory.h"

namespace cli {

std::size_t machine_memory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    std::size_t bytes = pages > 0 ? static_cast<std::size_t>(pages) * page : 0;
    std::size_t allowed = 0;
    // Otherwise "max", or no such file.
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> allowed) {
        bytes = bytes == 0 ? allowed : std::min(bytes, allowed);
    }
    return bytes;
}

std::size_t resident_memory() {
    std::size_t total = 0, resident = 0;
    if (!(std::ifstream("/proc/self/statm") >> total >> resident)) return 0;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

std::size_t peak_memory() {
    rusage usage{};
    constexpr std::size_t unit = 1024;
    if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return static_cast<std::size_t>(usage.ru_maxrss) * unit;
}

void tune_heap() {
    // NOLINTBEGIN(concurrency-mt-unsafe): no other thread runs yet. Each large array is returned to
    // the system at once. By default larger and larger ones are kept, in gaps too small for the
    // next: a tenth more memory at 1.4 M faces.
    ::mallopt(M_MMAP_THRESHOLD, 1 << 22);
    // The heap grows by large pages (large_pages.cpp); free memory at its end is kept until the
    // stage is over.
    ::mallopt(M_TOP_PAD, 1 << 25);
    ::mallopt(M_TRIM_THRESHOLD, 1 << 26);
    // NOLINTEND(concurrency-mt-unsafe)
}

void return_free_memory(std::size_t more_than) {
    if (::mallinfo2().fordblks > more_than) ::malloc_trim(0);
}

}  // namespace cli
