#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

/// The reason of an interruption.
inline constexpr auto stopped_without_result = "the work was stopped before it had a result";

/// For work whose result is worthless in parts. Throws Interrupted if the token is set.
inline void expect_running(const CancelToken* cancel) {
  if (cancel != nullptr && cancel->requested()) throw Interrupted(stopped_without_result);
}

}  // namespace shelfbeam
