// Each argument is brought near 0 first, where a few terms of the Taylor series are enough.
#include "agvd/core/portable_math.h"

#include <cmath>
#include <numbers>

#include "agvd/core/types.h"

namespace agvd::portable {
namespace {

// The logarithm of 2 as a sum. Multiples of the first part up to 2^20 are exact.
constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;

// t + z t / 3 + z^2 t / 5 + ...: the arc tangent of t for z = -t^2, the inverse hyperbolic tangent
// for z = t^2. For |t| <= 0.2 what is left out is below 1e-18 t.
double odd_series(double t, double z) {
    double sum = 0;
    for (int k = 25; k > 1; k -= 2) sum = z * (sum + 1.0 / k);
    return t + t * sum;
}

}  // namespace

double atan2(double y, double x) {
    const double across = std::abs(y), along = std::abs(x);
    const bool is_steep = across > along;
    const double low = is_steep ? along : across, high = is_steep ? across : along;
    // Equal ones, also two zeros or two infinities, are not divided.
    const double ratio = low == high ? (high > 0 ? 1 : 0) : low / high;
    // The nearest multiple of pi / 8 and its tangent.
    double base = 0, tangent = 0;
    if (ratio > 0.66817863791929891) {  // tan(3 pi / 16)
        base = std::numbers::pi / 4;
        tangent = 1;
    } else if (ratio > 0.19891236737965801) {  // tan(pi / 16)
        base = std::numbers::pi / 8;
        tangent = std::numbers::sqrt2 - 1;
    }
    const double t = (ratio - tangent) / (1 + ratio * tangent);
    double angle = base + odd_series(t, -t * t);
    if (is_steep) angle = std::numbers::pi / 2 - angle;
    if (std::signbit(x)) angle = std::numbers::pi - angle;
    return std::copysign(angle, y);
}

double log(double x) {
    if (!(x > 0 && x < infinity)) return x == 0 ? -infinity : x < 0 ? std::nan("") : x;
    // x = part * 2^power with part between the root of 1/2 and that of 2.
    int power = 0;
    double part = std::frexp(x, &power);
    if (part < std::numbers::sqrt2 / 2) {
        part *= 2;
        --power;
    }
    const double t = (part - 1) / (part + 1);
    return power * ln2_high + (power * ln2_low + 2 * odd_series(t, t * t));
}

double exp(double x) {
    if (!(std::abs(x) < 1000)) return x < 0 ? 0 : x * infinity;
    // x = power * ln 2 + rest with a rest of at most ln 2 / 2.
    const double power = std::round(x / std::numbers::ln2);
    const double rest = (x - power * ln2_high) - power * ln2_low;
    double sum = 0;
    for (int k = 15; k > 0; --k) sum = rest * (1.0 / k) * (1 + sum);
    return std::ldexp(1 + sum, static_cast<int>(power));
}

double pow(double base, double exponent) { return exp(exponent * log(base)); }

}  // namespace agvd::portable
