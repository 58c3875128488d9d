#pragma once

#include <chrono>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::milp::detail {

/// Passes incumbent and bound on to the progress sink, a few times a second at most.
class BoundReport {
 public:
  explicit BoundReport(const RunControl& control) : control_(control) {}

  /// `primal` may be infinite (nothing found yet), `dual` minus infinity (nothing proven yet).
  void operator()(double primal, double dual);

 private:
  const RunControl& control_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace shelfbeam::milp::detail
