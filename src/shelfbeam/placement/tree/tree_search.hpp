#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/tree/proof.hpp"

namespace shelfbeam::detail {

/// The goal of a tree search among the feasible selections that contain the installed units, have at most
/// `max_units` units and cost at most `max_cost`.
struct TreeGoal {
  enum class Kind {
    any,       ///< the first one found
    cheapest,  ///< minimum cost
    widest     ///< largest minimum margin, then fewest units, then first by ids; better than `start`
  };
  Kind kind = Kind::any;
  std::size_t max_units = 0;
  std::int64_t max_cost = std::numeric_limits<std::int64_t>::max();
  Selection start = {};  ///< for widest: ascending; a feasible selection, or empty
};

struct TreeResult {
  bool is_complete = false;           ///< exhaustive: nothing better exists
  std::optional<Selection> selected;  ///< ascending
  std::uint64_t nodes = 0;
  Proof proof;  ///< that nothing better exists; complete only if requested and `is_complete`
};

/// Exact depth-first search for selections of few units: pigeonhole branching, surrogate bounds and filtering
/// (docs/methods/placement.md). Rows are lazy: it starts with the hardest rows and adds rows that selections
/// miss. Every result has passed received_signal on the whole table.
///
/// The selection of `any`, and of `cheapest` among equal costs, may depend on timing unless work limits the
/// search. Existence, minimum cost and largest margin do not.
class TreeSearch {
 public:
  /// The arguments must outlive the object. `all` contains all rows of the table.
  TreeSearch(const Instance& instance, const SearchMatrix& all);

  /// Starts with these rows and weights, such as those of an LP and its dual solution.
  void begin_with(std::span<const LabelId> rows, std::span<const double> weights);

  struct Limits {
    Effort effort = {};
    bool wants_proof = false;
    /// Maximum number of matrix cells examined; 0: no limit. With this limit, the result is the same for any
    /// number of threads, complete or not, unless another limit comes first.
    std::uint64_t work = 0;
  };
  TreeResult run(const TreeGoal& goal, const Limits& limits, const RunControl& control);

 private:
  void choose_rows(std::size_t units);

  const Instance& instance_;
  const SearchMatrix& all_;
  Receiving rule_;
  std::vector<LabelId> rows_;
  std::vector<float> weights_;  ///< of rows_, at the root of the last search
  std::optional<SearchMatrix> matrix_;
};

}  // namespace shelfbeam::detail
