#include "shelfbeam/material/require.hpp"

#include <stdexcept>

#include <fmt/format.h>

namespace shelfbeam::detail {

void require_range(std::string_view what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw std::invalid_argument(fmt::format("{} is {}, must be from {} to {}", what, value, low, high));
}

}  // namespace shelfbeam::detail
