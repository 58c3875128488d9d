#include "shelfbeam/placement/tree/tree_walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "shelfbeam/base/parallel.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double safe = 1e-4;  // what float sums of gains may be off, with room to spare
constexpr float padding = 1e30F;

}  // namespace

TreeWalk::TreeWalk(TreeRun& run, std::span<const float> weights, std::uint32_t number)
    : run_(run), logs_(run.limits.wants_proof), number_(number) {
  const SearchProblem& problem = run.problem;
  chosen_ = problem.installed;
  most_units_ = run.goal.most_units >= chosen_.size() ? run.goal.most_units - chosen_.size() : 0;
  frames_.resize(most_units_ + 1);
  for (const std::uint32_t j : chosen_) spent_ += problem.cost[j];
  if (number > 0) return;

  auto window = std::make_shared<TreeWindow>();
  window->padded = run.matrix.padded_rows();
  for (std::uint32_t i = 0; i < run.matrix.rows(); ++i) window->rows.push_back(i);
  for (std::uint32_t j = 0; j < run.matrix.columns(); ++j) {
    window->slot.push_back(j);
    window->values.insert(window->values.end(), run.matrix.column(j), run.matrix.column(j) + window->padded);
  }
  Frame& root = frames_[0];
  look_through(root, std::move(window));
  std::copy(weights.begin(), weights.end(), root.weight.begin());
  for (const std::uint32_t j : chosen_)
    SearchKernels::receive(run.rule, root.window->column(j), root.value.size(), root.value.data(),
                           root.best.data());
  for (std::uint32_t j = 0; j < problem.available.size(); ++j)
    if (problem.available[j]) root.allowed.push_back(j);
}

// Nothing received, and nothing lacking in the padding.
void TreeWalk::look_through(Frame& frame, std::shared_ptr<const TreeWindow> window) {
  frame.window = std::move(window);
  for (auto* values : {&frame.value, &frame.best, &frame.lacking, &frame.weight, &frame.share, &frame.shift,
                       &frame.counted, &frame.supporters})
    values->assign(frame.window->padded, 0.0F);
  for (std::size_t i = frame.window->rows.size(); i < frame.window->padded; ++i)
    frame.value[i] = frame.best[i] = padding;
}

// Children that have many of their own look through a window of what is left: whoever is met stays met, and
// whoever is forbidden stays so. (Where the target rises, rows that are met no more are found in the end.)
void TreeWalk::narrow(Frame& frame) {
  frame.below = frame.window;
  const TreeWindow& window = *frame.window;
  std::vector<std::uint32_t>& kept = frame.kept;
  kept.clear();
  for (std::uint32_t i = 0; i < window.rows.size(); ++i)
    if (frame.lacking[i] > 0) kept.push_back(i);
  if (4 * kept.size() > 3 * window.rows.size()) return;
  auto narrow = std::make_shared<TreeWindow>();
  constexpr std::size_t block = SearchMatrix::block;
  narrow->padded = (kept.size() + block - 1) / block * block;
  for (const std::uint32_t i : kept) narrow->rows.push_back(window.rows[i]);
  narrow->slot.assign(window.slot.size(), 0);
  narrow->values.assign(frame.allowed.size() * narrow->padded, 0.0F);
  float* to = narrow->values.data();
  for (std::uint32_t c = 0; c < frame.allowed.size(); ++c, to += narrow->padded) {
    const float* const from = window.column(frame.allowed[c]);
    narrow->slot[frame.allowed[c]] = c;
    for (std::size_t i = 0; i < kept.size(); ++i) to[i] = from[kept[i]];
  }
  frame.below = std::move(narrow);
}

void TreeWalk::log_weights(Frame& frame, Proof::Tag tag, float price) {
  if (!logs_) return;
  constexpr std::size_t most = 1 << 16;
  if (frame.weights_id == unlogged) {
    if (weights_.size() == most || !run_.may_log(run_.matrix.rows())) {  // too long to be checked
      logs_ = false;
      steps_.assign(1, Proof::open);
      return;
    }
    frame.weights_id = number_ << 16 | static_cast<std::uint32_t>(weights_.size());
    std::vector<float>& whole = weights_.emplace_back(run_.matrix.rows(), 0.0F);
    for (std::size_t i = 0; i < frame.window->rows.size(); ++i)
      whole[frame.window->rows[i]] = frame.weight[i];
  }
  log(tag);
  log(frame.weights_id);
  log(std::bit_cast<std::uint32_t>(price));
}

