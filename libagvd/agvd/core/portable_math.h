//! \file
//! Functions of <cmath> whose last bits depend on the C library, here the same everywhere: they use
//! only + - * /, comparisons, and functions of <cmath> that are exact. Held by PortableMath in
//! tests/agvd/core.
#pragma once

namespace agvd::portable {

// Relative errors stay below 1e-15, but where it is said.

//! The angle of (x, y) in [-pi, pi].
[[nodiscard]] double atan2(double y, double x);
//! The natural logarithm: -infinity of 0, NaN of negative numbers.
[[nodiscard]] double log(double x);
//! e^x.
[[nodiscard]] double exp(double x);
//! base^exponent for a base above 0, or 0 if the exponent is above 0.
//! The relative error is below 1e-15 times the larger of 1 and the logarithm of the result.
[[nodiscard]] double pow(double base, double exponent);

}  // namespace agvd::portable
