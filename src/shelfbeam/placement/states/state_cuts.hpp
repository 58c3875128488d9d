#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/states/state_table.hpp"

namespace shelfbeam {

/// The cuts of place_over_states.hpp, as rows of a table with requirement 1.
///
/// For selections of at most K units a cut may use smaller shares: parts below s give a case at most s K in
/// all, so a case that is met has
///
///   sum_j min(1, max(0, a_j - s) / (1 - s K)) x_j >= 1,   a_j the share of unit j.
class StateCuts {
 public:
  /// Begins with one cut per label, over all states. The arguments must outlive the object.
  StateCuts(const StateTable& states, const PlacementProblem& problem, const MissAllowance& allowance);

  const SignalTable& table() const { return table_; }
  std::size_t size() const { return table_.rows(); }

  /// Adds cuts that a selection violates, if it misses labels too often. Returns their number.
  std::size_t add(std::span<const std::uint32_t> selected, const StateMisses& misses);
  /// Adds the cuts of labels that a solution of a linear program violates most, for selections of at most
  /// `max_units` units, without unit failure. Labels that are not examined before the deadline give none.
  /// Returns the number of cuts; apart from the deadline, it does not depend on the threads.
  std::size_t add_violated(std::span<const double> x, std::size_t max_units, const Deadline& deadline,
                           const RunControl& control);

 private:
  /// A label in a state.
  struct Case {
    std::uint32_t label = 0, state = 0;
    double received = 0;  ///< from the selection, as a share of the requirement
  };
  /// The parts of shares that count.
  struct Counted {
    double above = 0, lack = 1;  ///< s and 1 - s K
    double of(double share) const;
  };
  /// A unit with its value in a linear program.
  struct Part {
    std::uint32_t column = 0;
    double x = 0;
  };
  struct Cut {
    double left_side = 1;
    std::vector<double> shares;
  };

  double requirement(std::size_t label) const {
    return requirement_of(states_.table.labels[label], problem_.model);
  }
  double share(const Case& at, std::uint32_t column) const;
  double mean_of_largest(std::span<const Case> cases, std::size_t kept, std::uint32_t column,
                         const Counted& counted, std::vector<double>& shares) const;
  std::vector<double> mean_of_largest(std::span<const Case> cases, std::size_t kept,
                                      const Counted& counted) const;
  double left_side(const std::vector<double>& shares, std::span<const std::uint32_t> selected) const;
  std::vector<Case> cases_of(std::size_t label, std::span<const std::uint32_t> selected) const;
  void add_cuts(std::vector<Case> cases, std::size_t allowed, bool by_state,
                std::span<const std::uint32_t> selected);
  std::vector<double> violated_cut(std::span<const Case> cases, std::size_t allowed,
                                   std::span<const std::uint32_t> selected) const;
  Cut most_violated(std::uint32_t label, std::span<const Part> parts, std::size_t max_units) const;
  std::vector<double> cover_cut(std::vector<Case> cases, std::size_t allowed, bool by_state,
                                std::span<const std::uint32_t> selected) const;
  void append(const std::vector<double>& shares);

  const StateTable& states_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  SignalTable table_;
};

}  // namespace shelfbeam
