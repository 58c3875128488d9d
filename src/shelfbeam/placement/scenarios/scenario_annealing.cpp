#include "shelfbeam/placement/scenarios/scenario_annealing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>

#include "shelfbeam/placement/heuristic/annealing_walk.hpp"
#include "shelfbeam/placement/kernels/growing_columns.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint64_t spread_moves = 1'000'000;                                  ///< of one reserve
constexpr std::array reserves{1.0, 1.01, 1.02, 1.03, 1.05, 1.07, 1.1, 1.15, 1.2};  ///< in requirements

SignalTable table_of(const ScenarioTable& scenarios, std::size_t scenario) {
  SignalTable table = scenarios.table;
  table.row_begin = {0};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if (const float signal = scenarios.of(j, i)[scenario]; signal > 0)
        table.entries.push_back({j, static_cast<double>(signal)});
    table.row_begin.push_back(table.entries.size());
  }
  return table;
}

// The cases that walks work on, in the groups to which an allowance applies: of one label, of one scenario,
// or all.
class CaseRows : public detail::TotalLack<CaseRows> {
 public:
  static constexpr std::uint64_t max_moves = 128;

  CaseRows(const ScenarioTable& scenarios, const PlacementProblem& problem, const MissAllowance& allowance,
           double reserve, const Selection& start)
      : scenarios_(scenarios),
        problem_(problem),
        allowance_(allowance),
        reserve_(reserve),
        is_known_(scenarios.table.rows() * scenarios.count, false),
        values_(scenarios.table.columns()),
        groups_(!allowance.of_label.empty() ? scenarios.table.rows()
                : allowance.of_shop         ? scenarios.count
                                            : 1) {
    constexpr double near = 1.1;
    find_missed(start, near);
    while (add_missed()) {
    }
  }

  const detail::GrowingColumns& matrix() const { return values_; }

  void excuse(std::vector<float>& held, const std::vector<float>& best) {
    if (!allowance_.of_label.empty())
      for (std::size_t i = 0; i < groups_.size(); ++i)
        excuse_rows(groups_[i], allowance_.of_label[i], held, best);
    else if (allowance_.of_shop)
      excuse_groups(*allowance_.of_shop, held, best);
    else if (allowance_.total)
      excuse_rows(groups_.front(), *allowance_.total, held, best);
  }

  bool reaches_all(const Selection& selected) { return find_missed(selected, 1); }

  bool add_missed() {
    std::vector<Case> added;
    std::size_t labels = 0;
    for (std::size_t begin = 0, end = 0; begin < missed_.size() && labels < max_labels; begin = end) {
      while (end < missed_.size() && missed_[end].label == missed_[begin].label) ++end;
      // With more cases the walk is slower and, in tests, no better.
      const std::size_t before = added.size(), max_cases = 1 + allowance_.limit(missed_[begin].label);
      for (std::size_t k = begin; k < end && added.size() < before + max_cases; ++k)
        if (!is_known_[at(missed_[k])]) added.push_back(missed_[k]);
      labels += added.size() > before ? 1 : 0;
    }
    take(added);
    return !added.empty();
  }

 private:
  struct Case {
    LabelId label;
    std::uint32_t scenario = 0;
    double received = 0;
  };
  static constexpr float excused = 64;           ///< is added to the signals of excused rows
  static constexpr std::size_t max_labels = 64;  ///< whose cases are added at once

  std::size_t at(const Case& one) const { return one.label * scenarios_.count + one.scenario; }
  double requirement(LabelId label) const {
    return reserve_ * requirement_of(scenarios_.table.labels[label], problem_.model);
  }

  static float counted(const std::vector<float>& held, const std::vector<float>& best, std::uint32_t row) {
    return best.empty() ? held[row] : held[row] - best[row];
  }

