#include "shelfbeam/placement/answer/incumbent.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace shelfbeam::detail {

void Incumbent::replace(const Selection& selected, double value) {
  selected_ = selected;
  value_ = value;
}

bool Incumbent::offer(const Selection& selected, double value) {
  if (!(value < value_)) return false;
  replace(selected, value);
  return true;
}

bool Incumbent::raise(double bound, BoundProof proof, std::string_view step) {
  const bool is_wrong = contradicts(bound);
  bound = steps_.rounded(bound);
  if (proof == BoundProof::solver && has_selection() && !is_closed() && !is_wrong &&
      value_ - bound <= steps_.solver_tolerance(value_)) {
    is_closed_ = true;
    proof_ = proof;
  }
  if (!(bound > bound_)) return false;
  if (is_wrong) {
    if (proof == BoundProof::solver) return false;
    throw std::logic_error(
        fmt::format("{}: a lower bound of {} contradicts a selection of {}", step, bound, value_));
  }
  bound_ = std::min(bound, value_);
  proof_ = proof;
  return true;
}

std::string Incumbent::text() const {
  const double gap = value_ > bound_ ? 100 * (value_ - bound_) / value_ : 0;
  return fmt::format("best {:.6g}, bound {:.6g}, gap {:.1f} %", value_, bound_, gap);
}

std::vector<std::string> ids_of(const SignalTable& table, std::span<const ColumnId> selected) {
  std::vector<std::string> ids;
  ids.reserve(selected.size());
  for (const ColumnId j : selected) ids.push_back(table.transceivers[j].id);
  return ids;
}

void report_incumbent(const RunControl& control, const SignalTable& table, const Selection& selected,
                      double value, double bound) {
  if (control.progress == nullptr) return;
  control.progress->bounds(value, bound);
  control.progress->selection(ids_of(table, selected));
}

}  // namespace shelfbeam::detail
