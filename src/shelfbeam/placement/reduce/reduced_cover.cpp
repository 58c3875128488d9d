#include "shelfbeam/placement/reduce/reduced_cover.hpp"

#include <algorithm>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam::detail {

namespace {

// The part as a table of its own, where units cost what is minimised.
SignalTable table_of(const SignalTable& table, std::span<const double> cost, const CoverPart& part,
                     const std::vector<bool>& is_out, std::vector<std::uint32_t>& columns) {
  SignalTable own;
  std::vector<std::uint32_t> place(table.columns(), ~std::uint32_t{0});
  for (const std::uint32_t j : part.columns) {
    if (is_out[j]) continue;
    place[j] = static_cast<std::uint32_t>(own.transceivers.size());
    columns.push_back(j);
    own.transceivers.push_back(table.transceivers[j]);
    own.transceivers.back().cost = cost[j];
    own.transceivers.back().installed = false;
  }
  for (const auto& mount : table.mounts) {
    std::vector<std::uint32_t> options;
    for (const std::uint32_t j : mount)
      if (place[j] < own.columns()) options.push_back(place[j]);
    if (options.size() > 1) own.mounts.push_back(std::move(options));
  }
  for (const auto& [a, b] : table.apart)
    if (place[a] < own.columns() && place[b] < own.columns()) own.apart.emplace_back(place[a], place[b]);
  own.row_begin = {0};
  for (const std::uint32_t i : part.labels) {
    own.labels.push_back(table.labels[i]);
    for (const SignalEntry& entry : table.row(i))
      if (place[entry.transceiver] < own.columns())
        own.entries.push_back({place[entry.transceiver], entry.signal});
    own.row_begin.push_back(own.entries.size());
  }
  return own;
}

}  // namespace

ReducedAnswer place_reduced(const SignalTable& table, const Question& question, std::span<const double> cost,
                            const Reduction& reduction, std::span<const std::uint32_t> left_out,
                            const SolveFunction& solve, double time_limit_s, const RunControl& control) {
  const Deadline deadline(time_limit_s);
  ReducedAnswer answer;
  if (reduction.infeasible) return answer;
  std::vector<std::uint32_t> selected = reduction.forced;
  answer.bound = 0;
  for (const std::uint32_t j : reduction.forced) answer.bound += cost[j];
  answer.proven = true;
  bool is_whole = true;
  std::vector<bool> is_out(table.columns(), false);
  for (const std::uint32_t j : left_out) is_out[j] = true;
  const Mounts mounts(table);
  for (const std::uint32_t j : reduction.forced)
    mounts.for_each_excluded(j, [&](std::uint32_t other) { is_out[other] = true; });
  for (const CoverPart& part : reduction.parts) {
    if (part.labels.empty()) continue;
    std::vector<std::uint32_t> columns;
    const SignalTable own = table_of(table, cost, part, is_out, columns);
    Question sum;
    sum.model = question.model;
    sum.combination = Combination::weighted;
    const MipAnswer best = place_by_mip(own, sum, std::nullopt, solve, deadline.seconds_left(), control);
    answer.proven = answer.proven && best.placement.status == Status::optimal;
    answer.failed = answer.failed || best.solver_failed;
    answer.bound += std::max(0.0, best.placement.lower_bound);
    is_whole = is_whole && !best.placement.selected.empty();
    for (const std::uint32_t j : best.placement.selected) selected.push_back(columns[j]);
  }
  std::sort(selected.begin(), selected.end());
  if (is_whole) answer.selected = std::move(selected);
  return answer;
}

ReducedAnswer place_at_count(const SignalTable& table, const Question& question, std::span<const double> cost,
                             const std::vector<std::uint32_t>& start, const SolveFunction& solve,
                             double time_limit_s, const RunControl& control) {
  CoverModel model(table, question, solve, time_limit_s, control);
  const double known = check_selection(table, question, start).objective;
  const CoverModel::Outcome outcome = model.minimise(cost, known, start.size());
  return {outcome.selected, outcome.bound, outcome.proven, outcome.failed};
}

}  // namespace shelfbeam::detail
