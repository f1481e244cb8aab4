// Texts of floating-point numbers as libstdc++ writes them, and numbers of texts. The digits come
// from the engine that runs the module: JavaScript's own texts of numbers are the shortest, too.
#include <fast_float/fast_float.h>
#include <locale.h>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace std {  // NOLINT(cert-dcl58-cpp)
namespace {

to_chars_result print(char* first, char* last, const char* form, int precision, double value) {
    return {first + snprintf(first, static_cast<size_t>(last - first), form, precision, value), {}};
}

// 0.00123, 12.3: without an exponent. \param power  of ten, of the first digit.
char* write_fixed(char* to, const char* digits, int count, int power) {
    if (power < 0) {
        to = copy_n("0.", 2, to);
        to = fill_n(to, -power - 1, '0');
        return copy_n(digits, count, to);
    }
    to = copy_n(digits, power + 1, to);
    *to++ = '.';
    return copy_n(digits + power + 1, count - power - 1, to);
}

char* write_scientific(char* to, const char* digits, int count, int power) {
    *to++ = digits[0];
    if (count > 1) *to++ = '.';
    to = copy_n(digits + 1, count - 1, to);
    *to++ = 'e';
    *to++ = power < 0 ? '-' : '+';
    power = std::abs(power);
    if (power >= 100) *to++ = static_cast<char>('0' + power / 100);
    *to++ = static_cast<char>('0' + power / 10 % 10);
    *to++ = static_cast<char>('0' + power % 10);
    return to;
}

to_chars_result write_shortest(char* first, char* last, double value, int is_float) {
    if (!isfinite(value) || value == 0) return print(first, last, "%.*g", 6, value);
    if (signbit(value)) *first++ = '-';
    char digits[32];
    const int found = remesh_shortest_digits(fabs(value), is_float, digits);
    const int count = found & 31, power = found >> 5;
    // The power of the last digit decides, as in libstdc++.
    const int exponent = power - count + 1, single = count == 1 ? 1 : 0;
    if (exponent < single - count - 3 || exponent > 5 - single) {
        return {write_scientific(first, digits, count, power), {}};
    }
    if (exponent >= 0) return print(first, last, "%.*f", 0, fabs(value));
    return {write_fixed(first, digits, count, power), {}};
}

}  // namespace

to_chars_result to_chars(char* first, char* last, double value) {
    return write_shortest(first, last, value, 0);
}

to_chars_result to_chars(char* first, char* last, float value) {
    return write_shortest(first, last, value, 1);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format format,
                         int precision) {
    const char* const form = format == chars_format::fixed        ? "%.*f"
                             : format == chars_format::scientific ? "%.*e"
                                                                  : "%.*g";
    return print(first, last, form, precision, value);
}

template <>
weak_ordering weak_order(const double& a, const double& b) {
    const auto rank = [](double x) { return isnan(x) ? (signbit(x) ? -1 : 1) : 0; };
    if (rank(a) != rank(b)) return rank(a) <=> rank(b);
    return a < b ? weak_ordering::less : a > b ? weak_ordering::greater : weak_ordering::equivalent;
}

}  // namespace std

//! In place of those of the C library, which compute with 128 bits, by 12 kB of code.
extern "C" {
double strtod(const char* text, char** end) {
    double value = 0;
    const char* const last = text + std::strlen(text);
    *end = const_cast<char*>(fast_float::from_chars(text, last, value).ptr);
    return value;
}
float strtof(const char* text, char** end) { return static_cast<float>(strtod(text, end)); }
long double strtold(const char* text, char** end) { return strtod(text, end); }
double strtod_l(const char* text, char** end, locale_t) { return strtod(text, end); }
float strtof_l(const char* text, char** end, locale_t) { return strtof(text, end); }
long double strtold_l(const char* text, char** end, locale_t) { return strtod(text, end); }
}
