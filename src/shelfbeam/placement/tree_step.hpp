#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/search_state.hpp"
#include "shelfbeam/placement/tree/tree_search.hpp"

namespace shelfbeam::detail {

/// What a search asks of trees. Each begins with the rows and weights that the last one, or a linear program,
/// found to matter.
class TreeStep {
 public:
  explicit TreeStep(SearchState& state);

  /// The rows of a linear program and its dual solution.
  void begin_with(const LpBound& lp);

  /// Weighted: asks for a cheaper selection. Otherwise from the bound upwards: is there a selection of so
  /// many units? The first that there is is the best, and every number without one raises the bound.
  void raise_bound(const Effort& effort);

  struct Cheapest {
    std::optional<Selection> selected;  ///< cheaper than the best known
    double cost_lower_bound = 0;        ///< of the second objective
    std::optional<BoundProof> proof;    ///< of that bound; nothing where there is none
  };
  /// The least second objective among the selections of no more units than the best known.
  Cheapest cheapest(const Effort& effort);

  /// Of the selections that cost no more than the best known, that with the widest margin, then with the
  /// fewest units, then the first by id. Begins with `start` where that is one of them, is limited by work,
  /// and knows nothing that timing may have had a part in: the same for any number of threads. True where all
  /// were looked at.
  bool settle_ties(const Selection& start);

 private:
  void raise_count_bound(const Effort& effort);
  void raise_cost_bound(const Effort& effort);
  Cheapest cheaper(std::size_t most_units, const Effort& effort);
  std::optional<BoundProof> strength_of(const Proof& proof) const;
  double cost_lower_bound(std::int64_t most, std::size_t units) const;

  SearchState& state_;
  std::optional<TreeSearch> tree_;
};

}  // namespace shelfbeam::detail
