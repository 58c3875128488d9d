#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::test {

/// What is left out of the enumeration, to see that a comparison with it can fail.
enum class Omission { nothing, last_label, installed, second_objective, tolerance, mounts, apart, failure };

/// Answers of the paper's models by trying every selection, written from the formulas of chapter 3 with dense
/// matrices M, l and t, sharing no code with the library.
struct BruteForce {
  bool feasible = false;
  std::size_t fewest = 0;        ///< least number of transceivers
  double best_at_fewest = 0;     ///< least second objective among the selections of that many
  double best_sum = 0;           ///< least sum of transceiver costs and second objective
  double best_second_objective;  ///< least second objective of all
  std::uint32_t set_at_fewest = 0, set_of_best_sum = 0;  ///< selections of these values, a bit a column

  BruteForce(const SignalTable& table, const Question& question, Omission omission = Omission::nothing) {
    const std::size_t m = table.labels.size();
    const std::size_t n = table.transceivers.size();
    const std::vector<std::vector<double>> signal = dense(table);

    constexpr double infinite = std::numeric_limits<double>::infinity();
    best_at_fewest = best_sum = best_second_objective = infinite;
    fewest = n + 1;
    const double tolerance = omission == Omission::tolerance ? -2e-9 : 1e-9;
    const std::size_t tested = m - (omission == Omission::last_label && m > 0 ? 1 : 0);
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << n); ++set) {
      const auto in = [&](std::size_t j) { return (set >> j & 1U) != 0; };
      bool allowed = (omission == Omission::mounts || one_at_a_point(table, set)) &&
                     (omission == Omission::apart || kept_apart(table, set));
      double price = 0;
      std::size_t count = 0;
      for (std::size_t j = 0; j < n; ++j) {
        if (!in(j) && table.transceivers[j].installed && omission != Omission::installed) allowed = false;
        if (in(j)) price += table.transceivers[j].cost, ++count;
      }
      for (std::size_t i = 0; i < tested && allowed; ++i) {
        allowed = met(table, question, signal[i], i, set, tolerance, omission);
      }
      if (!allowed) continue;
      feasible = true;
      const double second =
          omission == Omission::second_objective ? 0 : second_objective(table, question, signal, set);
      best_second_objective = std::min(best_second_objective, second);
      if (price + second < best_sum) {
        best_sum = price + second;
        set_of_best_sum = set;
      }
      if (count < fewest || (count == fewest && second < best_at_fewest)) {
        fewest = count;
        best_at_fewest = second;
        set_at_fewest = set;
      }
    }
  }

  /// What each label gets from the selection that gives it most, whatever becomes of the others. Pairs that
  /// must be kept apart count only where one of them is installed, as documented.
  static std::vector<double> most(const SignalTable& table, const Question& question) {
    const std::vector<std::vector<double>> signal = dense(table);
    std::uint32_t installed = 0;
    for (std::size_t j = 0; j < table.transceivers.size(); ++j)
      if (table.transceivers[j].installed) installed |= std::uint32_t{1} << j;
    std::vector<double> result(table.labels.size(), 0.0);
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << table.transceivers.size()); ++set) {
      if ((set & installed) != installed || !one_at_a_point(table, set)) continue;
      bool excluded = false;
      for (const auto& [a, b] : table.apart)
        excluded =
            excluded || ((set >> a & set >> b & 1U) != 0 && ((installed >> a | installed >> b) & 1U) != 0);
      if (excluded) continue;
      for (std::size_t i = 0; i < signal.size(); ++i) {
        const auto got_without = [&](std::size_t failed) {
          double got = 0;
          for (std::size_t j = 0; j < signal[i].size(); ++j)
            if ((set >> j & 1U) != 0 && j != failed)
              got = question.model == CommunicationModel::cooperative ? got + signal[i][j]
                                                                      : std::max(got, signal[i][j]);
          return got;
        };
        double got = got_without(signal[i].size());
        for (std::size_t failed = 0; failed < signal[i].size() && question.redundant; ++failed)
          if ((set >> failed & 1U) != 0) got = std::min(got, got_without(failed));
        result[i] = std::max(result[i], got);
      }
    }
    return result;
  }

  /// The most labels that selections of at most so many units meet, and the fewest units that do it.
  struct Budget {
    std::size_t reached = 0, units = 0;
  };
  /// For every number of units up to all; nothing where more are installed.
  static std::vector<std::optional<Budget>> budgets(const SignalTable& table, const Question& question,
                                                    Omission omission = Omission::nothing) {
    const std::size_t n = table.transceivers.size();
    const std::vector<std::vector<double>> signal = dense(table);
    std::vector<std::optional<Budget>> best(n + 1);
    const std::size_t tested = signal.size() - (omission == Omission::last_label && !signal.empty() ? 1 : 0);
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << n); ++set) {
      bool allowed = (omission == Omission::mounts || one_at_a_point(table, set)) &&
                     (omission == Omission::apart || kept_apart(table, set));
      std::size_t count = 0;
      for (std::size_t j = 0; j < n; ++j) {
        if ((set >> j & 1U) != 0) ++count;
        if ((set >> j & 1U) == 0 && table.transceivers[j].installed && omission != Omission::installed)
          allowed = false;
      }
      if (!allowed) continue;
      std::size_t reached = 0;
      for (std::size_t i = 0; i < tested; ++i)
        if (met(table, question, signal[i], i, set, 1e-9, omission)) ++reached;
      for (std::size_t k = count; k <= n; ++k)
        if (!best[k] || reached > best[k]->reached || (reached == best[k]->reached && count < best[k]->units))
          best[k] = Budget{reached, count};
    }
    return best;
  }

  /// A selection that meets every label.
  struct Answer {
    std::uint32_t set = 0;
    std::vector<std::uint32_t> columns;
    double second_objective = 0, price = 0;
    double margin = 0;  ///< the least of what labels receive over their requirement; infinite without labels
  };
  /// In order: ties are settled by them.
  static std::vector<std::string> ids(const SignalTable& table, const std::vector<std::uint32_t>& columns) {
    std::vector<std::string> result;
    result.reserve(columns.size());
    for (const std::uint32_t j : columns) result.push_back(table.transceivers[j].id);
    std::sort(result.begin(), result.end());
    return result;
  }

  static std::vector<Answer> answers(const SignalTable& table, const Question& question,
                                     Omission omission = Omission::nothing) {
    const std::size_t n = table.transceivers.size();
    const std::vector<std::vector<double>> signal = dense(table);
    const double tolerance = omission == Omission::tolerance ? -2e-9 : 1e-9;
    const std::size_t tested = signal.size() - (omission == Omission::last_label && !signal.empty() ? 1 : 0);
    std::vector<Answer> result;
    for (std::uint32_t set = 0; set < (std::uint32_t{1} << n); ++set) {
      bool allowed = (omission == Omission::mounts || one_at_a_point(table, set)) &&
                     (omission == Omission::apart || kept_apart(table, set));
      Answer answer;
      answer.set = set;
      for (std::uint32_t j = 0; j < n; ++j) {
        const bool in = (set >> j & 1U) != 0;
        if (!in && table.transceivers[j].installed && omission != Omission::installed) allowed = false;
        if (in) answer.columns.push_back(j), answer.price += table.transceivers[j].cost;
      }
      answer.margin = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < tested && allowed; ++i) {
        const double requirement = question.model == CommunicationModel::cooperative
                                       ? table.labels[i].requirement
                                       : table.labels[i].single_requirement;
        const double got = received(question, signal[i], set, omission);
        allowed = got >= requirement * (1 - tolerance);
        answer.margin = std::min(answer.margin, got / requirement);
      }
      if (!allowed) continue;
      answer.second_objective = second_objective(table, question, signal, set);
      result.push_back(std::move(answer));
    }
    return result;
  }

  /// Whether the selection meets label i.
  static bool met(const SignalTable& table, const Question& question, const std::vector<double>& signal,
                  std::size_t i, std::uint32_t set, double tolerance, Omission omission) {
    const auto in = [&](std::size_t j) { return (set >> j & 1U) != 0; };
    const std::size_t n = signal.size();
    const auto met_without = [&](std::size_t failed) {
      double sum = 0;
      bool reached = false;
      for (std::size_t j = 0; j < n; ++j) {
        if (!in(j) || j == failed) continue;
        sum += signal[j];
        reached = reached || signal[j] >= table.labels[i].single_requirement * (1 - tolerance);
      }
      return question.model == CommunicationModel::cooperative
                 ? sum >= table.labels[i].requirement * (1 - tolerance)
                 : reached;
    };
    bool all = met_without(n);
    for (std::size_t failed = 0; failed < n && question.redundant && omission != Omission::failure; ++failed)
      all = all && (!in(failed) || met_without(failed));
    return all;
  }

 private:
  // Added up in the order of the columns, without the best of them where one may fail: to the last bit what
  // the contract says, for the order of sums decides near-ties.
  static double received(const Question& question, const std::vector<double>& signal, std::uint32_t set,
                         Omission omission) {
    const bool redundant = question.redundant && omission != Omission::failure;
    const bool cooperative = question.model == CommunicationModel::cooperative;
    double result = 0, largest = 0;
    for (std::size_t j = 0; j < signal.size(); ++j) {
      if ((set >> j & 1U) == 0) continue;
      const double counted = redundant ? std::min(largest, signal[j]) : signal[j];
      largest = std::max(largest, signal[j]);
      result = cooperative ? result + counted : std::max(result, counted);
    }
    return result;
  }

  static std::vector<std::vector<double>> dense(const SignalTable& table) {
    std::vector<std::vector<double>> signal(table.labels.size(),
                                            std::vector<double>(table.transceivers.size(), 0.0));
    for (std::size_t i = 0; i < signal.size(); ++i)
      for (std::size_t k = table.row_begin[i]; k < table.row_begin[i + 1]; ++k)
        signal[i][table.entries[k].transceiver] = table.entries[k].signal;
    return signal;
  }

  static bool one_at_a_point(const SignalTable& table, std::uint32_t set) {
    for (const auto& mount : table.mounts) {
      int units = 0;
      for (const std::uint32_t j : mount) units += (set >> j & 1U) != 0 ? 1 : 0;
      if (units > 1) return false;
    }
    return true;
  }

  static bool kept_apart(const SignalTable& table, std::uint32_t set) {
    return std::none_of(table.apart.begin(), table.apart.end(), [&](const auto& pair) {
      return (set >> pair.first & 1U) != 0 && (set >> pair.second & 1U) != 0;
    });
  }

  static double second_objective(const SignalTable& table, const Question& question,
                                 const std::vector<std::vector<double>>& signal, std::uint32_t set) {
    if (question.objective == Objective::count) return 0;
    const bool cooperative = question.model == CommunicationModel::cooperative;
    bool priced = false;
    for (const auto& label : table.labels)
      priced = priced || (question.objective == Objective::signal ? label.signal_cost : label.link_cost) > 0;
    double value = 0;
    for (std::size_t i = 0; i < table.labels.size(); ++i) {
      const SignalTable::Label& label = table.labels[i];
      const double given = question.objective == Objective::signal ? label.signal_cost : label.link_cost;
      const double cost = priced ? given : 1;
      const double requirement = cooperative ? label.requirement : label.single_requirement;
      for (std::size_t j = 0; j < table.transceivers.size(); ++j) {
        if ((set >> j & 1U) == 0) continue;
        if (question.objective == Objective::signal) value += cost * signal[i][j];
        if (question.objective == Objective::links &&
            (cooperative || signal[i][j] >= requirement * (1 - 1e-9)))
          value += cost;
        if (question.objective == Objective::effective_links &&
            signal[i][j] >= question.share * requirement * (1 - 1e-9))
          value += cost;
      }
    }
    return value;
  }
};

}  // namespace shelfbeam::test
