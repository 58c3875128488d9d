#include "shelfbeam/scene/store/presets.hpp"

#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

void Presets::add(const JsonCursor& section) {
  for (const auto& [name, preset] : section.members()) {
    check_name(name, preset.where());
    if (!preset.is_object()) preset.fail("is not an object", "give the keys of a fixture");
    if (const auto [other, is_new] = presets_.emplace(name, preset); !is_new)
      preset.fail(fmt::format("is the duplicate of {}", other->second.where()), "rename one of the two");
  }
}

void Presets::fail_unknown(const JsonCursor& reference, const std::string& name) const {
  std::vector<std::string_view> known;
  for (const auto& [key, preset] : presets_) known.push_back(key);
  reference.fail(fmt::format("names the unknown preset {}", in_quotes(name)),
                 known.empty() ? "define it in 'presets'" : suggest(name, known));
}

JsonCursor Presets::complete(const JsonCursor& fixture) const {
  if (!fixture.find("preset")) return fixture;
  using Json = nlohmann::ordered_json;
  constexpr std::size_t longest_name = 60;  // in messages
  std::set<std::string> seen;
  std::vector<std::string> chain;
  std::vector<Json> layers;
  for (JsonCursor at = fixture;;) {
    layers.push_back(at.value());
    const auto reference = at.find("preset");
    if (!reference) break;
    const std::string name = reference->text();
    const auto found = presets_.find(name);
    if (found == presets_.end()) fail_unknown(*reference, name);
    constexpr std::size_t max_chain = 100;
    if (chain.size() == max_chain)
      reference->fail(fmt::format("is the end of a chain of {} presets", max_chain), "nest fewer of them");
    const bool repeats = !seen.insert(name).second;
    chain.push_back(shortened(name, longest_name));
    if (repeats)
      reference->fail(fmt::format("refers to itself: {}", fmt::join(chain, " -> ")),
                      "remove one of the references");
    if (found->second.unit() != fixture.unit())
      reference->fail(fmt::format("names a preset in {}, but the store is in {}",
                                  to_text(found->second.unit()), to_text(fixture.unit())),
                      "use the same 'units' in both files");
    at = found->second;
  }
  Json whole = Json::object();
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) whole.merge_patch(*layer);
  whole.erase("preset");
  return fixture.replaced(std::move(whole), fmt::format(" (preset {})", in_quotes(chain.front())));
}

}  // namespace shelfbeam
