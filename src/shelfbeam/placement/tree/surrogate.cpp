#include "shelfbeam/placement/tree/surrogate.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/tree/proof.hpp"

namespace shelfbeam::detail {

namespace {

constexpr auto no_limit = std::numeric_limits<std::int64_t>::max();

}  // namespace

void SurrogateTest::score(TreeNode& node, std::size_t units, std::int64_t spent) {
  const std::size_t rows = node.value.size();
  const std::int64_t max_cost = run_.max_cost();  // read once: other threads lower it
  node.by_cost =
      run_.instance.is_weighted() && run_.instance.has_costs && max_cost > spent && max_cost < no_limit;
  const double divisor =
      static_cast<double>(node.by_cost ? max_cost - spent : static_cast<std::int64_t>(units)) *
      (1 + search_tolerance);
  for (std::size_t i = 0; i < rows; ++i)
    node.share[i] = static_cast<float>(static_cast<double>(node.lacking[i]) / divisor);
  if (is_sum(run_.rule))
    for (std::size_t i = 0; i < rows; ++i) {
      node.shift[i] = static_cast<float>(Proof::shift) * node.lacking[i] / static_cast<float>(units);
      node.counted[i] = node.lacking[i] - static_cast<float>(units) * node.shift[i];
    }
  else
    node.counted = node.lacking;
  std::fill(node.supporters.begin(), node.supporters.end(), 0.0F);
  node.gain.resize(node.allowed.size());
  const SearchKernels::Rows of_node = rows_of(node);
  run_.count_work((node.allowed.size() + 4) * rows);
  for (std::size_t c = 0; c < node.allowed.size(); ++c) {
    const std::uint32_t j = node.allowed[c];
    const float scale = node.by_cost ? static_cast<float>(run_.instance.cost[j]) : 1.0F;
    node.gain[c] =
        SearchKernels::gain(run_.rule, node.window->column(j), scale, of_node, node.supporters.data());
  }
}

SearchKernels::Rows SurrogateTest::rows_of(const TreeNode& node) const {
  return {node.counted.data(), node.weight.data(), node.share.data(),
          node.shift.data(),   run_.target(),      node.value.size()};
}

// Sums of the b and of the b - 1 largest positive v_j - p c_j.
std::pair<double, double> SurrogateTest::largest_sums(const TreeNode& node, std::size_t units, double price) {
  top_.assign(units, 0.0);
  for (std::size_t c = 0; c < node.gain.size(); ++c) {
    double value = static_cast<double>(node.gain[c]);
    if (price > 0) value -= price * static_cast<double>(run_.instance.cost[node.allowed[c]]);
    if (value <= top_.back()) continue;
    std::size_t place = units - 1;
    for (; place > 0 && top_[place - 1] < value; --place) top_[place] = top_[place - 1];
    top_[place] = value;
  }
  double sum = 0;
  for (std::size_t k = 0; k + 1 < units; ++k) sum += top_[k];
  return {sum + top_.back(), sum};
}

Surrogate SurrogateTest::of(const TreeNode& node, std::size_t units, std::int64_t spent) {
  Surrogate result;
  result.need =
      static_cast<double>(SearchKernels::need(node.counted.data(), node.weight.data(), node.value.size()));
  std::tie(result.largest, result.without_one) = largest_sums(node, units, 0);
  const std::int64_t left = run_.max_cost() - spent;
  if (!run_.instance.has_costs || left <= 0 || run_.max_cost() == no_limit) return result;
  for (const double part : {0.3, 0.5, 0.7, 0.8, 0.9, 0.96}) {
    const auto price = static_cast<float>(part * result.need / static_cast<double>(left));
    const double paid = static_cast<double>(price) * static_cast<double>(left);
    const auto [largest, without_one] = largest_sums(node, units, static_cast<double>(price));
    if (paid + largest >= result.largest) continue;
    result.largest = paid + largest;
    result.without_one = paid + without_one;
    result.price = price;
  }
  return result;
}

std::size_t SurrogateTest::filter(TreeNode& node, const Surrogate& surrogate) const {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < node.allowed.size(); ++c) {
    const std::uint32_t j = node.allowed[c];
    if (surrogate.rules_out(static_cast<double>(node.gain[c]), static_cast<double>(run_.instance.cost[j])))
      continue;
    node.allowed[kept] = j;
    node.gain[kept++] = node.gain[c];
  }
  const std::size_t forbidden = node.allowed.size() - kept;
  node.allowed.resize(kept);
  node.gain.resize(kept);
  return forbidden;
}

