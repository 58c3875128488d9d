#include "shelfbeam/placement/tree/tree_search.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/tree/row_weights.hpp"
#include "shelfbeam/placement/tree/tree_walk.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::size_t rows_at_first = 128;

}  // namespace

TreeSearch::TreeSearch(const Instance& instance, const SearchMatrix& all)
    : instance_(instance), all_(all), rule_(receiving(instance.problem)) {}

// The rows that multiplicative weights find hardest for `units` units.
void TreeSearch::choose_rows(std::size_t units) {
  rows_ = all_numbers<LabelId>(all_.rows());
  weights_.assign(all_.rows(), 1.0F);
  if (all_.rows() <= rows_at_first) return;
  const std::size_t padded = all_.padded_rows();
  std::vector<float> weight(padded, 1.0F), lacking(padded, 0.0F), nothing(padded, 0.0F);
  std::fill_n(lacking.begin(), all_.rows(), 1.0F);
  const SearchKernels::Rows rows{lacking.data(), weight.data(), nothing.data(), nothing.data(), 1.0F, padded};
  const auto columns = numbers_where<ColumnId>(instance_.available);
  std::vector<float> gain(columns.size()), supporters(padded, 0.0F);
  RowWeights weights;
  constexpr int steps = 60;
  constexpr float min_weight = 1e-12F;
  for (int step = 0; step < steps; ++step) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      gain[k] = SearchKernels::gain(rule_, all_.column(columns[k]), 1.0F, rows, supporters.data());
    weights.step(
        rule_, rows, gain, units, [&](std::uint32_t k) { return all_.column(columns[k]); }, min_weight,
        weight);
  }
  std::ranges::partial_sort(rows_, rows_.begin() + rows_at_first, {},
                            [&](LabelId i) { return std::pair(-weight[i], i); });
  rows_.resize(rows_at_first);
  weights_.clear();
  for (const LabelId i : rows_) weights_.push_back(std::max(weight[i], 1e-4F));
}

void TreeSearch::begin_with(std::span<const LabelId> rows, std::span<const double> weights) {
  rows_.assign(rows.begin(), rows.end());
  matrix_.reset();
  const double largest = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
  constexpr double min_weight = 1e-4;
  weights_.clear();
  for (const double weight : weights)
    weights_.push_back(static_cast<float>(largest > 0 ? std::max(weight / largest, min_weight) : 1));
}

TreeResult TreeSearch::run(const TreeGoal& given, const Limits& limits, const RunControl& control) {
  constexpr std::size_t rows_at_once = 32;
  constexpr float weight_of_new = 0.3F;
  TreeResult answer;
  if (rows_.empty()) choose_rows(given.max_units);
  TreeGoal goal = given;
  Limits left = limits;
  while (true) {
    if (!matrix_) matrix_.emplace(instance_, rows_);
    TreeRun run({instance_, all_, *matrix_, goal, left, control});
    TreeWalk root(run, weights_, 0);
    with_threads(control.threads, [&] { root.from_root(); });
    std::copy_n(root.weights().begin(), weights_.size(), weights_.begin());
    answer.nodes += run.nodes();
    if (run.best) {
      answer.selected = run.best;
      if (goal.kind == TreeGoal::Kind::cheapest) goal.max_cost = instance_.cost_of(*run.best) - 1;
      if (goal.kind == TreeGoal::Kind::widest) goal.start = *run.best;
    }
    answer.is_complete = run.is_complete() || (goal.kind == TreeGoal::Kind::any && run.best.has_value());
    if (answer.is_complete || !run.misses_rows() || limits.effort.is_over(control) ||
        answer.nodes >= limits.effort.steps) {
      if (limits.wants_proof) {
        answer.proof.max_units = goal.max_units;
        answer.proof.max_cost = goal.max_cost;
        answer.proof.rows = rows_;
        root.move_log_to(answer.proof);
        answer.proof.is_complete = answer.is_complete && !run.found_any();
      }
      return answer;
    }
    const std::vector<LabelId> missed = run.missed_rows();
    for (std::size_t k = 0; k < std::min(rows_at_once, missed.size()); ++k) {
      rows_.push_back(missed[k]);
      weights_.push_back(weight_of_new);
    }
    matrix_.reset();
    if (limits.work > 0) left.work -= std::min(left.work - 1, run.work());
  }
}

}  // namespace shelfbeam::detail
