#include "shelfbeam/scene/store/presets.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

std::size_t count_values(const Json& json) {
  std::size_t count = 1;
  if (json.is_structured())
    for (const Json& part : json) count += count_values(part);
  return count;
}

// Removes the alternatives to the keys of a layer from the layers below.
void drop_alternatives(Json& whole, const JsonCursor& layer, const std::string& path) {
  const auto replace = [&](const std::vector<std::string_view>& own,
                           const std::vector<std::string_view>& below) {
    if (std::none_of(own.begin(), own.end(), [&](std::string_view key) { return layer.find(key); })) return;
    for (const std::string_view key : below)
      if (!layer.find(key)) whole.erase(std::string(key));
  };
  for (const auto& [where, one, other] : alternative_keys())
    if (where == path) {
      replace(one, other);
      replace(other, one);
    }
}

// The members of an object. ordered_json looks through all of them for one key.
class Members {
 public:
  Members(Json& object, std::size_t more) : all_(object.get_ref<Json::object_t&>()) {
    constexpr std::size_t few = 50;
    all_.reserve(all_.size() + more);  // so that the table may refer to members
    if (all_.size() + more <= few) return;
    table_.emplace();
    for (auto& [key, value] : all_) table_->emplace(key, &value);
  }

  Json* find(const std::string& key) {
    if (table_) {
      const auto found = table_->find(key);
      return found == table_->end() ? nullptr : found->second;
    }
    const auto found = all_.find(key);
    return found == all_.end() ? nullptr : &found->second;
  }

  /// Precondition: there is none with this key.
  Json& add(const std::string& key) {
    auto& [name, value] = all_.emplace_back(key, Json());
    if (table_) table_->emplace(name, &value);
    return value;
  }

  void remove_discarded() {
    Json::object_t kept;
    for (auto& [key, value] : all_)
      if (!value.is_discarded()) kept.emplace_back(key, std::move(value));
    all_ = std::move(kept);
  }

 private:
  Json::object_t& all_;
  std::optional<std::unordered_map<std::string_view, Json*>> table_;  // if they are many
};

// Adds the keys of a fixture or preset, which replace those of the presets that it refers to.
void lay_over(Json& whole, JsonCursor::Origins& origins, const JsonCursor& layer,
              const JsonCursor::Origin& origin, const std::string& path) {
  origins[path] = origin;
  drop_alternatives(whole, layer, path);
  const auto given = layer.members();
  Members members(whole, given.size());
  bool removes = false;
  for (const auto& [key, value] : given) {
    const std::string part = path.empty() ? key : fmt::format("{}.{}", path, key);
    if (part == "preset") continue;
    Json* below = members.find(key);
    if (value.is_null()) {
      if (below == nullptr) value.fail("removes a key that no preset of the fixture has", "remove it");
      *below = Json::value_t::discarded;
      removes = true;
      continue;
    }
    if (below == nullptr) below = &members.add(key);
    if (value.is_object()) {
      if (!below->is_object()) *below = Json::object();
      lay_over(*below, origins, value, origin, part);
    } else {
      *below = value.value();
      origins[part] = origin;
    }
  }
  if (removes) members.remove_discarded();
}

}  // namespace

void Presets::add(const JsonCursor& section, Problems& problems) {
  problems_ = &problems;
  const std::vector<std::string_view> known = all_fixture_keys();
  for (const auto& [name, given] : section.members())
    if (!problems.collect([&, &name = name, &given = given] {
          check_name(name, given.where());
          if (!given.is_object()) given.fail("is not an object", "give the keys of a fixture");
          JsonCursor preset = given;
          if (const auto unknown = given.unknown_keys(known); !unknown.empty()) {
            Json value = given.value();
            for (const JsonError& error : unknown) {
              problems.keep(error);
              value.erase(std::get<std::string>(error.values().front()));
            }
            preset = given.replaced(std::move(value));
          }
          sizes_.emplace(name, count_values(preset.value()));
          if (const auto [other, is_new] = presets_.emplace(name, preset); !is_new)
            preset.fail(fmt::format("duplicates {}", other->second.where()), "rename one of the two");
        }))
      problems.mark("preset " + name);
}

