#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam::detail {

/// The best selection known of a goal that minimises a value, and the best lower bound on this value.
/// Selections must have passed the checker. No bound exceeds the value, unless a solver's was wrong.
class Incumbent {
 public:
  Incumbent(const ValueSteps& steps, double trivial_bound) : steps_(steps), bound_(trivial_bound) {}

  bool has_selection() const { return value_ < std::numeric_limits<double>::infinity(); }
  const Selection& selected() const { return selected_; }
  double value() const { return value_; }  ///< infinite without a selection
  double bound() const { return bound_; }  ///< infinite: no selection exists
  BoundProof proof() const { return proof_; }
  const ValueSteps& steps() const { return steps_; }
  /// The value is proven, or that no selection exists.
  bool is_closed() const {
    return is_closed_ || (has_selection() ? value_ - bound_ <= steps_.tolerance(value_)
                                          : bound_ == std::numeric_limits<double>::infinity());
  }

  /// Replaces the selection, better or not.
  void replace(const Selection& selected, double value);
  /// Replaces the selection if the value is better; true then.
  bool offer(const Selection& selected, double value);
  /// The bound is above the value, so it is wrong.
  bool contradicts(double bound) const {
    constexpr double rounding = 1e-6, half = 0.5;
    const double error =
        steps_.sees_steps(value_) ? std::min(rounding * value_, half * steps_.step()) : rounding * value_;
    return steps_.rounded(bound) > value_ + std::max(error, steps_.solver_tolerance(value_));
  }
  /// Raises the bound; true if it rises. One that contradicts the selection is ignored if it is a solver's;
  /// our own methods throw std::logic_error with the name of the step then. A solver's bound within its
  /// tolerance of the value closes the gap.
  bool raise(double bound, BoundProof proof, std::string_view step);
  /// Sets the proof to the weaker of this one and `proof`, since the result reports one proof for both
  /// bounds.
  void rest_on(BoundProof proof) { proof_ = std::max(proof_, proof); }

  std::string text() const;

 private:
  ValueSteps steps_;
  Selection selected_;
  double value_ = std::numeric_limits<double>::infinity();
  double bound_ = 0;
  BoundProof proof_ = BoundProof::trivial;
  bool is_closed_ = false;
};

std::vector<std::string> ids_of(const SignalTable& table, std::span<const ColumnId> selected);

/// Reports a selection, its value and the bound; to be followed by a report of the task.
void report_incumbent(const RunControl& control, const SignalTable& table, const Selection& selected,
                      double value, double bound);

}  // namespace shelfbeam::detail