void TreeWalk::move_log_to(Proof& proof) {
  if (proof.weights.size() <= number_) proof.weights.resize(number_ + 1);
  proof.weights[number_] = std::move(weights_);
  proof.steps.insert(proof.steps.end(), steps_.begin(), steps_.end());
  for (std::size_t k = 0; k < children_.size(); ++k) {
    proof.steps.push_back(columns_of_children_[k]);
    children_[k]->move_log_to(proof);
  }
}

// Gains and supporters of the allowed columns.
void TreeWalk::score(Frame& frame, std::size_t units) {
  const std::size_t rows = frame.value.size();
  const std::int64_t most_cost = run_.most_cost();  // once: other threads lower it
  frame.by_cost = run_.problem.question.combination == Combination::weighted && run_.problem.has_costs &&
                  most_cost > spent_ && most_cost < std::numeric_limits<std::int64_t>::max();
  const double divisor =
      static_cast<double>(frame.by_cost ? most_cost - spent_ : static_cast<std::int64_t>(units)) *
      (1 + search_tolerance);
  for (std::size_t i = 0; i < rows; ++i)
    frame.share[i] = static_cast<float>(static_cast<double>(frame.lacking[i]) / divisor);
  if (is_sum(run_.rule))
    for (std::size_t i = 0; i < rows; ++i) {
      frame.shift[i] = static_cast<float>(Proof::shift) * frame.lacking[i] / static_cast<float>(units);
      frame.counted[i] = frame.lacking[i] - static_cast<float>(units) * frame.shift[i];
    }
  else
    frame.counted = frame.lacking;
  std::fill(frame.supporters.begin(), frame.supporters.end(), 0.0F);
  frame.gain.resize(frame.allowed.size());
  const SearchKernels::Rows of_node = rows_of(frame);
  run_.count_work((frame.allowed.size() + 4) * rows);
  for (std::size_t c = 0; c < frame.allowed.size(); ++c) {
    const std::uint32_t j = frame.allowed[c];
    const float scale = frame.by_cost ? static_cast<float>(run_.problem.cost[j]) : 1.0F;
    frame.gain[c] =
        SearchKernels::gain(run_.rule, frame.window->column(j), scale, of_node, frame.supporters.data());
  }
}

SearchKernels::Rows TreeWalk::rows_of(const Frame& frame) const {
  return {frame.counted.data(), frame.weight.data(), frame.share.data(),
          frame.shift.data(),   run_.target(),       frame.value.size()};
}

TreeWalk::Bound TreeWalk::surrogate(const Frame& frame, std::size_t units) {
  // Sum of the largest `units` positive ones of gain - price x cost, and of one fewer.
  const auto largest_sums = [&](double price) {
    top_.assign(units, 0.0);
    for (std::size_t c = 0; c < frame.gain.size(); ++c) {
      double value = static_cast<double>(frame.gain[c]);
      if (price > 0) value -= price * static_cast<double>(run_.problem.cost[frame.allowed[c]]);
      if (value <= top_.back()) continue;
      std::size_t place = units - 1;
      for (; place > 0 && top_[place - 1] < value; --place) top_[place] = top_[place - 1];
      top_[place] = value;
    }
    double sum = 0;
    for (std::size_t k = 0; k + 1 < units; ++k) sum += top_[k];
    return std::pair(sum + top_.back(), sum);
  };
  Bound bound;
  bound.need =
      static_cast<double>(SearchKernels::need(frame.counted.data(), frame.weight.data(), frame.value.size()));
  std::tie(bound.most, bound.without_one) = largest_sums(0);
  const std::int64_t left = cost_left();
  if (!run_.problem.has_costs || left <= 0 || run_.most_cost() == std::numeric_limits<std::int64_t>::max())
    return bound;
  for (const double part : {0.3, 0.5, 0.7, 0.8, 0.9, 0.96}) {
    const auto price = static_cast<float>(part * bound.need / static_cast<double>(left));
    const double paid = static_cast<double>(price) * static_cast<double>(left);
    const auto [most, without_one] = largest_sums(static_cast<double>(price));
    if (paid + most >= bound.most) continue;
    bound.most = paid + most;
    bound.without_one = paid + without_one;
    bound.price = price;
  }
  return bound;
}

