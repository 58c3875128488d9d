#include "shelfbeam/placement/incumbent.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::detail {

Incumbent::Incumbent(const SignalTable& table, const Question& question, const CostBounds& bounds,
                     const Selection& start)
    : table_(table),
      question_(question),
      bounds_(bounds),
      is_weighted_(question.combination == Combination::weighted) {
  accept(start);
  const std::size_t count = least_count(table, question);
  bound_ = is_weighted_ ? bounds.cheapest(count) : static_cast<double>(count);
}

double Incumbent::value_of(const Selection& selected) const {
  const Check check = check_selection(table_, question_, selected);
  return check.objective + (is_weighted_ ? check.transceiver_cost : 0);
}

// Nothing for what the checker rejects.
std::optional<double> Incumbent::first_value(const Selection& selected) const {
  const Check check = check_selection(table_, question_, selected);
  if (!check.met()) return std::nullopt;
  return is_weighted_ ? check.objective + check.transceiver_cost : static_cast<double>(selected.size());
}

bool Incumbent::accept(const Selection& selected) {
  const std::optional<double> value = first_value(selected);
  if (!value) return false;
  selected_ = selected;
  value_ = *value;
  return true;
}

bool Incumbent::offer(const std::optional<Selection>& found) {
  if (!found) return false;
  const std::optional<double> value = first_value(*found);
  if (!value || *value >= value_) return false;
  selected_ = *found;
  value_ = *value;
  return true;
}

bool Incumbent::raise(double bound, BoundProof proof, std::string_view step) {
  bound = bounds_.rounded(bound);
  if (!(bound > bound_)) return false;
  if (bound > value_ * (1 + 1e-6)) {
    if (proof == BoundProof::solver) return false;
    throw std::logic_error(
        fmt::format("{}: a lower bound of {} contradicts a selection of {}", step, bound, value_));
  }
  bound_ = std::min(bound, value_);
  proof_ = proof;
  return true;
}

void Incumbent::close_by_solver(const std::optional<Selection>& proven) {
  if (!proven || is_closed()) return;
  const std::optional<double> value = first_value(*proven);
  if (!value || *value > value_ * (1 + equal_values)) return;
  solver_closed_ = true;
  if (!is_weighted_) bound_ = value_;
  proof_ = BoundProof::solver;
}

std::string Incumbent::text() const {
  const double gap = value_ > bound_ ? 100 * (value_ - bound_) / value_ : 0;
  return fmt::format("best {:.6g}, at least {:.6g}, gap {:.1f} %", value_, bound_, gap);
}

}  // namespace shelfbeam::detail
