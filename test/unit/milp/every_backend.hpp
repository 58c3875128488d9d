#pragma once

#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam::test {

/// For suites that run with every MIP solver of the build, named after it.
inline const auto every_backend = testing::ValuesIn(milp::backends().begin(), milp::backends().end());

inline std::string backend_name(const testing::TestParamInfo<milp::Backend>& info) {
  return std::string(info.param.name);
}

}  // namespace shelfbeam::test