// A step of multiplicative weights: rows that the best columns serve ill count more.
void TreeWalk::sharpen(Frame& frame, std::size_t units) {
  frame.order.resize(frame.allowed.size());
  for (std::uint32_t c = 0; c < frame.order.size(); ++c) frame.order[c] = c;
  const std::size_t count = std::min(units, frame.order.size());
  std::partial_sort(frame.order.begin(), frame.order.begin() + static_cast<std::ptrdiff_t>(count),
                    frame.order.end(), [&](std::uint32_t a, std::uint32_t b) {
                      return frame.gain[a] > frame.gain[b] || (frame.gain[a] == frame.gain[b] && a < b);
                    });
  load_.assign(frame.value.size(), 0.0F);
  for (std::size_t k = 0; k < count; ++k)
    SearchKernels::load(run_.rule, frame.window->column(frame.allowed[frame.order[k]]), rows_of(frame),
                        load_.data());
  constexpr float rate = 0.4F, least = 1e-6F;
  float largest = 0;
  for (std::size_t i = 0; i < load_.size(); ++i) {
    frame.weight[i] *= std::exp(rate * std::clamp(1 - load_[i], -2.0F, 1.0F));
    if (frame.lacking[i] > 0) largest = std::max(largest, frame.weight[i]);
  }
  if (largest > 0)
    for (float& weight : frame.weight) weight = std::max(weight / largest, least);
  frame.weights_id = unlogged;
}

std::size_t TreeWalk::forbid_useless(Frame& frame, const Bound& bound) {
  const double least = bound.need * (1 - safe) - bound.without_one;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < frame.allowed.size(); ++c) {
    const std::uint32_t j = frame.allowed[c];
    const double value = static_cast<double>(frame.gain[c]) -
                         static_cast<double>(bound.price) * static_cast<double>(run_.problem.cost[j]);
    if (value < least) continue;
    frame.allowed[kept] = j;
    frame.gain[kept++] = frame.gain[c];
  }
  const std::size_t forbidden = frame.allowed.size() - kept;
  frame.allowed.resize(kept);
  frame.gain.resize(kept);
  return forbidden;
}

// Whether the node is left over after bounds and fixing; then its gains and supporters are fresh enough.
bool TreeWalk::bound(std::size_t depth) {
  Frame& frame = frames_[depth];
  const std::size_t units = units_left(depth);
  const int steps = depth == 0 ? 150 : units >= 5 ? 20 : units == 4 ? 12 : units == 3 ? 8 : 0;
  constexpr double hopeless = 1.5;
  for (int step = 0;; ++step) {
    score(frame, units);
    const Bound now = surrogate(frame, units);
    if (now.most < now.need * (1 - safe)) {
      log_weights(frame, Proof::sum_fails, now.price);
      return false;
    }
    const std::size_t before = frame.allowed.size(), forbidden = forbid_useless(frame, now);
    if (forbidden > 0) log_weights(frame, Proof::filter, now.price);
    if (step >= steps && 10 * forbidden <= before) return true;
    if (depth > 0 && step >= 2 && now.most > hopeless * now.need) return true;
    if (step < steps) sharpen(frame, units);
  }
}

