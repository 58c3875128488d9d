#pragma once

#include <cstdint>
#include <optional>

namespace shelfbeam {

/// The budget of all rounds of a certificate: time, or samples for machine-independent results.
struct RoundBudget {
  double seconds = 600;
  std::optional<std::uint64_t> samples = {};  ///< replaces the time: samples of all labels together
};

}  // namespace shelfbeam
