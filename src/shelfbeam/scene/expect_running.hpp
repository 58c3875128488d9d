#pragma once

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

/// For work whose result is worthless in parts. Throws Interrupted if the token is set.
inline void expect_running(const CancelToken* cancel) {
  if (cancel != nullptr && cancel->requested())
    throw Interrupted("the work was stopped before it had a result");
}

}  // namespace shelfbeam
