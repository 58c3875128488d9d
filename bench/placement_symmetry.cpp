#include "placement_symmetry.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"
#include "shelfbeam/placement/tree/tree_search.hpp"

#include "placement_instances.hpp"
#include "support.hpp"

namespace shelfbeam::bench {

namespace {

using Columns = std::vector<std::uint32_t>;

struct Effort {
  std::uint64_t nodes = 0;
  double seconds = 0;
  bool is_complete = true;
};

// The place of every candidate in the grid of all x and y.
struct Grid {
  std::vector<std::size_t> x, y;
  std::size_t wide = 0, deep = 0;
};

std::optional<Grid> grid_of(const SignalTable& table) {
  std::vector<double> xs, ys;
  for (const auto& unit : table.transceivers) {
    if (!unit.position) return std::nullopt;
    xs.push_back(unit.position->x);
    ys.push_back(unit.position->y);
  }
  const auto places = [](const std::vector<double>& values, std::size_t& count) {
    std::vector<double> distinct = values;
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end(),
                               [](double a, double b) { return std::abs(a - b) < 1e-6; }),
                   distinct.end());
    count = distinct.size();
    std::vector<std::size_t> result;
    result.reserve(values.size());
    for (const double value : values)
      result.push_back(static_cast<std::size_t>(
          std::lower_bound(distinct.begin(), distinct.end(), value - 1e-6) - distinct.begin()));
    return result;
  };
  Grid grid;
  grid.x = places(xs, grid.wide);
  grid.y = places(ys, grid.deep);
  return grid;
}

class Search {
 public:
  Search(const SignalTable& table, const Question& question, double limit)
      : problem_(table, question), all_(table, question.model), tree_(problem_, all_), limit_(limit) {}

  // Is there a selection of so many units?
  Effort run(std::size_t units, Columns included, Columns excluded) {
    detail::TreeGoal goal;
    goal.most_units = units;
    goal.included = std::move(included);
    goal.excluded = std::move(excluded);
    detail::TreeSearch::Limits limits;
    limits.until =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                               std::chrono::duration<double>(limit_));
    Effort effort;
    effort.seconds = wall_seconds([&] {
      const detail::TreeAnswer answer = tree_.run(goal, limits, {});
      effort.nodes = answer.nodes;
      effort.is_complete = answer.is_complete;
    });
    return effort;
  }

  // The columns of which every selection of so many units holds one: those that give some label its share.
  Columns branch(std::size_t units) const {
    const bool is_sum = detail::is_sum(detail::receiving(problem_.question));
    const float least = (is_sum ? 1.0F / static_cast<float>(units) : 1.0F) * (1 - 1e-4F);
    Columns best(all_.columns() + 1);
    for (std::size_t i = 0; i < all_.rows(); ++i) {
      Columns supporters;
      for (std::uint32_t j = 0; j < all_.columns(); ++j)
        if (problem_.available[j] && all_.column(j)[i] >= least) supporters.push_back(j);
      if (supporters.size() < best.size()) best = std::move(supporters);
    }
    return best;
  }

 private:
  detail::SearchProblem problem_;
  detail::SearchMatrix all_;
  detail::TreeSearch tree_;
  double limit_;
};

/// The root's children one by one; `images` are excluded together with a child that has been ruled out.
Effort branch_by_branch(Search& search, std::size_t units,
                        const std::function<Columns(std::uint32_t)>& images) {
  Effort sum;
  Columns excluded;
  for (const std::uint32_t j : search.branch(units)) {
    if (std::find(excluded.begin(), excluded.end(), j) != excluded.end()) continue;
    const Effort child = search.run(units, {j}, excluded);
    sum.nodes += child.nodes;
    sum.seconds += child.seconds;
    sum.is_complete = sum.is_complete && child.is_complete;
    excluded.push_back(j);
    for (const std::uint32_t image : images(j)) excluded.push_back(image);
  }
  return sum;
}

