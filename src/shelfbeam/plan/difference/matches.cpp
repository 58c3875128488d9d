#include "shelfbeam/plan/difference/matches.hpp"

#include <array>
#include <deque>
#include <map>
#include <utility>

namespace shelfbeam {

namespace {

using Key = std::pair<std::string, std::string>;

Key id_and_value(const Identity& thing) {
  return {thing.id, thing.value};
}
Key value_alone(const Identity& thing) {
  return {"", thing.value};
}
Key id_alone(const Identity& thing) {
  return {thing.id, ""};
}

}  // namespace

std::vector<Match> matches(const std::vector<Identity>& before, const std::vector<Identity>& after,
                           SameBy first) {
  std::array<Key (*)(const Identity&), 3> keys{id_and_value, value_alone, id_alone};
  if (first == SameBy::id) std::swap(keys[1], keys[2]);
  std::vector<std::optional<std::uint32_t>> partner(after.size());
  std::vector<bool> taken(before.size(), false);
  for (const auto key_of : keys) {
    std::map<Key, std::deque<std::uint32_t>> open;
    for (std::uint32_t i = 0; i < before.size(); ++i)
      if (!taken[i]) open[key_of(before[i])].push_back(i);
    for (std::uint32_t j = 0; j < after.size(); ++j) {
      if (partner[j]) continue;
      const auto found = open.find(key_of(after[j]));
      if (found == open.end() || found->second.empty()) continue;
      partner[j] = found->second.front();
      taken[found->second.front()] = true;
      found->second.pop_front();
    }
  }
  std::vector<Match> result;
  result.reserve(after.size());
  for (std::uint32_t j = 0; j < after.size(); ++j) result.push_back({partner[j], j});
  for (std::uint32_t i = 0; i < before.size(); ++i)
    if (!taken[i]) result.push_back({i, std::nullopt});
  return result;
}

}  // namespace shelfbeam
