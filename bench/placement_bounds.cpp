#include "placement_bounds.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/bound/count_bound.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

#include "support.hpp"

namespace shelfbeam::bench {

namespace {

void print_reduction(const SignalTable& table) {
  const PlacementProblem problem{.model = CommunicationModel::non_cooperative};
  const std::vector<double> ones(table.columns(), 1.0);
  detail::Reduction left;
  const double seconds = wall_seconds([&] { left = detail::reduce_cover({table, problem}, ones); });
  std::size_t labels = 0, columns = 0;
  for (const detail::CoverPart& part : left.parts) {
    labels += part.labels.size();
    if (!part.labels.empty()) columns += part.columns.size();
  }
  fmt::print("  non-cooperative: {} x {} left in {} parts, {} forced, {:.3f} s\n", labels, columns,
             left.parts.size(), left.forced.size(), seconds);
}

void print_bound(const SignalTable& table, const milp::Backend& backend, double limit) {
  const PlacementProblem problem;
  const std::vector<double> ones(table.columns(), 1.0);
  detail::LpBound lp;
  const double seconds = wall_seconds([&] {
    lp = detail::lp_bound({table, problem}, ones, backend, {.effort = detail::for_seconds(limit)}, {});
  });
  fmt::print("  cooperative, {:<6} relaxation {:.4f} from {} of {} labels, {:.2f} s{}\n",
             fmt::format("{}:", backend.name), lp.dual.bound, lp.labels.size(), table.rows(), seconds,
             lp.complete ? "" : ", stopped");
  detail::CountBound count;
  const double with_shares = wall_seconds([&] {
    count = detail::count_bound({table, problem}, backend, {.effort = detail::for_seconds(limit)}, {});
  });
  fmt::print("  cooperative, {:<6} count at least {} with shares, {:.2f} s{}\n",
             fmt::format("{}:", backend.name), count.count, with_shares, count.complete ? "" : ", stopped");
  std::fflush(stdout);
}

}  // namespace

void print_bounds(const InstanceChoice& choice, double limit) {
  for_instances(choice, [&](const std::string& name, const SignalTable& table) {
    fmt::print("{}: {} labels, {} candidates\n", name, table.rows(), table.columns());
    print_reduction(table);
    for (const milp::Backend& backend : milp::backends()) print_bound(table, backend, limit);
  });
}

}  // namespace shelfbeam::bench
