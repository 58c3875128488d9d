#include "shelfbeam/placement/search_state.hpp"

#include <string>

#include <fmt/format.h>

#include "shelfbeam/placement/mip/export_model.hpp"

namespace shelfbeam::detail {

void SearchProgress::report(std::string_view stage, double, std::string_view detail) {
  if (sink_ == nullptr) return;
  const std::string below = stage == task ? "" : fmt::format("; {}", stage);
  sink_->report(task, -1, fmt::format("{}{} {}", incumbent_.text(), below, detail));
}

SearchState::SearchState(const SignalTable& t, const Question& q, const Selection& start, const Solvers& s,
                         double time_limit_s, const SearchLimits& l, const RunControl& c)
    : table(t),
      question(q),
      solvers(s),
      limits(l),
      deadline(l.step_limit ? no_limit_s : time_limit_s),
      problem(t, q),
      is_weighted(q.combination == Combination::weighted),
      first_cost(first_objective(t, q)),
      bounds(t, first_cost),
      incumbent(t, q, bounds, start),
      progress(incumbent, c.progress),
      control{c.threads, c.cancel, c.progress == nullptr ? nullptr : &progress} {
  if (t.rows() * t.columns() <= l.most_places_of_local_search) matrix.emplace(t, q.model);
}

const Reduction& SearchState::reduction() {
  if (!reduction_) {
    std::vector<bool> pinned(table.apart.empty() ? 0 : table.columns(), false);
    for (const auto& [a, b] : table.apart) pinned[a] = pinned[b] = true;
    reduction_ = reduce_cover(table, question, first_cost, pinned, [this] { return out_of_time(); });
  }
  return *reduction_;
}

}  // namespace shelfbeam::detail
