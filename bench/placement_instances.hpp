#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::bench {

struct InstanceChoice {
  std::vector<std::string> files;    ///< empty: simulated matrices of the thesis environment
  std::vector<double> scales = {1};  ///< factors of all requirements
  /// Relative standard deviation of lognormal noise: every signal is multiplied by exp(s z - s^2 / 2), with
  /// s^2 = ln(1 + noise^2) and z normal, keyed by label and candidate (seed 1).
  double noise = 0;
};

/// Visits every matrix with every scale. Only one matrix is in memory at a time.
void for_instances(const InstanceChoice& choice,
                   const std::function<void(const std::string& name, const SignalTable&)>& visit);

}  // namespace shelfbeam::bench
