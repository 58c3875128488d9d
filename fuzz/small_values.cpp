#include "small_values.hpp"

#include <string>

namespace shelfbeam::fuzz {

SignalMatrix small_matrix() {
  SignalMatrix matrix;
  for (int i = 0; i < 3; ++i)
    matrix.labels.push_back(
        {"L" + std::to_string(i), "standard", {1.0 * i, 1, 1}, {0, 1, 0}, 0.02, 0.5, 0.25, 16, 10000});
  for (int j = 0; j < 4; ++j)
    matrix.transceivers.push_back(
        {"T" + std::to_string(j), "ceiling", {1.0 * j, 2, 3}, {0, 0, -1}, 1, j == 3});
  for (int k = 0; k < 12; ++k) {
    const float value = k % 5 == 0 ? 0.0F : 0.01F * static_cast<float>(k);
    matrix.mean.push_back(value);
    matrix.standard_error.push_back(0.01F * value);
    matrix.direct.push_back(0.5F * value);
    matrix.flags.push_back(k == 7 ? 1 : 0);
  }
  matrix.by_bounce.push_back({matrix.direct, matrix.standard_error});
  matrix.provenance = {"0.1.0", "00112233445566778899aabbccddeeff", 1, "reuse"};
  return matrix;
}

SignalTable small_table() {
  return make_signal_table(small_matrix());
}

}  // namespace shelfbeam::fuzz
