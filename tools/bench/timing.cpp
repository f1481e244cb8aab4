#include "bench/timing.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace bench {

Seconds time(const std::function<void()>& job) {
    const auto wall = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    job();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - wall;
    return {taken.count(), static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

double quickest(const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double spread(const std::vector<double>& values) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return (*most - *least) / median(values);
}

}  // namespace bench
