#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/incumbent.hpp"
#include "shelfbeam/placement/kernels/effort.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

namespace shelfbeam::detail {

/// Whatever is at work, those who watch are told the best selection and the bound.
class SearchProgress final : public ProgressSink {
 public:
  static constexpr std::string_view task = "placing";

  SearchProgress(const Incumbent& incumbent, ProgressSink* sink) : incumbent_(incumbent), sink_(sink) {}
  void report(std::string_view stage, double fraction, std::string_view detail) override;

 private:
  const Incumbent& incumbent_;
  ProgressSink* sink_;
};

/// What the steps of one search share: the question, what is known of its answer, and what is left of the
/// time.
struct SearchState {
  SearchState(const SignalTable& table, const Question& question, const Selection& start,
              const Solvers& solvers, double time_limit_s, const SearchLimits& limits,
              const RunControl& control);
  SearchState(const SearchState&) = delete;
  SearchState& operator=(const SearchState&) = delete;

  const SignalTable& table;
  const Question& question;
  const Solvers& solvers;
  const SearchLimits& limits;
  Deadline deadline;
  SearchProblem problem;
  bool is_weighted;
  std::vector<double> first_cost;      ///< of every column in what comes first
  CostBounds bounds;                   ///< that follow from them
  std::optional<SearchMatrix> matrix;  ///< of all rows, where there is room for it
  Incumbent incumbent;
  SearchProgress progress;
  RunControl control;     ///< with `progress`
  std::string_view step;  ///< that is at work

  bool out_of_time() const { return control.cancelled() || deadline.has_passed(); }

  /// A tree may end within seconds.
  bool is_small() const {
    return incumbent.selected().size() <= limits.small_answer &&
           table.entries.size() <= limits.most_mip_entries;
  }
  /// `reduce_cover` takes the question.
  bool is_cover() const {
    return question.model == CommunicationModel::non_cooperative && !question.redundant;
  }
  bool may_ask_mip() const {
    return !solvers.only_linear && (is_cover() || table.entries.size() <= limits.most_mip_entries);
  }
  /// Tree searches take questions about so many units.
  bool has_tree(std::size_t units) const {
    return matrix && table.rows() * table.columns() <= limits.most_places_of_trees &&
           units <= limits.most_units_of_trees;
  }

  void offer(const std::optional<Selection>& found) {
    if (incumbent.offer(found)) report();
  }
  void raise(double bound, BoundProof proof) {
    if (incumbent.raise(bound, proof, step)) report();
  }
  void report() const { control.report(SearchProgress::task, -1); }

  /// What reductions leave of a cover; made when it is first asked for.
  const Reduction& reduction();

 private:
  std::optional<Reduction> reduction_;
};

inline constexpr double no_limit_s = 1e8;
inline constexpr std::uint64_t any_steps = std::numeric_limits<std::uint64_t>::max();

/// A line of a schedule: what is run, when, and how long it may take.
template <class Search>
struct Step {
  std::string_view name;
  bool (Search::*applies)() const;
  double share;         ///< of the time that is left when it begins,
  double most_s;        ///< but no more seconds,
  std::uint64_t steps;  ///< and no more moves of local search or nodes of a tree
  void (Search::*run)(const Effort&);

  /// Where work is limited, time is not.
  Effort effort(const SearchState& state) const {
    if (state.limits.step_limit) return {std::min(steps, *state.limits.step_limit), state.deadline.end()};
    return {steps, Deadline(std::min(share * state.deadline.seconds_left(), most_s)).end()};
  }
};

/// Runs the steps that apply, one after the other, until the gap is closed or the time is over.
template <class Search>
void run_schedule(Search& search, std::span<const Step<Search>> schedule, SearchState& state) {
  for (const Step<Search>& step : schedule) {
    if (search.is_closed() || state.out_of_time()) return;
    if (!(search.*step.applies)()) continue;
    state.step = step.name;
    (search.*step.run)(step.effort(state));
  }
}

}  // namespace shelfbeam::detail
