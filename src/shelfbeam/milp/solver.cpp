#include "shelfbeam/milp/solver.hpp"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/milp/backend.hpp"
#include "shelfbeam/milp/verify.hpp"

namespace shelfbeam::milp {

namespace {

// Not every solver accepts a model without columns: its rows are met by nothing, or not at all.
Result solve_empty(const Model& model) {
  if (violation(model, {}) > feasibility_tolerance) return {Termination::infeasible, infinity, infinity, {}};
  return {Termination::optimal, 0, 0, {}};
}

template <Result (*solve)(const Model&, const SolveOptions&, const RunControl&)>
Result guarded(const Model& model, const SolveOptions& options, const RunControl& control) {
  if (control.cancelled()) return {Termination::interrupted, infinity, -infinity, {}};
  if (model.columns.empty()) return solve_empty(model);
  return verified(model, options, solve(model, options, control));
}

}  // namespace

std::span<const Backend> backends() {
  static const std::array table = {
#ifdef SHELFBEAM_HAS_HIGHS
      Backend{"highs", highs_version(), guarded<solve_highs>, read_highs, lp_highs},
#endif
#ifdef SHELFBEAM_HAS_CBC
      Backend{"cbc", cbc_version(), guarded<solve_cbc>, read_cbc, lp_cbc},
#endif
  };
  return table;
}

std::span<const Backend> wanted_backends(std::string_view name) {
  const std::span<const Backend> all = backends();
  if (name.empty()) return all;
  std::vector<std::string_view> known;
  for (const Backend& backend : all) {
    if (backend.name == name) return {&backend, 1};
    known.push_back(backend.name);
  }
  throw InputError("MIP back end", fmt::format("'{}' is not built in", name), suggest(name, known));
}

}  // namespace shelfbeam::milp
