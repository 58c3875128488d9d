#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam::test {

/// A room of 6 x 5 x 3 m with a gondola of about 16 labels, `spacing` metres apart, and `across` x 3 units,
/// which is very quick to simulate.
struct PlanStore {
  double threshold = 0.02;
  double spacing = 0.7;
  int across = 4;

  std::string text() const {
    std::string units;
    for (int x = 0; x < across; ++x)
      for (int y = 0; y < 3; ++y)
        units += fmt::format(R"({}{{"id": "T{}-{}", "position": [{}, {}, 2.98], "type": "wide"}})",
                             x + y == 0 ? "" : ",", x, y, 5.0 * (x + 0.5) / across + 0.5, 0.8 + 1.7 * y);
    return fmt::format(R"({{
          "room": {{"size": [6, 5, 3], "floor": "paper", "ceiling": "paper", "walls": "paper"}},
          "materials": {{"paper": {{"type": "lambertian", "reflectance": 0.6}}}},
          "label_types": {{"standard": {{"threshold": {}}}}},
          "transceiver_types": {{"wide": {{"emission": {{"type": "sin2theta", "peak": 1}}}}}},
          "fixtures": [{{"type": "gondola", "id": "A1", "at": [1.2, 2.1], "length": 3, "depth": 0.8, "height": 1.6,
                        "material": "paper", "shelves": [0.5, 1.1], "stocking": 0.7,
                        "labels": {{"type": "standard", "spacing": {}}}}}],
          "transceivers": {{"list": [{}]}}}})",
                       threshold, spacing, units);
  }
  Scene scene() const { return make_scene(parse_store(text(), "plan store", ".")); }
};

/// The two units with the largest sum at their weakest label, and this sum.
struct BestPair {
  std::vector<ColumnId> units;
  double min_signal = 0;
};

inline BestPair best_pair(const SignalMatrix& matrix) {
  BestPair best;
  for (std::uint32_t a = 0; a < matrix.columns(); ++a)
    for (std::uint32_t b = 0; b < a; ++b) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < matrix.rows(); ++i)
        least = std::min(least, static_cast<double>(matrix.mean[matrix.at(i, a)]) +
                                    static_cast<double>(matrix.mean[matrix.at(i, b)]));
      if (least > best.min_signal) best = {{b, a}, least};
    }
  return best;
}

}  // namespace shelfbeam::test
