#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/bound/count_bound.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"
#include "shelfbeam/placement/tree/tree_search.hpp"

namespace shelfbeam::detail {

// Values that differ by less are equal; sums of other orders differ by less.
inline constexpr double equal_values = 1e-9;
inline constexpr double no_limit_s = 1e8;
inline constexpr std::uint64_t any_steps = std::numeric_limits<std::uint64_t>::max();

/// The best selection that a search knows and the best bound of what comes first: the count (lexicographic),
/// or the whole sum (weighted). No selection gets in here without the checker, and no bound above it.
class Incumbent {
 public:
  /// `start` is a selection that the checker accepts, `bounds` are those of what comes first.
  Incumbent(const SignalTable& table, const Question& question, const CostBounds& bounds,
            const Selection& start);

  const Selection& selected() const { return selected_; }
  double value() const { return value_; }
  double bound() const { return bound_; }
  BoundProof proof() const { return proof_; }
  bool is_closed() const { return solver_closed_ || value_ - bound_ <= equal_values * value_; }

  /// The second objective (lexicographic), or the whole sum (weighted).
  double value_of(const Selection& selected) const;

  /// Takes a selection over, better or not; false where the checker rejects it.
  bool accept(const Selection& selected);
  /// Takes it over where it is better; true then.
  bool offer(const std::optional<Selection>& found);
  /// True where the bound rises. A bound above a selection that the checker accepts is wrong: a solver may
  /// err, and is not believed; what we proved ourselves must not, and std::logic_error names the step that
  /// did.
  bool raise(double bound, BoundProof proof, std::string_view step);
  /// A solver says that a selection is optimal, to a gap of its own, which is wider than ours.
  void close_by_solver(const std::optional<Selection>& proven);
  /// Both bounds of an answer rest on the weaker of two proofs.
  void rest_on(BoundProof proof) { proof_ = std::max(proof_, proof); }

  std::string text() const;

 private:
  std::optional<double> first_value(const Selection& selected) const;

  const SignalTable& table_;
  const Question& question_;
  const CostBounds& bounds_;
  bool is_weighted_;
  Selection selected_;
  double value_ = std::numeric_limits<double>::infinity();
  double bound_ = 0;
  BoundProof proof_ = BoundProof::trivial;
  bool solver_closed_ = false;
};

/// The second objective of a lexicographic question, at the fewest units.
struct SecondObjective {
  std::vector<double> cost;
  CostBounds bounds;
  double value;
  /// No selection of the fewest units has less; where their number is not proven, none of at least as many as
  /// are known to be needed.
  double lower_bound;
  bool solver_closed = false;

  bool is_closed() const { return solver_closed || value - lower_bound <= equal_values * value; }
};

/// What the steps of one search share: the question, what is known of its answer, and what is left of the
/// time. Whatever is at work, those who watch are told the best selection and the bound.
struct SearchState final : ProgressSink {
  SearchState(const SignalTable& table, const Question& question, const Selection& start,
              const Solvers& solvers, double time_limit_s, std::uint64_t seed, const RunControl& control,
              const SearchLimits& limits);
  SearchState(const SearchState&) = delete;

  const SignalTable& table;
  const Question& question;
  const Solvers& solvers;
  const SearchLimits& limits;
  Deadline deadline;
  std::uint32_t seed;
  SearchProblem problem;
  bool is_weighted;
  std::vector<double> first_cost;      ///< of every column in what comes first
  CostBounds bounds;                   ///< that follow from them
  std::optional<SearchMatrix> matrix;  ///< of all rows, where there is room for it
  std::optional<TreeSearch> tree;      ///< begins with the rows and weights that were found to matter
  Incumbent incumbent;
  std::optional<SecondObjective> second;  ///< once what comes first is done with
  std::optional<DualBound> relaxation;    ///< of what comes first
  std::string asked;                      ///< name and version of the last solver; empty where none was asked
  ProgressSink* watcher;
  RunControl control;     ///< reports by way of this
  std::string_view step;  ///< that is at work

  bool is_closed() const { return incumbent.is_closed() && (!second || second->is_closed()); }
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
  bool fits_mip() const { return !solvers.only_linear && table.entries.size() <= limits.most_mip_entries; }
  bool may_ask_mip() const { return fits_mip() || (!solvers.only_linear && is_cover()); }
  /// Tree searches take questions about so many units.
  bool has_tree(std::size_t units) const {
    return matrix && table.rows() * table.columns() <= limits.most_places_of_trees &&
           units <= limits.most_units_of_trees;
  }

  void offer(const std::optional<Selection>& found) {
    if (incumbent.offer(found)) tell();
  }
  void raise(double bound, BoundProof proof) {
    if (incumbent.raise(bound, proof, step)) tell();
  }
  /// The same of the second objective.
  void offer_second(const std::optional<Selection>& found);
  void raise_second(double bound, BoundProof proof);

  /// What reductions leave of a cover; made when it is first asked for.
  const Reduction& reduction();

  void tell() const { control.report("placing", -1); }
  void report(std::string_view stage, double fraction, std::string_view detail) override;

 private:
  std::optional<Reduction> reduction_;
};

// What a search is made of. Each step raises a bound or offers a selection, or both.

/// Weighted: asks a tree for a cheaper selection. Otherwise from the bound upwards: is there a selection of
/// so many units? The first that there is is the best, and every number without one raises the bound.
void raise_bound_by_tree(SearchState& state, const Effort& effort);

/// By linear programs, each solver in turn, until one has an answer that can be relied on: the bound of the
/// count, or of the whole sum. Their rows and dual solution are what trees begin with.
void raise_bound_by_lp(SearchState& state, const Effort& effort);

/// Asks for what reductions leave, or about the whole model where they do not apply.
void ask_mip(SearchState& state, const Effort& effort);

// The least second objective among the selections of no more units than the best known.
void bound_second_by_lp(SearchState& state, const Effort& effort);
void search_second_by_tree(SearchState& state, const Effort& effort);
void ask_mip_for_second(SearchState& state, const Effort& effort);

/// Of the selections that cost no more than the best known, that with the widest margin, then with the
/// fewest units, then the first by id. Begins with `start` where that is one of them, is limited by work,
/// and knows nothing that timing may have had a part in: the same for any number of threads. True where all
/// were looked at.
bool settle_ties(SearchState& state, const Selection& start);

}  // namespace shelfbeam::detail
