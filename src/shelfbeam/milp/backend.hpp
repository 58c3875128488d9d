#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam::milp {

// The functions that the source file of each back end defines, for the table in solver.cpp.
std::string_view highs_version();
Result solve_highs(const Model& model, const SolveOptions& options, const RunControl& control);
Model read_highs(const std::filesystem::path& path);
std::unique_ptr<LpSession> lp_highs(std::span<const Column> columns);

std::string_view cbc_version();
Result solve_cbc(const Model& model, const SolveOptions& options, const RunControl& control);
Model read_cbc(const std::filesystem::path& path);
std::unique_ptr<LpSession> lp_cbc(std::span<const Column> columns);

/// Reports incumbent and dual bound to the progress sink, at most a few times per second.
class BoundReport {
 public:
  explicit BoundReport(const RunControl& control) : control_(control) {}

  /// `primal` is infinite without an incumbent, `dual` minus infinity without a bound.
  void operator()(double primal, double dual);

 private:
  const RunControl& control_;
  std::chrono::steady_clock::time_point next_{};
};

/// A power of two that scales the largest cost to between 512 and 1024, so that solvers' absolute tolerances
/// on costs (about 1e-7) have no effect; 1 for integer costs up to 1e6, whose integrality solvers exploit.
double objective_scale(std::span<const Column> columns);

}  // namespace shelfbeam::milp
