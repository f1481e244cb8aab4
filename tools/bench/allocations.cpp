#include "bench/allocations.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

// The counts of operator new can only be kept in globals.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<std::size_t> current{0};
std::atomic<std::size_t> peak{0};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void* counted(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    const std::size_t size = malloc_usable_size(memory);
    const std::size_t now = current.fetch_add(size, std::memory_order_relaxed) + size;
    std::size_t highest = peak.load(std::memory_order_relaxed);
    while (now > highest && !peak.compare_exchange_weak(highest, now, std::memory_order_relaxed)) {
    }
    return memory;
}

void release(void* memory) {
    if (memory == nullptr) return;
    current.fetch_sub(malloc_usable_size(memory), std::memory_order_relaxed);
    std::free(memory);
}

}  // namespace

// The forms for arrays end in these. Those that do not throw would, too, but not under a sanitizer.
void* operator new(std::size_t size) { return counted(std::malloc(size == 0 ? 1 : size)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto align = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace bench {

PeakBytes::PeakBytes() : before_(current.load()) { peak = before_; }

std::size_t PeakBytes::bytes() const { return peak.load() - before_; }

}  // namespace bench
