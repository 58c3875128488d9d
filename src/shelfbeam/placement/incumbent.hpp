#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"

namespace shelfbeam::detail {

using Selection = std::vector<std::uint32_t>;

// Values that differ by less are equal; sums of other orders differ by less.
inline constexpr double equal_values = 1e-9;

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

}  // namespace shelfbeam::detail