void SurrogateTest::sharpen(TreeNode& node, std::size_t units) {
  constexpr float min_weight = 1e-6F;
  weights_.step(
      run_.rule, rows_of(node), node.gain, units,
      [&](std::uint32_t c) { return node.window->column(node.allowed[c]); }, min_weight, node.weight);
  node.weights_id = TreeNode::unlogged;
}

TreeWindow::TreeWindow(const SearchMatrix& whole)
    : rows(all_numbers(whole.rows())), slot(all_numbers(whole.columns())), padded(whole.padded_rows()) {
  for (const std::uint32_t j : slot) values.insert(values.end(), whole.column(j), whole.column(j) + padded);
}

void TreeNode::look_through(std::shared_ptr<const TreeWindow> through) {
  constexpr float met = 1e30F;
  window = std::move(through);
  for (auto* values : {&value, &best, &lacking, &weight, &share, &shift, &counted, &supporters})
    values->assign(window->padded, 0.0F);
  for (std::size_t i = window->rows.size(); i < window->padded; ++i) value[i] = best[i] = met;
}

void TreeNode::narrow() {
  below = window;
  kept.clear();
  for (std::uint32_t i = 0; i < window->rows.size(); ++i)
    if (lacking[i] > 0) kept.push_back(i);
  if (4 * kept.size() > 3 * window->rows.size()) return;
  auto narrow = std::make_shared<TreeWindow>();
  constexpr std::size_t block = SearchMatrix::block;
  narrow->padded = (kept.size() + block - 1) / block * block;
  for (const std::uint32_t i : kept) narrow->rows.push_back(window->rows[i]);
  narrow->slot.assign(window->slot.size(), 0);
  narrow->values.assign(allowed.size() * narrow->padded, 0.0F);
  float* to = narrow->values.data();
  for (std::uint32_t c = 0; c < allowed.size(); ++c, to += narrow->padded) {
    const float* const from = window->column(allowed[c]);
    narrow->slot[allowed[c]] = c;
    for (std::size_t i = 0; i < kept.size(); ++i) to[i] = from[kept[i]];
  }
  below = std::move(narrow);
}

void TreeNode::take(const TreeNode& parent, ColumnId column, Receiving rule,
                    std::span<const ColumnId> excluded) {
  look_through(parent.below);
  if (parent.below == parent.window) {
    value = parent.value;
    best = parent.best;
    weight = parent.weight;
  } else {
    for (std::size_t i = 0; i < parent.kept.size(); ++i) {
      value[i] = parent.value[parent.kept[i]];
      best[i] = parent.best[parent.kept[i]];
      weight[i] = parent.weight[parent.kept[i]];
    }
  }
  SearchKernels::receive(rule, window->column(column), value.size(), value.data(), best.data());
  weights_id = parent.weights_id;
  allowed.clear();
  for (const ColumnId j : parent.allowed)
    if (j != column && std::find(excluded.begin(), excluded.end(), j) == excluded.end()) allowed.push_back(j);
}

void TreeNode::forbid(ColumnId column) {
  const auto place = std::lower_bound(allowed.begin(), allowed.end(), column);
  if (place != allowed.end() && *place == column) allowed.erase(place);
}

}  // namespace shelfbeam::detail