  // Excuses the rows of a group that receive least.
  void excuse_rows(std::vector<std::uint32_t>& rows, std::uint64_t allowed, std::vector<float>& held,
                   const std::vector<float>& best) const {
    const auto end =
        rows.begin() + static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(allowed, rows.size()));
    std::ranges::nth_element(rows, end, {}, [&](std::uint32_t r) { return counted(held, best, r); });
    std::for_each(rows.begin(), end, [&](std::uint32_t r) { held[r] += excused; });
  }

  // Excuses the groups that lack most.
  void excuse_groups(std::uint64_t allowed, std::vector<float>& held, const std::vector<float>& best) const {
    std::vector<std::pair<float, std::size_t>> lack(groups_.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      lack[g].second = g;
      for (const std::uint32_t r : groups_[g]) lack[g].first += std::max(0.0F, 1 - counted(held, best, r));
    }
    std::sort(lack.begin(), lack.end(), std::greater<>());
    for (std::size_t k = 0; k < std::min<std::uint64_t>(allowed, lack.size()); ++k)
      for (const std::uint32_t r : groups_[lack[k].second]) held[r] += excused;
  }

  // Sets `missed_`: the cases of labels, those that receive least first, which break the rule if all signals
  // are divided by `near`. Returns whether there are none.
  bool find_missed(const Selection& selected, double near) {
    missed_.clear();
    MissCounter counter(scenarios_.table.rows(), scenarios_.count);
    for_each_weak(scenarios_, problem_, selected, near * reserve_,
                  [&](LabelId i, std::uint32_t s, const ReceivedSignal& received) {
                    missed_.push_back({i, s, received.value()});
                    counter.add(i, s);
                  });
    const ScenarioMisses& misses = counter.misses();
    if (!allowance_.of_label.empty())
      std::erase_if(missed_, [&](const Case& one) {
        return misses.of_label[one.label] <= allowance_.of_label[one.label];
      });
    std::ranges::sort(missed_, {}, [](const Case& one) { return std::pair(one.label, one.received); });
    return allowance_.excess(misses) == 0;
  }

  void take(const std::vector<Case>& cases) {
    for (std::size_t k = 0; k < cases.size(); ++k) {
      is_known_[at(cases[k])] = true;
      const std::size_t group = !allowance_.of_label.empty() ? std::uint32_t{cases[k].label}
                                : allowance_.of_shop         ? cases[k].scenario
                                                             : 0;
      groups_[group].push_back(static_cast<std::uint32_t>(values_.rows() + k));
    }
    values_.add_rows(cases.size(), [&](std::size_t k, std::size_t j) {
      const double signal = static_cast<double>(
          scenarios_.of(static_cast<std::uint32_t>(j), cases[k].label)[cases[k].scenario]);
      return static_cast<float>(detail::share_of(signal, requirement(cases[k].label), problem_));
    });
  }

  const ScenarioTable& scenarios_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  double reserve_;
  std::vector<bool> is_known_;  ///< by label and scenario
  detail::GrowingColumns values_;
  std::vector<std::vector<std::uint32_t>> groups_;  ///< rows
  std::vector<Case> missed_;
};

}  // namespace

ScenarioAnnealing::ScenarioAnnealing(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                     const MissAllowance& allowance)
    : scenarios_(scenarios),
      problem_(problem),
      allowance_(allowance),
      first_(table_of(scenarios, 0)),
      instance_(first_, problem_),
      matrix_(instance_) {}

std::optional<Selection> ScenarioAnnealing::next(const Selection& start, double reserve,
                                                 const detail::Effort& effort, const RunControl& control) {
  const std::uint32_t seed = seed_;
  seed_ += detail::walks_at_once;
  return detail::best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    return detail::AnnealingWalk(instance_, matrix_,
                                 CaseRows(scenarios_, problem_, allowance_, reserve, start), start, own_seed);
  });
}

Selection ScenarioAnnealing::spread(Selection selected, const detail::Effort& effort,
                                    const RunControl& control) {
  for (const double reserve : reserves) {
    if (effort.is_over(control)) break;
    if (allowance_.excess(misses_of(scenarios_, problem_, selected, reserve)) == 0) continue;
    std::optional<Selection> found = next(selected, reserve, {spread_moves, effort.until}, control);
    if (!found) break;
    selected = std::move(*found);
  }
  return selected;
}

}  // namespace shelfbeam
