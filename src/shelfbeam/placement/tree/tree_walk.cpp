#include "shelfbeam/placement/tree/tree_walk.hpp"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

void ProofLog::add_weighing(TreeNode& node, Proof::Tag tag, float price) {
  if (!logs_) return;
  constexpr std::size_t max_weighings = 1 << 16;
  if (node.weights_id == TreeNode::unlogged) {
    if (weights_.size() == max_weighings || !run_.may_log(run_.matrix.rows())) return give_up();
    node.weights_id = number_ << 16 | static_cast<std::uint32_t>(weights_.size());
    std::vector<float>& whole = weights_.emplace_back(run_.matrix.rows(), 0.0F);
    for (std::size_t i = 0; i < node.window->rows.size(); ++i) whole[node.window->rows[i]] = node.weight[i];
  }
  add(tag);
  add(node.weights_id);
  add(std::bit_cast<std::uint32_t>(price));
}

void ProofLog::add_branch(LabelId row, bool by_cost, std::span<const ColumnId> columns) {
  add(Proof::branch);
  add(row);
  add(by_cost ? 1 : 0);
  add(static_cast<std::uint32_t>(columns.size()));
  if (logs_ && !run_.may_log(2 * columns.size())) give_up();
}

void ProofLog::move_to(Proof& proof) {
  if (proof.weights.size() <= number_) proof.weights.resize(number_ + 1);
  proof.weights[number_] = std::move(weights_);
  proof.steps.insert(proof.steps.end(), steps_.begin(), steps_.end());
}

void ProofLog::give_up() {
  logs_ = false;
  steps_.assign(1, Proof::open);
}

TreeWalk::TreeWalk(TreeRun& run, std::span<const float> weights, std::uint32_t number)
    : run_(run), log_(run, number), surrogate_(run) {
  const Instance& instance = run.instance;
  chosen_ = instance.installed;
  max_units_ = run.goal.max_units >= chosen_.size() ? run.goal.max_units - chosen_.size() : 0;
  nodes_.resize(max_units_ + 1);
  for (const ColumnId j : chosen_) spent_ += instance.cost[j];
  if (number > 0) return;

  TreeNode& root = nodes_[0];
  root.look_through(std::make_shared<TreeWindow>(run.matrix));
  std::copy(weights.begin(), weights.end(), root.weight.begin());
  for (const ColumnId j : chosen_)
    SearchKernels::receive(run.rule, root.window->column(j), root.value.size(), root.value.data(),
                           root.best.data());
  root.allowed = numbers_where<ColumnId>(instance.available);
}

void TreeWalk::move_log_to(Proof& proof) {
  log_.move_to(proof);
  for (std::size_t k = 0; k < children_.size(); ++k) {
    proof.steps.push_back(columns_of_children_[k]);
    children_[k]->move_log_to(proof);
  }
}

// Tests the surrogate bound with improving weights. False if it closes the node; otherwise gains and
// supporters are up to date for branching.
bool TreeWalk::may_complete(std::size_t depth) {
  TreeNode& node = nodes_[depth];
  const std::size_t units = units_left(depth);
  const int steps = depth == 0 ? 150 : units >= 5 ? 20 : units == 4 ? 12 : units == 3 ? 8 : 0;
  constexpr double hopeless = 1.5;
  for (int step = 0;; ++step) {
    surrogate_.score(node, units, spent_);
    const Surrogate now = surrogate_.of(node, units, spent_);
    if (now.closes_node()) {
      log_.add_weighing(node, Proof::sum_fails, now.price);
      return false;
    }
    const std::size_t before = node.allowed.size(), forbidden = surrogate_.filter(node, now);
    if (forbidden > 0) log_.add_weighing(node, Proof::filter, now.price);
    if (step >= steps && 10 * forbidden <= before) return true;
    if (depth > 0 && step >= 2 && now.largest > hopeless * now.need) return true;
    if (step < steps) surrogate_.sharpen(node, units);
  }
}