std::vector<std::string> Presets::names() const {
  std::vector<std::string> all;
  for (const auto& [name, preset] : presets_) all.push_back(name);
  return all;
}

void Presets::check(Problems& problems) {
  problems_ = &problems;
  for (const auto& [name, preset] : presets_)
    if (!problems.collect([&, &name = name, &preset = preset] {
          std::size_t taken = sizes_.at(name);
          for (const auto& [other, below] : chain_of(preset, &name)) taken += sizes_.at(other);
          taken_.emplace(name, taken);
        }))
      problems.mark("preset " + name);
}

void Presets::fail_unknown(const JsonCursor& reference, const std::string& name) const {
  if (problems_ != nullptr) problems_->expect_complete("preset");
  if (problems_ != nullptr) problems_->expect_complete("preset " + name);
  std::vector<std::string_view> known;
  for (const auto& [key, preset] : presets_) known.push_back(key);
  reference.fail(fmt::format("names the unknown preset {}", in_quotes(name)),
                 known.empty() ? "define it in 'presets'" : suggest(name, known));
}

std::vector<Presets::Named> Presets::chain_of(const JsonCursor& json, const std::string* name) const {
  constexpr std::size_t max_chain = 100, longest_name = 60;  // of a name in messages
  std::set<std::string> seen;
  std::vector<std::string> names;
  if (name != nullptr) {
    seen.insert(*name);
    names.push_back(shortened(*name, longest_name));
  }
  std::vector<Named> chain;
  for (auto reference = json.find("preset"); reference; reference = chain.back().second.find("preset")) {
    std::string next = reference->text();
    const auto found = presets_.find(next);
    if (found == presets_.end()) fail_unknown(*reference, next);
    if (names.size() == max_chain)
      reference->fail(fmt::format("is the end of a chain of {} presets", max_chain), "nest fewer of them");
    names.push_back(shortened(next, longest_name));
    if (!seen.insert(next).second)
      reference->fail(fmt::format("refers to itself: {}", fmt::join(names, " -> ")),
                      "remove one of the references");
    chain.emplace_back(std::move(next), found->second);
  }
  return chain;
}

void Presets::take(const JsonCursor& fixture) {
  constexpr std::size_t most = 5'000'000;
  const auto reference = fixture.is_object() ? fixture.find("preset") : std::nullopt;
  if (!reference || !reference->is_string()) return;
  const auto found = taken_.find(reference->text());
  if (found == taken_.end()) return;  // `complete` says why
  copied_ += found->second;
  if (copied_ > most)
    reference->fail(fmt::format("takes more than {} values from presets, together with the fixtures before",
                                grouped(most)),
                    "shorten the lists in presets, or use 'repeat'");
}

JsonCursor Presets::complete(const JsonCursor& fixture) const {
  const auto reference = fixture.find("preset");
  if (!reference) return fixture;
  if (problems_ != nullptr && reference->is_string())
    problems_->expect_complete("preset " + reference->text());
  const std::vector<Named> chain = chain_of(fixture);
  const auto note = [&](const Named& preset) {
    const std::string& file = preset.second.file();
    return fmt::format("preset {}{}", in_quotes(preset.first),
                       file == fixture.file() ? "" : fmt::format(" of {}", file));
  };
  Json whole = Json::object();
  JsonCursor::Origins origins;
  for (auto preset = chain.rbegin(); preset != chain.rend(); ++preset)
    lay_over(whole, origins, preset->second, {note(*preset), preset->second.unit()}, "");
  lay_over(whole, origins, fixture, {"", fixture.unit()}, "");
  origins[""] = {note(chain.front()), fixture.unit()};
  return fixture.replaced(std::move(whole), origins);
}

}  // namespace shelfbeam
