#pragma once

#include <string>

namespace shelfbeam {

// Numbers with a decimal point. Words writes them as its language does.

/// Fixed decimals with the minus sign U+2212, never "-0".
std::string fixed_number(double value, int decimals);

/// At least `digits` significant digits as a plain decimal; powers of ten only below 1e-4 and from 1e7 on.
std::string significant_number(double value, int digits = 3);

/// Up to `digits` significant digits without trailing zeros.
std::string plain_number(double value, int digits = 6);

/// Rounded so that a bound claims no more than was proven. Differences of 1e-9 of the value are errors of
/// floating point.
double rounded_down(double value, int decimals);
double rounded_up(double value, int decimals);

}  // namespace shelfbeam