// Children: the allowed columns that contribute the pigeonhole share to the row, the largest gain first.
void TreeWalk::branch_on(std::size_t depth, LabelId row, double needed) {
  TreeNode& node = nodes_[depth];
  std::vector<std::uint32_t> order;  // places in A
  for (std::uint32_t c = 0; c < node.allowed.size(); ++c) {
    const std::uint32_t j = node.allowed[c];
    const double scale = node.by_cost ? static_cast<double>(run_.instance.cost[j]) : 1;
    const auto given = static_cast<double>(run_.all.column(j)[row]);
    if (given > 0 && given >= scale * needed) order.push_back(c);
  }
  if (node.gain.size() == node.allowed.size())
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return node.gain[a] > node.gain[b] || (node.gain[a] == node.gain[b] && a < b);
    });
  node.order.clear();
  for (const std::uint32_t c : order) node.order.push_back(node.allowed[c]);
  log_.add_branch(row, node.by_cost, node.order);
}

// Branches on the row with the fewest supporters.
void TreeWalk::choose_branch(std::size_t depth) {
  TreeNode& node = nodes_[depth];
  const std::size_t none = node.window->rows.size();
  std::size_t best = none;
  for (std::size_t i = 0; i < none; ++i)
    if (node.lacking[i] > 0 &&
        (best == none || node.supporters[i] < node.supporters[best] ||
         (node.supporters[i] == node.supporters[best] && node.lacking[i] > node.lacking[best])))
      best = i;
  const double share = static_cast<double>(node.share[best]);
  const LabelId row = run_.matrix.row(node.window->rows[best]);
  if (is_sum(run_.rule)) {
    branch_on(depth, row, share);
    return;
  }
  // Every column that reaches the label contributes 1 to its lack, at any cost.
  node.by_cost = false;
  branch_on(depth, row, static_cast<double>(run_.target()));
}

// The chosen columns meet every row of the search. If they miss another row, or a larger margin is sought,
// the search branches on the row of the smallest margin.
void TreeWalk::complete(std::size_t depth) {
  TreeNode& node = nodes_[depth];
  constexpr double largest = 1e5;  // as in TreeRun::target
  constexpr double beyond_measure = 1e30;
  const Margin margin = run_.offer(chosen_, memory_);
  const double target = std::min(run_.exact_target(), largest);
  const std::size_t units = units_left(depth);
  const bool may_improve =
      !margin.is_met || (run_.goal.kind == TreeGoal::Kind::widest && margin.smallest < beyond_measure);
  if (margin.smallest < target) run_.miss(margin.label);
  if (!may_improve || run_.found_any()) {
    log_.add(Proof::cost_fails);  // feasible: anything better is cheaper
    return;
  }
  if (units == 0) {
    log_.add(Proof::row_fails);
    log_.add(margin.label);
    return;
  }
  const double lacking = std::max(0.0, target - margin.smallest) / static_cast<double>(units);
  const double needed = is_sum(run_.rule) ? std::max(lacking * (1 - search_tolerance) - 1e-12, 1e-30)
                                          : target * (1 - search_tolerance);
  node.gain.clear();
  node.by_cost = false;
  branch_on(depth, margin.label, needed);
  node.below = node.window;
  visit_children(depth);
}

// The last unit must supply the whole lack.
void TreeWalk::take_last(std::size_t depth) {
  TreeNode& node = nodes_[depth];
  const auto hardest = std::ranges::max_element(node.lacking);
  const float target = run_.target();
  const bool sums = is_sum(run_.rule);
  const float needed = sums ? *hardest : target;
  bool is_open = false;
  for (const ColumnId j : node.allowed) {
    const float* const column = node.window->column(j);
    if (column[hardest - node.lacking.begin()] < needed || spent_ + run_.instance.cost[j] > run_.max_cost())
      continue;
    run_.count_work(node.value.size());
    if (!SearchKernels::suffices(run_.rule, column, node.lacking.data(), target, node.value.size())) continue;
    if (run_.ends()) {
      is_open = true;
      break;
    }
    chosen_.push_back(j);
    const Margin margin = run_.offer(chosen_, memory_);
    if (margin.smallest < run_.exact_target()) run_.miss(margin.label);
    chosen_.pop_back();
  }
  log_.add(is_open ? Proof::open : Proof::single_fails);
}

