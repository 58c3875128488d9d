#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::test {

inline constexpr auto coop = CommunicationModel::cooperative;
inline constexpr auto alone = CommunicationModel::non_cooperative;
inline constexpr PlacementProblem covering{.model = alone};

/// How much a bound may exceed the optimum by the rounding of its sum.
inline double rounding(double value) {
  return 1e-9 * std::max(1.0, std::abs(value));
}

/// A table from a dense m x n matrix, all requirements 1.
inline SignalTable make_table(const std::vector<std::vector<double>>& matrix, std::size_t columns) {
  SignalTable table;
  for (std::size_t j = 0; j < columns; ++j)
    table.transceivers.push_back({"T" + std::to_string(j), 1.0, false});
  table.row_begin = {0};
  for (const auto& row : matrix) {
    table.labels.push_back({"L" + std::to_string(table.labels.size()), 1.0, 1.0, 0.0, 0.0});
    for (std::uint32_t j = 0; j < row.size(); ++j)
      if (row[j] != 0) table.entries.push_back({j, row[j]});
    table.row_begin.push_back(table.entries.size());
  }
  return table;
}

struct RandomTableLimits {
  int labels = 10;
  int transceivers = 14;
  bool borderline = true;  ///< with signals so near the requirement that only the exact rule decides
  bool mounts = false;     ///< with mounting points that have one to four options
  bool conflicts = false;  ///< with pairs that must not be chosen together
  bool redundant = false;  ///< in three of four problems a unit may fail; signals are slightly stronger
  bool weights = false;  ///< of labels: in half of the tables 1, in the others whole, decimal or real; some 0
};

/// Small tables of many kinds: dense and sparse, real and quantised (many exact ties, and sums equal to the
/// requirement), entries far above the requirement, entries 1e-11 to 1e-5 from it (where the rule's tolerance
/// decides, and solvers' tolerances mislead), signals in any unit of measure; with and without costs,
/// installed units, unreachable rows, and without labels or transceivers.
class RandomTables {
 public:
  explicit RandomTables(std::uint64_t seed, RandomTableLimits limits = {}) : random_(seed), limits_(limits) {}

  SignalTable next() {
    const auto n = static_cast<std::size_t>(chance(0.02) ? 0 : whole(1, limits_.transceivers));
    const auto m = static_cast<std::size_t>(chance(0.02) ? 0 : whole(1, limits_.labels));
    const int kind = whole(0, limits_.borderline ? 3 : 2);
    const double density = chance(0.5) ? 1.0 : real(0.2, 0.8);
    std::vector<std::vector<double>> matrix(m, std::vector<double>(n, 0.0));
    for (auto& row : matrix)
      for (double& entry : row)
        if (chance(density)) entry = entry_of(kind);
    SignalTable table = make_table(matrix, n);
    add_costs(table);
    if (limits_.mounts) add_mounts(table);
    if (limits_.conflicts) add_pairs(table);
    if (limits_.redundant)
      for (auto& label : table.labels)
        if (chance(0.7)) label.requirement *= 0.5, label.single_requirement *= 0.5;
    const double unit = chance(0.5) ? 1.0 : std::pow(10.0, real(-9, 4));
    scale(table, unit);
    if (limits_.weights && chance(0.5)) add_weights(table);
    return table;
  }

  PlacementProblem next_problem() {
    PlacementProblem problem;
    problem.model = chance(0.5) ? CommunicationModel::cooperative : CommunicationModel::non_cooperative;
    problem.objective = static_cast<Objective>(whole(0, 3));
    problem.combination = chance(0.5) ? Combination::lexicographic : Combination::weighted;
    problem.share = chance(0.5) ? 1.0 : real(0.1, 1.5);
    if (limits_.redundant) problem.redundant = chance(0.75);
    return problem;
  }

