#include "shelfbeam/signal/constraints/table_constraints.hpp"

#include "shelfbeam/signal/constraints/conflicts.hpp"

namespace shelfbeam {

void TableConstraints::apply(SignalTable& table, const std::string& name) const {
  for (const auto& file : costs) apply_costs(table, file);
  for (const auto& file : forbidden) forbid_pairs(table, file);
  if (min_spacing > 0) add_conflicts(table, min_spacing, name);
}

}  // namespace shelfbeam
