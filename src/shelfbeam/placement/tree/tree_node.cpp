#include "shelfbeam/placement/tree/tree_node.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace shelfbeam::detail {

TreeWindow::TreeWindow(const SearchMatrix& whole)
    : rows(whole.rows()), slot(whole.columns()), padded(whole.padded_rows()) {
  std::iota(rows.begin(), rows.end(), 0U);
  std::iota(slot.begin(), slot.end(), 0U);
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

void TreeNode::take(const TreeNode& parent, std::uint32_t column, Receiving rule,
                    std::span<const std::uint32_t> excluded) {
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
  for (const std::uint32_t j : parent.allowed)
    if (j != column && std::find(excluded.begin(), excluded.end(), j) == excluded.end()) allowed.push_back(j);
}

void TreeNode::forbid(std::uint32_t column) {
  const auto place = std::lower_bound(allowed.begin(), allowed.end(), column);
  if (place != allowed.end() && *place == column) allowed.erase(place);
}

}  // namespace shelfbeam::detail
