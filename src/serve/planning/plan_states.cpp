#include "serve/planning/plan_states.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/scene/read_scene.hpp"
#include "shelfbeam/scene/states/store_states.hpp"

#include "jobs/plan_folder.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

Json outlines_of(const ShopState& state) {
  Json blocks = Json::array();
  for (const ShopState::Block& block : state.blocks) {
    Json outline = Json::array();
    for (const Vec2& corner : block.footprint) outline.push_back({corner[0], corner[1]});
    blocks.push_back(std::move(outline));
  }
  return blocks;
}

}  // namespace

LabelNumbers::LabelNumbers(const Draft& draft) {
  for (std::size_t i = 0; i < draft.scene.labels.size(); ++i) numbers_.emplace(draft.scene.labels[i].id, i);
}

Json LabelNumbers::with_ids(const Json& ids) const {
  Json list = Json::array();
  for (const Json& id : ids)
    if (const auto found = numbers_.find(id.get<std::string>()); found != numbers_.end())
      list.push_back({found->second, id});
  return list;
}

Json LabelNumbers::of(const Json& ids) const {
  Json list = Json::array();
  for (const Json& one : with_ids(ids)) list.push_back(one[0]);
  return list;
}

Json states_of_plan(const std::filesystem::path& folder, const Json& placement, const Draft& draft) {
  Json result{{"shown", Json::array()}, {"availability", Json::array()}};
  const auto found = placement.find("states");
  if (found == placement.end()) return result;
  const Store store = read_store(folder / jobs::store_name);
  const Scene scene = make_scene(store);
  const StoreStates states(store, scene, placement.value("seed", std::uint64_t{1}));
  const LabelNumbers numbers(draft);
  for (const Json& one : found->value("shown_states", Json::array())) {
    ShownState verdicts;
    verdicts.number = one.at("state");
    const ShopState state = shop_state(states, store, std::move(verdicts));
    result["shown"].push_back({{"state", one.at("state")},
                               {"missed", numbers.of(one.at("missed"))},
                               {"blocks", outlines_of(state)},
                               {"open_doors", state.open_doors}});
  }
  const Json examined = found->value("examined", Json::array());
  const double count = examined.empty() ? 0 : examined.back().at("states").get<double>();
  if (count == 0) return result;
  Json& availability = result["availability"];
  std::unordered_map<std::string_view, double> misses;
  for (const Label& label : scene.labels) misses.emplace(label.id, 0);
  for (const auto& [id, number] : examined.back().at("missed").items())
    if (const auto of_label = misses.find(id); of_label != misses.end()) of_label->second = number;
  for (const Label& label : draft.scene.labels) {
    const auto of_label = misses.find(label.id);
    availability.push_back(of_label == misses.end() ? Json() : Json(1 - of_label->second / count));
  }
  return result;
}

}  // namespace shelfbeam::serve