// Children are the allowed columns that give the row its share, the most useful first.
void TreeWalk::branch_on(std::size_t depth, std::uint32_t row, double least) {
  Frame& frame = frames_[depth];
  frame.order.clear();
  for (std::uint32_t c = 0; c < frame.allowed.size(); ++c) {
    const std::uint32_t j = frame.allowed[c];
    const double scale = frame.by_cost ? static_cast<double>(run_.problem.cost[j]) : 1;
    const auto given = static_cast<double>(run_.all.column(j)[row]);
    if (given > 0 && given >= scale * least) frame.order.push_back(c);
  }
  if (frame.gain.size() == frame.allowed.size())
    std::sort(frame.order.begin(), frame.order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return frame.gain[a] > frame.gain[b] || (frame.gain[a] == frame.gain[b] && a < b);
    });
  for (std::uint32_t& c : frame.order) c = frame.allowed[c];
  log(Proof::branch);
  log(row);
  log(frame.by_cost ? 1 : 0);
  log(static_cast<std::uint32_t>(frame.order.size()));
  if (logs_ && !run_.may_log(2 * frame.order.size())) {
    logs_ = false;
    steps_.assign(1, Proof::open);
  }
}

// The row with the fewest columns that give it its share.
void TreeWalk::choose_branch(std::size_t depth) {
  Frame& frame = frames_[depth];
  const std::size_t none = frame.window->rows.size();
  std::size_t best = none;
  for (std::size_t i = 0; i < none; ++i)
    if (frame.lacking[i] > 0 &&
        (best == none || frame.supporters[i] < frame.supporters[best] ||
         (frame.supporters[i] == frame.supporters[best] && frame.lacking[i] > frame.lacking[best])))
      best = i;
  const double share = static_cast<double>(frame.share[best]);
  const std::uint32_t row = run_.matrix.row(frame.window->rows[best]);
  if (is_sum(run_.rule)) {
    branch_on(depth, row, share);
    return;
  }
  // Whoever reaches the label gives it one unit of what it lacks, whatever that costs.
  frame.by_cost = false;
  branch_on(depth, row, static_cast<double>(run_.target()));
}

// The chosen columns meet every row of the search. Where another row is left unmet, or more margin is asked
// for, the search goes on with that row.
void TreeWalk::complete(std::size_t depth) {
  Frame& frame = frames_[depth];
  constexpr double largest = 1e5;  // as in TreeRun::target
  const Margin margin = run_.offer(chosen_, memory_);
  const double target = std::min(run_.exact_target(), largest);
  const std::size_t units = units_left(depth);
  const bool may_improve =
      !margin.is_met || (run_.goal.kind == TreeGoal::Kind::widest && margin.smallest < padding);
  if (margin.smallest < target) run_.miss(margin.label);
  if (!may_improve || run_.found_any()) {
    log(Proof::cost_fails);  // an answer: whatever is better is cheaper
    return;
  }
  if (units == 0) {
    log(Proof::row_fails);
    log(margin.label);
    return;
  }
  const double lacking = std::max(0.0, target - margin.smallest) / static_cast<double>(units);
  const double least = is_sum(run_.rule) ? std::max(lacking * (1 - search_tolerance) - 1e-12, 1e-30)
                                         : target * (1 - search_tolerance);
  frame.gain.clear();
  frame.by_cost = false;
  branch_on(depth, margin.label, least);
  frame.below = frame.window;
  visit_children(depth);
}

// One unit is left to choose: it must do all that is lacking.
void TreeWalk::take_last(std::size_t depth) {
  Frame& frame = frames_[depth];
  std::size_t hardest = 0;
  for (std::size_t i = 1; i < frame.window->rows.size(); ++i)
    if (frame.lacking[i] > frame.lacking[hardest]) hardest = i;
  const float target = run_.target();
  const bool sums = is_sum(run_.rule);
  const float least = sums ? frame.lacking[hardest] : target;
  bool is_open = false;
  for (const std::uint32_t j : frame.allowed) {
    const float* const column = frame.window->column(j);
    if (column[hardest] < least || spent_ + run_.problem.cost[j] > run_.most_cost()) continue;
    run_.count_work(frame.value.size());
    if (!SearchKernels::suffices(run_.rule, column, frame.lacking.data(), target, frame.value.size()))
      continue;
    if (run_.ends()) {
      is_open = true;
      break;
    }
    chosen_.push_back(j);
    const Margin margin = run_.offer(chosen_, memory_);
    if (margin.smallest < run_.exact_target()) run_.miss(margin.label);
    chosen_.pop_back();
  }
  log(is_open ? Proof::open : Proof::single_fails);
}

