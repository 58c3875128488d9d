#include "shelfbeam/placement/export_model.hpp"

namespace shelfbeam {

std::vector<double> first_objective(const SignalTable& table, const Question& question) {
  if (question.combination == Combination::lexicographic) return std::vector<double>(table.columns(), 1.0);
  std::vector<double> cost = objective_coefficients(table, question);
  for (std::size_t j = 0; j < cost.size(); ++j) cost[j] += table.transceivers[j].cost;
  return cost;
}

milp::Model placement_model(const SignalTable& table, const Question& question) {
  const bool cooperative = question.model == CommunicationModel::cooperative;
  const std::vector<double> cost = first_objective(table, question);
  milp::Model model;
  for (std::size_t j = 0; j < table.columns(); ++j) {
    const SignalTable::Transceiver& unit = table.transceivers[j];
    model.columns.push_back({cost[j], unit.installed ? 1.0 : 0.0, 1.0, true, unit.id});
  }
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double requirement = requirement_of(table.labels[i], question.model);
    milp::Row row{cooperative ? 1 - met_tolerance : 1.0, milp::infinity, {}, table.labels[i].id};
    for (const SignalEntry& entry : table.row(i)) {
      if (cooperative)
        row.entries.push_back({entry.transceiver, entry.signal / requirement});
      else if (is_met(entry.signal, requirement))
        row.entries.push_back({entry.transceiver, 1.0});
    }
    model.rows.push_back(std::move(row));
  }
  for (const auto& mount : table.mounts) {
    milp::Row row{-milp::infinity, 1.0, {}, "mount_" + table.transceivers[mount.front()].id};
    for (const std::uint32_t j : mount) row.entries.push_back({j, 1.0});
    model.rows.push_back(std::move(row));
  }
  return model;
}

}  // namespace shelfbeam
