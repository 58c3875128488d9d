#pragma once

#include <cstdint>
#include <string>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::test {

/// A matrix with entries in [0, 1), a third of them zero, direct light below the mean, and requirements
/// around 1.
inline SignalMatrix random_matrix(std::uint32_t rows, std::uint32_t columns, std::uint32_t trial) {
  const auto draw = [trial](std::uint32_t i, std::uint32_t j, std::size_t k) {
    return to_uniform(philox({i, j, trial, 0}, 11)[k]);
  };
  SignalMatrix matrix;
  for (std::uint32_t i = 0; i < rows; ++i)
    matrix.labels.push_back({"L" + std::to_string(i),
                             "standard",
                             {0.3 * i, 1, 0.4 + 0.4 * (i % 3)},
                             {0, -1, 0},
                             0.5 + draw(i, 1000, 0),
                             0,
                             0,
                             8 + i % 2,
                             1000 + 10 * i});
  for (std::uint32_t j = 0; j < columns; ++j)
    matrix.transceivers.push_back(
        {"T" + std::to_string(j), "ceiling", {0.5 * j, 2, 3}, {0, 0, -1}, 1, j == 1});
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double mean = draw(i, j, 0) < 1.0 / 3 ? 0 : draw(i, j, 1);
      matrix.mean.push_back(static_cast<float>(mean));
      matrix.direct.push_back(static_cast<float>(mean * draw(i, j, 2)));
      matrix.standard_error.push_back(static_cast<float>(0.1 * mean * draw(i, j, 3)));
    }
  return matrix;
}

}  // namespace shelfbeam::test