  bool chance(double probability) { return real(0, 1) < probability; }
  double real(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  int whole(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }

 private:
  double entry_of(int kind) {
    switch (kind) {
      case 0:
        return real(0, 0.8);
      case 1:
        return 0.25 * whole(0, 5);
      case 2:
        return std::exp(real(-5, 4));
      default:
        return (chance(0.4) ? 1.0 : 0.5) * (1 + std::pow(10.0, whole(-11, -6)) * whole(-30, 10));
    }
  }

  void add_costs(SignalTable& table) {
    const int transceiver_costs = whole(0, 2);
    for (auto& unit : table.transceivers) {
      if (transceiver_costs == 1) unit.cost = whole(0, 5);
      if (transceiver_costs == 2) unit.cost = real(0, 3);
      unit.installed = chance(0.08);
    }
    const int label_costs = whole(0, 2);
    const bool other_reach = chance(0.3);
    for (auto& label : table.labels) {
      if (label_costs == 1) label.link_cost = label.signal_cost = whole(0, 2);
      if (label_costs == 2) label.link_cost = real(0, 1), label.signal_cost = real(0, 5);
      if (other_reach) label.single_requirement = 0.5;
    }
  }

  // Any columns may share a point; at most one of them is installed.
  void add_mounts(SignalTable& table) {
    Selection columns(table.columns());
    std::iota(columns.begin(), columns.end(), 0U);
    std::shuffle(columns.begin(), columns.end(), random_);
    for (std::size_t begin = 0; begin < columns.size();) {
      const std::size_t end = std::min(columns.size(), begin + static_cast<std::size_t>(whole(1, 4)));
      Selection mount(columns.begin() + static_cast<std::ptrdiff_t>(begin),
                      columns.begin() + static_cast<std::ptrdiff_t>(end));
      begin = end;
      if (mount.size() < 2) continue;
      std::sort(mount.begin(), mount.end());
      bool taken = false;
      for (const std::uint32_t j : mount) {
        bool& installed = table.transceivers[j].installed;
        installed = installed && !taken;
        taken = taken || installed;
      }
      table.mounts.push_back(std::move(mount));
    }
  }

  void add_pairs(SignalTable& table) {
    const double density = real(0, 0.25);
    const auto n = static_cast<std::uint32_t>(table.columns());
    for (std::uint32_t a = 0; a < n; ++a)
      for (std::uint32_t b = a + 1; b < n; ++b)
        if (chance(density) && !(table.transceivers[a].installed && table.transceivers[b].installed))
          table.conflicts.emplace_back(a, b);
  }

  void add_weights(SignalTable& table) {
    const int kind = whole(0, 2);
    for (auto& label : table.labels)
      label.weight = kind == 0 ? whole(0, 5) : kind == 1 ? whole(0, 40) / 10.0 : std::exp(real(-4, 4));
  }

  static void scale(SignalTable& table, double unit) {
    for (auto& label : table.labels) label.requirement *= unit, label.single_requirement *= unit;
    for (auto& entry : table.entries) entry.signal *= unit;
  }

  std::mt19937_64 random_;
  RandomTableLimits limits_;
};

/// Signals of an eighth of the requirement on average; large tables are not proven immediately.
inline SignalTable dense_table(std::size_t labels, std::size_t units) {
  RandomTables random(5);
  std::vector<std::vector<double>> matrix(labels, std::vector<double>(units));
  for (auto& row : matrix)
    for (double& entry : row) entry = random.real(0, 0.25);
  return make_table(matrix, units);
}

/// Labels and units scattered over a square. Signals fall with the distance, with some noise. Few units
/// suffice, and very many selections of the same count nearly do.
inline SignalTable scattered_table(RandomTables& random, std::size_t labels, std::size_t units,
                                   double strength = 0.06) {
  std::vector<std::vector<double>> matrix(labels, std::vector<double>(units));
  std::vector<double> x, y;
  for (std::size_t j = 0; j < units; ++j) {
    x.push_back(random.real(0, 1));
    y.push_back(random.real(0, 1));
  }
  for (auto& row : matrix) {
    const double label_x = random.real(0, 1), label_y = random.real(0, 1);
    for (std::size_t j = 0; j < units; ++j)
      row[j] = strength / (0.03 + std::pow(label_x - x[j], 2) + std::pow(label_y - y[j], 2)) *
               random.real(0.8, 1.25);
  }
  return make_table(matrix, units);
}

}  // namespace shelfbeam::test
