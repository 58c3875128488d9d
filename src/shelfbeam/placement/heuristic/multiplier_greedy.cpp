#include "shelfbeam/placement/heuristic/multiplier_greedy.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace shelfbeam::detail {

namespace {

constexpr double met = 1e-6;  // lacks below this are rounding of single precision

class Greedy {
 public:
  Greedy(const SparseRows& rows, std::span<const double> y, std::span<const std::uint32_t> core)
      : rows_(rows),
        y_(y),
        core_(core.begin(), core.end()),
        lack_(rows.rows()),
        mu_(rows.columns(), 0.0),
        gamma_(rows.columns()),
        is_taken_(rows.groups(), false) {
    for (std::uint32_t j = 0; j < rows.columns(); ++j) gamma_[j] = rows.cost(j);
    for (std::uint32_t i = 0; i < rows.rows(); ++i) {
      lack_[i] = std::max(0.0, rows.rhs(i));
      if (lack_[i] <= met) continue;
      ++open_;
      count_in(i, lack_[i], 1);
    }
  }

  Selection run() {
    while (open_ > 0) {
      const std::size_t place = best();
      if (place == core_.size()) return {};
      take(core_[place]);
      core_[place] = core_.back();
      core_.pop_back();
    }
    drop_redundant();
    Selection selected = rows_.chosen();
    for (const std::uint32_t j : taken_) selected.push_back(rows_.column(j));
    std::sort(selected.begin(), selected.end());
    return selected;
  }

 private:
  // Adds (1) or removes (-1) the contributions that count while the row lacks this much.
  void count_in(std::uint32_t i, double lack, double sign) {
    for (const SparseRows::Term& term : rows_.row(i)) {
      const double part = sign * std::min(static_cast<double>(term.a), lack);
      mu_[term.index] += part;
      gamma_[term.index] -= y_[i] * part;
    }
  }

  bool may_take(std::uint32_t j) const {
    const std::uint32_t g = rows_.group(j);
    return mu_[j] > met && (g == SparseRows::no_group || !is_taken_[g]);
  }

  std::size_t best() const {
    std::size_t best = core_.size();
    double min_score = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < core_.size(); ++k) {
      const std::uint32_t j = core_[k];
      if (!may_take(j)) continue;
      const double score = gamma_[j] > 0 ? gamma_[j] / mu_[j] : gamma_[j] * mu_[j];
      if (score > min_score || (score == min_score && best < core_.size() && j > core_[best])) continue;
      min_score = score;
      best = k;
    }
    return best;
  }

  void take(std::uint32_t j) {
    taken_.push_back(j);
    if (rows_.group(j) != SparseRows::no_group) is_taken_[rows_.group(j)] = true;
    for (const SparseRows::Term& term : rows_.of_column(j)) {
      double& lack = lack_[term.index];
      if (lack <= met) continue;
      count_in(term.index, lack, -1);
      lack -= static_cast<double>(term.a);
      if (lack <= met)
        --open_;
      else
        count_in(term.index, lack, 1);
    }
  }

  void drop_redundant() {
    std::vector<double> spare(rows_.rows());
    for (std::size_t i = 0; i < spare.size(); ++i) spare[i] = -rows_.rhs(i);
    for (const std::uint32_t j : taken_)
      for (const SparseRows::Term& term : rows_.of_column(j))
        spare[term.index] += static_cast<double>(term.a);
    std::stable_sort(taken_.begin(), taken_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rows_.cost(a) > rows_.cost(b); });
    std::erase_if(taken_, [&](std::uint32_t j) {
      const auto terms = rows_.of_column(j);
      const bool is_needed = std::any_of(terms.begin(), terms.end(), [&](const SparseRows::Term& term) {
        return spare[term.index] < static_cast<double>(term.a) - met;
      });
      if (is_needed) return false;
      for (const SparseRows::Term& term : terms) spare[term.index] -= static_cast<double>(term.a);
      return true;
    });
  }

  const SparseRows& rows_;
  std::span<const double> y_;
  std::vector<std::uint32_t> core_, taken_;
  std::vector<double> lack_, mu_, gamma_;
  std::vector<bool> is_taken_;
  std::size_t open_ = 0;
};

}  // namespace

Selection multiplier_greedy(const SparseRows& rows, std::span<const double> y,
                            std::span<const std::uint32_t> core) {
  return Greedy(rows, y, core).run();
}

}  // namespace shelfbeam::detail
