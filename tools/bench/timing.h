//! \file
//! Times of a job, and statistics over several repetitions.
#pragma once

#include <functional>
#include <vector>

namespace bench {

//! Seconds of the wall clock, and of all cores together: the latter stays fair on a busy machine.
struct Seconds {
    double wall = 0;
    double cpu = 0;
};
[[nodiscard]] Seconds time(const std::function<void()>& job);

//! The least value.
//! \pre not empty.
[[nodiscard]] double quickest(const std::vector<double>& values);

//! The middle value, or the mean of the middle two.
//! \pre not empty.
[[nodiscard]] double median(std::vector<double> values);

//! Largest minus smallest over the median.
//! \pre not empty.
[[nodiscard]] double spread(const std::vector<double>& values);

}  // namespace bench