void print(const std::string& instance, const Question& question, const char* what, std::size_t count,
           const Effort& effort) {
  fmt::print("{:<18} {:<16} {:<36} {:>5} {:>11} {:>9.3f}{}\n", instance, name_of(model_names, question.model),
             what, count, effort.nodes, effort.seconds, effort.is_complete ? "" : " stopped");
  std::fflush(stdout);
}

// Without the columns that are not kept.
SignalTable coarser(const SignalTable& table, const std::vector<bool>& keeps) {
  SignalTable result;
  result.labels = table.labels;
  std::vector<std::uint32_t> place(table.columns());
  for (std::uint32_t j = 0; j < table.columns(); ++j) {
    place[j] = static_cast<std::uint32_t>(result.transceivers.size());
    if (keeps[j]) result.transceivers.push_back(table.transceivers[j]);
  }
  result.row_begin = {0};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    for (const SignalEntry& entry : table.row(i))
      if (keeps[entry.transceiver]) result.entries.push_back({place[entry.transceiver], entry.signal});
    result.row_begin.push_back(result.entries.size());
  }
  return result;
}

void print_one(const std::string& name, const SignalTable& table, const Grid& grid, const Question& question,
               double limit) {
  const auto of_grid = [&](const char* what, const std::function<bool(std::size_t)>& keep) {
    std::vector<bool> keeps;
    for (std::size_t j = 0; j < table.columns(); ++j) keeps.push_back(keep(j));
    const SignalTable part = coarser(table, keeps);
    const Placement best = place(part, question, {.time_limit_s = limit});
    if (best.status != Status::optimal || best.count() < 2) {
      fmt::print("{:<18} {:<16} {:<36} {}\n", name, name_of(model_names, question.model), what,
                 name_of(status_names, best.status));
      return std::size_t{0};
    }
    Search search(part, question, limit);
    print(name, question, what, best.count(), search.run(best.count() - 1, {}, {}));
    return best.count();
  };
  const std::size_t count = of_grid("all candidates", [](std::size_t) { return true; });
  of_grid("every second (as on a chessboard)",
          [&](std::size_t j) { return (grid.x[j] + grid.y[j]) % 2 == 0; });
  of_grid("every fourth (twice the spacing)",
          [&](std::size_t j) { return grid.x[j] % 2 == 0 && grid.y[j] % 2 == 0; });
  if (count < 2) return;

  const auto at = [&](std::size_t x, std::size_t y) {
    Columns found;
    for (std::uint32_t j = 0; j < table.columns(); ++j)
      if (grid.x[j] == x && grid.y[j] == y) found.push_back(j);
    return found;
  };
  Search plain(table, question, limit), mirrored(table, question, limit);
  print(name, question, "all, branch by branch", count,
        branch_by_branch(plain, count - 1, [](std::uint32_t) { return Columns(); }));
  print(name, question, "all, without mirrored branches", count,
        branch_by_branch(mirrored, count - 1, [&](std::uint32_t j) {
          const std::size_t x = grid.x[j], y = grid.y[j];
          const std::size_t left = grid.wide - 1 - x, back = grid.deep - 1 - y;
          Columns all;
          for (const auto& [a, b] : {std::pair(left, y), std::pair(x, back), std::pair(left, back)})
            for (const std::uint32_t image : at(a, b))
              if (image != j) all.push_back(image);
          return all;
        }));
}

}  // namespace

void print_symmetry(const std::vector<std::string>& files, const std::vector<double>& scales, double limit) {
  fmt::print(
      "Proof that the least number of units less one is not enough.\n{:<18} {:<16} {:<36} {:>5} {:>11} "
      "{:>9}\n",
      "instance", "model", "candidates", "count", "nodes", "s");
  for_instances(files, scales, [&](const std::string& name, const SignalTable& table) {
    const auto grid = grid_of(table);
    if (!grid) {
      fmt::print("{:<18} has no positions\n", name);
      return;
    }
    for (const auto model : {CommunicationModel::non_cooperative, CommunicationModel::cooperative})
      print_one(name, table, *grid, {.model = model}, limit);
  });
}

}  // namespace shelfbeam::bench
