#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam::milp {

// What the file of each back end defines, for the table in solver.cpp.
std::string_view highs_version();
Result solve_highs(const Model& model, const SolveOptions& options, const RunControl& control);
Model read_highs(const std::filesystem::path& path);
std::unique_ptr<LpSession> lp_highs(std::span<const Column> columns);

std::string_view cbc_version();
Result solve_cbc(const Model& model, const SolveOptions& options, const RunControl& control);
Model read_cbc(const std::filesystem::path& path);
std::unique_ptr<LpSession> lp_cbc(std::span<const Column> columns);

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

/// A power of two that brings the largest cost between 512 and 1024, so that solvers' absolute tolerances on
/// costs (1e-7 and the like) never decide; 1 for whole-numbered costs, whose integrality solvers use.
double objective_scale(std::span<const Column> columns);

}  // namespace shelfbeam::milp
