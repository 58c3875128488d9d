#include <algorithm>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "shelfbeam/report/place/place_text.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/report/viewer/page_data.hpp"
#include "shelfbeam/report/viewer/page_scene.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

Json point(const Vec3& v) {
  return {v.x, v.y, v.z};
}

// Labels of one type with equal requirements share one threshold in the page.
Json add_labels(PageData& page, const ReportData& data) {
  std::vector<float> position, normal;
  std::vector<std::uint16_t> kind, level(data.outcome.labels.size());
  std::map<std::pair<std::string, double>, std::uint16_t> known;
  Json kinds = Json::array(), ids = Json::array(), names = Json::array();
  bool has_names = false;
  for (std::uint32_t row = 0; row < data.outcome.labels.size(); ++row) {
    const LabelRow& label = data.label(row);
    append_point(position, label.position);
    append_point(normal, label.normal);
    ids.push_back(label.id);
    names.push_back(data.names.name(row));
    has_names = has_names || names.back() != label.id;
    const auto [found, is_new] =
        known.emplace(std::pair(label.type, label.requirement), static_cast<std::uint16_t>(known.size()));
    if (is_new) kinds.push_back({{"type", label.type}, {"requirement", label.requirement}});
    kind.push_back(found->second);
  }
  for (std::size_t k = 0; k < data.levels.size(); ++k)
    for (const LabelId label : data.levels[k].labels) level[label] = static_cast<std::uint16_t>(k);
  page.add("label_position", position);
  page.add("label_normal", normal);
  page.add("label_kind", kind);
  page.add("label_level", level);
  Json labels = {{"ids", ids}, {"kinds", kinds}};
  if (has_names) labels["names"] = std::move(names);
  return labels;
}

Json add_units(PageData& page, const ReportData& data) {
  std::vector<float> position, axis;
  Json ids = Json::array(), types = Json::array(), places = Json::array(), installed = Json::array();
  const ShopPlaces shop(data.input.scene);
  const auto& units = data.input.matrix.transceivers;
  for (std::uint32_t j = 0; j < units.size(); ++j) {
    append_point(position, units[j].position);
    append_point(axis, units[j].axis);
    ids.push_back(units[j].id);
    types.push_back(units[j].type);
    places.push_back(place_text(data.words, shop.of(units[j].position)));
    if (units[j].installed) installed.push_back(j);
  }
  page.add("unit_position", position);
  page.add("unit_axis", axis);
  Json orders = Json::object();
  for (const TransceiverType& type : data.input.scene.transceiver_types)
    if (!type.order_number.empty()) orders[type.name] = type.order_number;
  Json selected = Json::array(), needed_by = Json::array();
  for (const UnitOutcome& unit : data.outcome.units) {
    selected.push_back(unit.column);
    needed_by.push_back(unit.needed_by);
  }
  return {{"ids", ids},           {"types", types},         {"places", places},
          {"orders", orders},     {"installed", installed}, {"mounts", shared_mounts(data.input.matrix)},
          {"selected", selected}, {"neededBy", needed_by}};
}

// Verdicts by their number in Verdict, which the script knows; null without a certificate.
Json add_certificate(PageData& page, const ReportData& data) {
  const auto& certificate = data.input.plan.certificate;
  std::vector<std::uint8_t> verdicts;
  if (certificate)
    for (const LabelVerdict& label : certificate->labels)
      verdicts.push_back(static_cast<std::uint8_t>(label.verdict));
  page.add("label_verdict", verdicts);
  return certificate ? Json{{"confidence", rounded_down(certificate->confidence, 6)}} : Json();
}

Json levels_of(const ReportData& data) {
  Json levels = Json::array();
  for (const ShelfLevel& level : data.levels)
    levels.push_back({{"from", data.words.fixed(level.low, 2)},
                      {"to", data.words.fixed(level.high, 2)},
                      {"labels", level.labels.size()}});
  return levels;
}

Json margins(const Words& words) {
  Json classes = Json::array();
  for (const MarginClass& margin : margin_classes)
    classes.push_back({{"from", margin.from}, {"name", margin.name(words)}});
  return classes;
}

// The people and objects of all states, one state after the other, as blocks with four corners each.
Json add_states(PageData& page, const ReportData& data) {
  std::map<std::string, std::size_t> known;
  const auto& fixtures = data.input.scene.fixtures;
  for (std::size_t k = 0; k < fixtures.size(); ++k) known.emplace(fixtures[k].id, k);
  std::vector<float> outlines, heights;
  Json states = Json::array();
  for (const ShopState& state : data.input.states) {
    for (const ShopState::Block& block : state.blocks) {
      for (const Vec2& corner : block.footprint)
        for (const double at : corner) outlines.push_back(static_cast<float>(at));
      heights.push_back(static_cast<float>(block.bottom));
      heights.push_back(static_cast<float>(block.top));
    }
    Json open = Json::array();
    for (const std::string& id : state.open_doors) open.push_back(known.at(id));
    states.push_back({{"number", state.verdicts.number},
                      {"blocks", state.blocks.size()},
                      {"open", open},
                      {"missed", state.verdicts.missed}});
  }
  page.add("block_outline", outlines);
  page.add("block_height", heights);
  return states;
}

// Fixtures and zones with the places of their names.
Json named_places(const Scene& scene) {
  Json names = Json::array();
  const auto add = [&](const std::string& id, const Polygon& plan, const auto& height_at) {
    Vec2 middle{};
    for (const auto& [x, y] : plan) {
      middle[0] += x / static_cast<double>(plan.size());
      middle[1] += y / static_cast<double>(plan.size());
    }
    names.push_back({{"id", id}, {"at", point({middle[0], middle[1], height_at(middle)})}});
  };
  for (const FixtureOutline& fixture : scene.fixtures)
    add(fixture.id, fixture.footprint, [&](const Vec2&) { return fixture.height; });
  if (scene.room)
    for (const CeilingZone& zone : scene.room->zones)
      add(zone.id, zone.polygon, [&](const Vec2& middle) { return zone.height.at(middle); });
  return names;
}

}  // namespace

std::string pack_store(const ReportData& data, const SignalScale& scale) {
  const Scene& scene = data.input.scene;
  const PlacementProblem& problem = data.input.plan.placement.problem;
  PageData page;
  const bool has_states = !data.input.states.empty();
  Json about = add_scene(page, scene, has_states);
  about["cooperative"] = problem.model == CommunicationModel::cooperative;
  about["redundant"] = problem.redundant;
  about["tolerance"] = met_tolerance;
  about["unit"] = {{"factor", data.unit.factor}, {"name", data.unit.name}};
  about["margins"] = margins(data.words);
  about["signals"] = scale.edges;
  about["levels"] = levels_of(data);
  about["fixtures"] = named_places(scene);
  about["labels"] = add_labels(page, data);
  about["units"] = add_units(page, data);
  about["certificate"] = add_certificate(page, data);
  if (has_states) about["states"] = add_states(page, data);
  return page.base64(about.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace shelfbeam