void TreeWalk::forbid(Frame& frame, std::uint32_t column) {
  const auto place = std::lower_bound(frame.allowed.begin(), frame.allowed.end(), column);
  if (place != frame.allowed.end() && *place == column) frame.allowed.erase(place);
}

void TreeWalk::make_child(const Frame& parent, std::uint32_t column, Frame& child) {
  look_through(child, parent.below);
  if (parent.below == parent.window) {
    child.value = parent.value;
    child.best = parent.best;
    child.weight = parent.weight;
  } else {
    for (std::size_t i = 0; i < parent.kept.size(); ++i) {
      child.value[i] = parent.value[parent.kept[i]];
      child.best[i] = parent.best[parent.kept[i]];
      child.weight[i] = parent.weight[parent.kept[i]];
    }
  }
  SearchKernels::receive(run_.rule, child.window->column(column), child.value.size(), child.value.data(),
                         child.best.data());
  child.weights_id = parent.weights_id;
  const auto& excluded = run_.problem.excludes[column];
  child.allowed.clear();
  for (const std::uint32_t j : parent.allowed)
    if (j != column && std::find(excluded.begin(), excluded.end(), j) == excluded.end())
      child.allowed.push_back(j);
}

void TreeWalk::visit_children(std::size_t depth) {
  const std::vector<std::uint32_t> order = frames_[depth].order;
  for (const std::uint32_t j : order) {
    log(j);
    make_child(frames_[depth], j, frames_[depth + 1]);
    chosen_.push_back(j);
    spent_ += run_.problem.cost[j];
    visit(depth + 1);
    spent_ -= run_.problem.cost[j];
    chosen_.pop_back();
    forbid(frames_[depth], j);
  }
}

// False where the node is done: found, cut, failed or completed.
bool TreeWalk::enter(std::size_t depth) {
  if (run_.ends()) {
    log(Proof::open);
    return false;
  }
  if (spent_ > run_.most_cost()) {
    log(Proof::cost_fails);
    return false;
  }
  Frame& frame = frames_[depth];
  if (!SearchKernels::lack(run_.rule, frame.value.data(), frame.best.data(), run_.target(),
                           frame.value.size(), frame.lacking.data())) {
    complete(depth);
    return false;
  }
  const std::size_t units = units_left(depth);
  if (units == 0) {
    const auto row = std::find_if(frame.lacking.begin(), frame.lacking.end(), [](float l) { return l > 0; });
    log(Proof::row_fails);
    log(run_.matrix.row(frame.window->rows[static_cast<std::size_t>(row - frame.lacking.begin())]));
    return false;
  }
  if (run_.problem.has_costs)
    std::erase_if(frame.allowed,
                  [&](std::uint32_t j) { return spent_ + run_.problem.cost[j] > run_.most_cost(); });
  if (units == 1) {
    take_last(depth);
    return false;
  }
  if (!bound(depth)) return false;
  choose_branch(depth);
  if (units > 2)
    narrow(frame);
  else
    frame.below = frame.window;
  return true;
}

void TreeWalk::visit(std::size_t depth) {
  if (enter(depth)) visit_children(depth);
}

void TreeWalk::from_root() {
  if (run_.goal.most_units + 1 <= chosen_.size()) {  // installed units alone are too many
    log(Proof::cost_fails);
    return;
  }
  if (enter(0)) children_in_parallel();
}

// Walks that are limited by work know nothing of those beside them: what they find must not depend on timing.
void TreeWalk::children_in_parallel() {
  columns_of_children_ = frames_[0].order;
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
      children_[first + k]->frames_.clear();  // of many children they would add up
    });
    for (const auto& part : parts) run_.join(*part);
  }
}

void TreeWalk::add_child(TreeRun& run, std::uint32_t column) {
  auto walk =
      std::make_unique<TreeWalk>(run, frames_[0].weight, static_cast<std::uint32_t>(children_.size() + 1));
  walk->make_child(frames_[0], column, walk->frames_[1]);
  walk->frames_[1].weights_id = unlogged;
  walk->chosen_.push_back(column);
  walk->spent_ += run_.problem.cost[column];
  children_.push_back(std::move(walk));
  forbid(frames_[0], column);
}

}  // namespace shelfbeam::detail
