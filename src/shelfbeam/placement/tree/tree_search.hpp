#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/tree/proof.hpp"

namespace shelfbeam::detail {

/// What a tree search looks for among the selections that meet every label, hold what is installed, have at
/// most `most_units` units and cost at most `most_cost`.
struct TreeGoal {
  enum class Kind {
    any,       ///< one of them
    cheapest,  ///< the least cost
    widest     ///< the largest margin, of equal ones the fewest units, of these the first by id, if that
               ///< is better than `start`
  };
  Kind kind = Kind::any;
  std::size_t most_units = 0;
  std::int64_t most_cost = std::numeric_limits<std::int64_t>::max();
  std::vector<std::uint32_t> start;  ///< for widest: ascending; a selection that meets every label
};

struct TreeAnswer {
  bool is_complete = false;  ///< nothing was left out: what was not found does not exist
  std::optional<std::vector<std::uint32_t>> selected;  ///< ascending
  std::uint64_t nodes = 0;
  Proof proof;  ///< that there is none better; complete only if asked for and `is_complete`
};

/// Exact search for small answers, depth first: pigeonhole branching, surrogate bounds, columns fixed by them
/// (docs/methods/placement.md). Works on rows that matter and takes in others when selections leave them
/// unmet; what is found has passed the contract's rule on the whole table.
///
/// Which selection `any` returns, and `cheapest` of those that cost the same, may depend on timing, unless
/// the search is limited by work; whether there is one, the least cost and the largest margin do not.
class TreeSearch {
 public:
  /// All must outlive it. `all` holds all rows of the table.
  TreeSearch(const SearchProblem& problem, const SearchMatrix& all);

  /// Begins with these rows and weights, such as those of a linear program and its dual solution; others are
  /// taken in when they turn out to matter.
  void begin_with(std::span<const std::uint32_t> rows, std::span<const double> weights);

  struct Limits {
    Effort effort = {};
    bool wants_proof = false;
    /// Places of the matrix that may be looked at; 0: as many as it takes. A search with such a limit finds
    /// the same for any number of threads, complete or not, as long as no other limit comes first.
    std::uint64_t work = 0;
  };
  TreeAnswer run(const TreeGoal& goal, const Limits& limits, const RunControl& control);

 private:
  void choose_rows(std::size_t units);

  const SearchProblem& problem_;
  const SearchMatrix& all_;
  Receiving rule_;
  std::vector<std::uint32_t> rows_;
  std::vector<float> weights_;  ///< of rows_: where the last search began
  std::optional<SearchMatrix> matrix_;
};

}  // namespace shelfbeam::detail
