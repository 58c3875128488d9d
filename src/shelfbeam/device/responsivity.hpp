#pragma once

#include <algorithm>
#include <variant>

namespace shelfbeam {

/// R(theta) = cos(theta): the signal is the irradiance at the label.
struct CosineResponse {};

/// The closed set of label responses. To add one: a struct above and an overload of `response`.
using Responsivity = std::variant<CosineResponse>;

/// R(theta), the complete angular response: the paper's W (2.13) times cos(theta). Zero behind the label.
inline double response(const Responsivity& responsivity, double cos_theta) {
  return std::visit([&](const CosineResponse&) { return std::max(0.0, cos_theta); }, responsivity);
}

}  // namespace shelfbeam
