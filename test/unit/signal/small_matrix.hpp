#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::test {

/// A matrix with every kind of value: zeros, denormals, the largest amount, ids that CSV must quote.
inline SignalMatrix small_matrix(std::size_t rows = 7, std::size_t columns = 5) {
  SignalMatrix matrix;
  for (std::size_t i = 0; i < rows; ++i) {
    LabelRow label;
    label.id = i == 1 ? "shelf \"A\", left" : "A1-front-" + std::to_string(i);
    label.type = i % 2 == 0 ? "standard" : "Kühlregal";
    label.position = {0.1 * static_cast<double>(i), 1.0 / 3.0, 1.2};
    label.normal = {0, -1, 0};
    label.requirement = 0.0185 + 1e-17 * static_cast<double>(i);
    label.link_cost = 0.25 * static_cast<double>(i);
    label.signal_cost = 1e-3;
    label.batches = 16;
    label.samples = (std::uint64_t{1} << 40) + i;
    matrix.labels.push_back(label);
  }
  for (std::size_t j = 0; j < columns; ++j)
    matrix.transceivers.push_back({"G1-" + std::to_string(j) + "-0",
                                   "ceiling",
                                   {0.5 + static_cast<double>(j), 0.5, 3.98},
                                   {0, 0, -1},
                                   1.0 + static_cast<double>(j),
                                   j == 2});
  std::uint32_t state = 1;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state) * 0x1p-32f;
  };
  for (std::size_t k = 0; k < rows * columns; ++k) {
    const float value = k % 4 == 3 ? 0.0f : random() * random() * random();
    matrix.mean.push_back(value);
    matrix.standard_error.push_back(value * 0.01f * random());
    matrix.direct.push_back(k % 3 == 0 ? 0.0f : 0.7f * value);
    matrix.flags.push_back(k % 11 == 5 ? 1 : 0);
  }
  matrix.mean[0] = 1e-45f;
  matrix.mean[1] = 1e+18f;
  matrix.provenance = {"0.1.0", "00112233445566778899aabbccddeeff", 0xfedcba9876543210u,
                       "uniform, direct sampled"};
  return matrix;
}

}  // namespace shelfbeam::test
