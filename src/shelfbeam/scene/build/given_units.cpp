#include "shelfbeam/scene/build/given_units.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/scene/expect_running.hpp"

namespace shelfbeam {

namespace {

constexpr const char* in_keep_out = "it is in a 'keep_out' area";

class GivenUnits {
 public:
  GivenUnits(const Store& store, const std::set<std::string>& kept_out, Scene& scene)
      : store_(store), kept_out_(kept_out), units_(scene.transceivers) {
    ids_.reserve(units_.size());
    for (const Transceiver& unit : units_) {
      index_.emplace(unit.id, static_cast<std::uint32_t>(ids_.size()));
      ids_.emplace_back(unit.id);
    }
  }

  void mark(const std::vector<Listed<std::string>>& ids, bool Transceiver::* is_marked) {
    for (const auto& [id, where] : ids) {
      const auto found = index_.find(id);
      if (found == index_.end())
        throw InputError(where, fmt::format("names the unknown transceiver {}", in_quotes(id)),
                         is_kept_out(id) ? in_keep_out : "list it, or correct the id");
      units_[found->second].*is_marked = true;
      given_.emplace_back(found->second, where);
    }
  }

  void mark_pinned() {
    for (const auto& pattern : store_.pinned) {
      const std::vector<std::uint32_t> found = matching(pattern);
      if (found.empty()) refuse(pattern, is_kept_out(pattern.value) ? in_keep_out : "");
      for (const std::uint32_t j : found) {
        units_[j].pinned = !units_[j].installed;
        given_.emplace_back(j, pattern.where);
      }
    }
  }

  void expect_one_at_a_point() const {
    const DistinctPositions groups = distinct_positions(positions_of(units_));
    std::vector<const Transceiver*> at(groups.count, nullptr);
    for (const auto& [j, where] : given_) {
      const Transceiver& unit = units_[j];
      const Transceiver*& first = at[groups.group_of[j]];
      if (first != nullptr && first != &unit)
        throw InputError(where,
                         fmt::format("{} is {} at the mounting point of {}", in_quotes(unit.id),
                                     state_of(unit), in_quotes(first->id)),
                         "remove one of the two, or correct a position");
      first = &unit;
    }
  }

  std::vector<bool> excluded() const {
    std::vector<bool> excluded(units_.size());
    for (const auto& pattern : store_.excluded) {
      const std::vector<std::uint32_t> found = matching(pattern);
      if (found.empty() && !is_kept_out(pattern.value)) refuse(pattern, {});
      for (const std::uint32_t j : found) {
        const Transceiver& unit = units_[j];
        if (unit.is_chosen())
          throw InputError(pattern.where,
                           fmt::format("excludes the {} unit {}", state_of(unit), in_quotes(unit.id)),
                           "remove the unit from one of the two lists");
        excluded[j] = true;
      }
    }
    return excluded;
  }

 private:
  static const char* state_of(const Transceiver& unit) {
    return unit.installed ? "installed" : unit.pinned ? "pinned" : "selected";
  }

  bool is_kept_out(std::string_view pattern) const {
    return std::any_of(kept_out_.begin(), kept_out_.end(),
                       [&](const auto& id) { return matches_glob(id, pattern); });
  }

  std::vector<std::uint32_t> matching(const Listed<std::string>& pattern) const {
    expect_running(store_.cancel);
    if (const auto found = index_.find(pattern.value); found != index_.end()) return {found->second};
    return matching_ids(pattern.value, ids_);
  }

  [[noreturn]] void refuse(const Listed<std::string>& pattern, const std::string& remedy) const {
    throw InputError(pattern.where, fmt::format("{} matches no transceiver", in_quotes(pattern.value)),
                     remedy.empty() ? suggest(pattern.value, ids_) : remedy);
  }

  const Store& store_;
  const std::set<std::string>& kept_out_;
  std::vector<Transceiver>& units_;
  std::vector<std::string_view> ids_;
  std::unordered_map<std::string_view, std::uint32_t> index_;
  /// Installed, pinned and selected units, each with its location in the store.
  std::vector<std::pair<std::uint32_t, std::string>> given_;
};

void leave_out(const std::vector<bool>& excluded, Scene& scene, DeviceSources& sources) {
  std::vector<Transceiver> candidates;
  std::vector<std::string> their_sources;
  for (std::size_t j = 0; j < excluded.size(); ++j) {
    (excluded[j] ? scene.excluded : candidates).push_back(std::move(scene.transceivers[j]));
    (excluded[j] ? sources.excluded : their_sources).push_back(std::move(sources.transceivers[j]));
  }
  scene.transceivers = std::move(candidates);
  sources.transceivers = std::move(their_sources);
}

}  // namespace

void mark_given_units(const Store& store, const std::set<std::string>& kept_out, Scene& scene,
                      DeviceSources& sources) {
  if (store.installed.empty() && store.pinned.empty() && store.selected.empty() && store.excluded.empty())
    return;
  GivenUnits units(store, kept_out, scene);
  units.mark(store.installed, &Transceiver::installed);
  units.mark_pinned();
  units.mark(store.selected, &Transceiver::selected);
  units.expect_one_at_a_point();
  const std::vector<bool> excluded = units.excluded();
  if (std::find(excluded.begin(), excluded.end(), false) == excluded.end())
    throw InputError(store.excluded.back().where, "leaves no candidate", "exclude fewer");
  leave_out(excluded, scene, sources);
}

}  // namespace shelfbeam
