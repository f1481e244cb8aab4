#include <windows.h>

#include <psapi.h>

#include "system/memory.h"

namespace cli {
namespace {

PROCESS_MEMORY_COUNTERS counters() {
    PROCESS_MEMORY_COUNTERS result{};
    ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &result, sizeof result);
    return result;
}

}  // namespace

std::size_t machine_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return ::GlobalMemoryStatusEx(&status) ? static_cast<std::size_t>(status.ullTotalPhys) : 0;
}

std::size_t resident_memory() { return counters().WorkingSetSize; }

std::size_t peak_memory() { return counters().PeakWorkingSetSize; }

// The heap of Windows returns large arrays by itself.
void tune_heap() {}

void return_free_memory(std::size_t) {}

}  // namespace cli
