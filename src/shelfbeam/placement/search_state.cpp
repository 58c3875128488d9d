#include "shelfbeam/placement/search_state.hpp"

#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"

namespace shelfbeam::detail {

SearchState::SearchState(const Instance& of, const std::optional<Selection>& start,
                         std::span<const milp::Backend> b, const PlaceOptions& o, const Deadline& d,
                         const RunControl& c, const SearchLimits& l)
    : instance(of),
      backends(b),
      options(o),
      limits(l),
      deadline(d),
      searches(start && o.uses(SolverChoice::search)),
      seed(static_cast<std::uint32_t>(mix_key(o.seed, 0))),
      incumbent(of.bounds, of.is_weighted() ? of.bounds.cheapest(of.trivial_count_bound())
                                            : static_cast<double>(of.trivial_count_bound())),
      watcher(c.progress),
      control{c.threads, c.cancel, c.progress == nullptr ? nullptr : this} {
  if (start) incumbent.replace(*start, of.value_of(*start));
  if (!searches) return;
  if (of.rows() * of.columns() <= l.max_cells_of_local_search) matrix.emplace(of);
  if (has_tree(0)) tree.emplace(instance, *matrix);
}

void SearchState::offer_second(const std::optional<Selection>& found) {
  if (!found || found->size() != incumbent.selected().size()) return;
  const double first = instance.value_of(*found);
  if (first <= incumbent.value() && second->offer(*found, instance.second_value_of(*found)))
    incumbent.replace(*found, first);
}

void SearchState::raise_second(double bound, BoundProof proof) {
  second->raise(bound, proof, step);
  incumbent.rest_on(second->proof());
}

const Reduction& SearchState::reduction() {
  if (!reduction_) {
    reduction_ = reduction_without(useless);
    reduced_without_ = useless.size();
  }
  return *reduction_;
}

Reduction SearchState::reduction_below(double cost) const {
  if (!relaxation) return reduction_without(useless);
  return reduction_without(united(useless, useless_columns(*relaxation, cost)));
}

Reduction SearchState::reduction_without(std::span<const ColumnId> columns) const {
  std::vector<bool> pinned(instance.table.conflicts.empty() ? 0 : instance.columns(), false);
  for (const auto& [a, b] : instance.table.conflicts) pinned[a] = pinned[b] = true;
  return reduce_cover(instance, instance.first_cost, pinned, [this] { return out_of_time(); }, columns);
}

bool SearchState::exclude(const DualBound& dual) {
  return exclude(useless_columns(dual, instance.bounds.below(incumbent.value())));
}

bool SearchState::exclude(std::span<const ColumnId> columns) {
  std::vector<ColumnId> all = united(useless, columns);
  if (all.size() == useless.size()) return false;
  useless = std::move(all);
  // Few further columns are not worth another reduction.
  constexpr std::size_t part = 20;
  if ((useless.size() - reduced_without_) * part < instance.columns() - useless.size()) return false;
  reduction_.reset();
  return true;
}

SelectionSet SearchState::open_selections() {
  if (!instance.is_cover()) return {.without = useless};
  SelectionSet open;
  std::vector<bool> is_out(instance.columns(), true);
  for (const ColumnId j : reduction().forced) {
    is_out[j] = false;
    if (!instance.is_installed(j)) open.with.push_back(j);
  }
  for (const CoverPart& part : reduction().parts)
    for (const ColumnId j : part.columns) is_out[j] = false;
  open.without = numbers_where<ColumnId>(is_out);
  return open;
}

void SearchState::report(Task stage, double, std::string_view detail) {
  if (!incumbent.has_selection()) return watcher->report(stage, -1, detail);
  const std::string below = stage == Task::placing ? "" : fmt::format("; {}", to_text(stage));
  watcher->bounds(incumbent.value(), incumbent.bound());
  if (reported_ != incumbent.selected()) {
    reported_ = incumbent.selected();
    watcher->selection(ids_of(instance.table, reported_));
  }
  watcher->report(Task::placing, -1, fmt::format("{}{} {}", incumbent.text(), below, detail));
}

}  // namespace shelfbeam::detail