void TreeWalk::visit_children(std::size_t depth) {
  const std::vector<ColumnId> order = nodes_[depth].order;
  for (const ColumnId j : order) {
    log_.add(j);
    make_child(nodes_[depth], j, nodes_[depth + 1]);
    chosen_.push_back(j);
    spent_ += run_.instance.cost[j];
    visit(depth + 1);
    spent_ -= run_.instance.cost[j];
    chosen_.pop_back();
    nodes_[depth].forbid(j);
  }
}

// False if the node is closed: feasible, cut off by a limit, or pruned.
bool TreeWalk::enter(std::size_t depth) {
  if (run_.ends()) {
    log_.add(Proof::open);
    return false;
  }
  if (spent_ > run_.max_cost()) {
    log_.add(Proof::cost_fails);
    return false;
  }
  TreeNode& node = nodes_[depth];
  if (!SearchKernels::lack(run_.rule, node.value.data(), node.best.data(), run_.target(), node.value.size(),
                           node.lacking.data())) {
    complete(depth);
    return false;
  }
  const std::size_t units = units_left(depth);
  if (units == 0) {
    const auto row = std::find_if(node.lacking.begin(), node.lacking.end(), [](float l) { return l > 0; });
    log_.add(Proof::row_fails);
    log_.add(run_.matrix.row(node.window->rows[static_cast<std::size_t>(row - node.lacking.begin())]));
    return false;
  }
  if (run_.instance.has_costs)
    std::erase_if(node.allowed,
                  [&](std::uint32_t j) { return spent_ + run_.instance.cost[j] > run_.max_cost(); });
  if (units == 1) {
    take_last(depth);
    return false;
  }
  if (!may_complete(depth)) return false;
  choose_branch(depth);
  if (units > 2)
    node.narrow();
  else
    node.below = node.window;
  return true;
}

void TreeWalk::visit(std::size_t depth) {
  if (enter(depth)) visit_children(depth);
}

void TreeWalk::from_root() {
  if (run_.goal.max_units + 1 <= chosen_.size()) {  // the installed units alone are too many
    log_.add(Proof::cost_fails);
    return;
  }
  if (enter(0)) children_in_parallel();
}

// With a work limit, parallel walks share nothing, so results do not depend on timing.
void TreeWalk::children_in_parallel() {
  columns_of_children_ = nodes_[0].order;
  const std::size_t count = columns_of_children_.size();
  constexpr std::size_t parts_at_once = 8, shares = 4;
  const bool in_parts = run_.limits.work > 0;
  const std::size_t at_once = in_parts ? parts_at_once : std::max<std::size_t>(count, 1);
  for (std::size_t first = 0; first < count; first += at_once) {
    const std::size_t last = std::min(first + at_once, count);
    std::vector<std::unique_ptr<TreeRun>> parts;
    for (std::size_t k = first; k < last; ++k) {
      if (in_parts) parts.push_back(std::make_unique<TreeRun>(run_, shares));
      add_child(in_parts ? *parts.back() : run_, columns_of_children_[k]);
    }
    for_each_task(last - first, [&](std::size_t k) {
      children_[first + k]->visit(1);
      children_[first + k]->nodes_.clear();  // the nodes of many children would add up
    });
    for (const auto& part : parts) run_.join(*part);
  }
}

void TreeWalk::add_child(TreeRun& run, ColumnId column) {
  auto walk =
      std::make_unique<TreeWalk>(run, nodes_[0].weight, static_cast<std::uint32_t>(children_.size() + 1));
  walk->make_child(nodes_[0], column, walk->nodes_[1]);
  walk->nodes_[1].weights_id = TreeNode::unlogged;
  walk->chosen_.push_back(column);
  walk->spent_ += run_.instance.cost[column];
  children_.push_back(std::move(walk));
  nodes_[0].forbid(column);
}

}  // namespace shelfbeam::detail
