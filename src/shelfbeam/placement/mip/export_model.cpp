#include "shelfbeam/placement/mip/export_model.hpp"

#include <array>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

milp::Model model_without_failures(const detail::Instance& instance) {
  const SignalTable& table = instance.table;
  const bool cooperative = instance.is_cooperative();
  milp::Model model;
  for (std::size_t j = 0; j < table.columns(); ++j) {
    const SignalTable::Transceiver& unit = table.transceivers[j];
    model.columns.push_back({instance.first_cost[j], unit.installed ? 1.0 : 0.0, 1.0, true, unit.id});
  }
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double requirement = instance.requirement(i);
    const double units = instance.problem.redundant ? 2.0 : 1.0;
    milp::Row row{cooperative ? 1 - met_tolerance : units, milp::infinity, {}, table.labels[i].id};
    for (const SignalEntry& entry : table.row(i)) {
      if (cooperative)
        row.entries.push_back({entry.transceiver, entry.signal / requirement});
      else if (is_met(entry.signal, requirement))
        row.entries.push_back({entry.transceiver, 1.0});
    }
    model.rows.push_back(std::move(row));
  }
  const auto id = [&](ColumnId j) { return table.transceivers[j].id; };
  for (const auto& mount : table.mounts)
    model.rows.push_back(milp::sum_row(mount, -milp::infinity, 1, "mount_" + id(mount.front())));
  for (const auto& [a, b] : table.conflicts)
    model.rows.push_back(milp::sum_row(std::array{a, b}, -milp::infinity, 1, "apart_" + id(a) + "_" + id(b)));
  return model;
}

milp::Row failure_row(const SignalTable& table, std::size_t label, std::uint32_t failed) {
  const SignalTable::Label& of = table.labels[label];
  milp::Row row{1 - met_tolerance, milp::infinity, {}, of.id + "_without_" + table.transceivers[failed].id};
  for (const SignalEntry& entry : table.row(label))
    if (entry.transceiver != failed)
      row.entries.push_back({entry.transceiver, entry.signal / of.requirement});
  return row;
}

milp::Model placement_model(const SignalTable& table, const PlacementProblem& problem) {
  milp::Model model = model_without_failures({table, problem});
  if (!problem.redundant || problem.model == CommunicationModel::non_cooperative) return model;
  std::size_t entries = 0;
  for (std::size_t i = 0; i < table.rows(); ++i) entries += table.row(i).size() * (table.row(i).size() - 1);
  if (entries > largest_model)
    throw InputError("model that survives a failure",
                     fmt::format("requires {} entries in the model file, but at most {} are written", entries,
                                 largest_model),
                     "use 'place', which adds rows only as required", Setting::failure);
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (const SignalEntry& entry : table.row(i))
      model.rows.push_back(failure_row(table, i, entry.transceiver));
  return model;
}

}  // namespace shelfbeam
