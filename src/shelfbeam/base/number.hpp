#pragma once

#include <optional>
#include <string_view>

namespace shelfbeam {

/// The number that the whole of `text` is ("nan" and "inf" are numbers here); nothing when it is none or lies
/// outside the range of a double. Independent of the locale.
std::optional<double> to_number(std::string_view text);

/// What is wrong with a signal, cost or requirement ("is NaN"); empty when it is finite and not negative.
std::string_view amount_problem(double value);

}  // namespace shelfbeam
