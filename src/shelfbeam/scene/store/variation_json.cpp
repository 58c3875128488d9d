#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/field_writer.hpp"
#include "shelfbeam/scene/fixture/fixture.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

constexpr double max_decibels = 20;

class VariationReader {
 public:
  VariationReader(const StoreNames& names, const Store& store) : names_(names), store_(store) {}

  StoreVariation read(const JsonCursor& json) {
    json.expect_keys({"stocking", "correlation", "people", "doors", "objects", "mounting", "unit_power_db",
                      "label_sensitivity_db"});
    StoreVariation variation;
    if (const auto stocking = json.find("stocking")) {
      variation.stocking = read_share_range(*stocking);
      variation.is_assumed = false;
    }
    if (const auto correlation = json.find("correlation")) variation.correlation = correlation->number(0, 1);
    if (const auto people = json.find("people")) read_people(*people, variation);
    if (const auto objects = json.find("objects")) read_objects(*objects, variation);
    if (const auto doors = json.find("doors")) read_doors(*doors, variation);
    if (const auto mounting = json.find("mounting")) {
      mounting->expect_keys({"position", "tilt_deg"});
      if (const auto position = mounting->find("position")) variation.position = position->metres(0, 1);
      if (const auto tilt = mounting->find("tilt_deg")) variation.tilt_deg = tilt->number(0, 45);
    }
    if (const auto power = json.find("unit_power_db"))
      variation.unit_power_db = power->number(0, max_decibels);
    if (const auto gain = json.find("label_sensitivity_db"))
      variation.label_sensitivity_db = gain->number(0, max_decibels);
    return variation;
  }

 private:
  void read_people(const JsonCursor& list, StoreVariation& variation) {
    for (const JsonCursor& json : list.elements()) {
      json.expect_keys({"id", "area", "number", "size", "material"});
      StandingBoxes people = read_boxes(json);
      people.is_person = true;
      if (json.find("id")) {
        people.id = read_new_id(json["id"]);
      } else {
        people.id = list.size() == 1 ? "person" : fmt::format("person-{}", variation.boxes.size() + 1);
        ids_.insert(people.id);
      }
      const JsonCursor number = json["number"];
      if (number.is_number()) {
        const auto exact = number.integer(0, max_boxes);
        people.number = UniformNumber{exact, exact};
      } else {
        number.expect_keys({"poisson", "uniform"});
        const auto mean = number.find("poisson"), ends = number.find("uniform");
        if (mean.has_value() == ends.has_value())
          number.fail("must have one of 'poisson' and 'uniform'", "keep one of them");
        if (mean) people.number = PoissonNumber{mean->number(0, max_mean)};
        if (ends) people.number = read_whole_range(*ends);
      }
      add(std::move(people), number, variation);
    }
  }

  void read_objects(const JsonCursor& list, StoreVariation& variation) {
    for (const JsonCursor& json : list.elements()) {
      json.expect_keys({"id", "present", "area", "size", "material"});
      StandingBoxes object = read_boxes(json);
      object.id = read_new_id(json["id"]);
      object.number = Presence{json["present"].number(0, 1)};
      add(std::move(object), json, variation);
    }
  }

  // Where boxes do not fit, each of them takes many attempts.
  void add(StandingBoxes boxes, const JsonCursor& json, StoreVariation& variation) {
    constexpr double most = 5000;
    if (const auto* poisson = std::get_if<PoissonNumber>(&boxes.number))
      boxes_ += poisson->mean;
    else if (const auto* uniform = std::get_if<UniformNumber>(&boxes.number))
      boxes_ += static_cast<double>(uniform->high);
    else
      ++boxes_;
    if (boxes_ > most)
      json.fail(fmt::format("makes {:.0f} people and objects, together with those before", boxes_),
                fmt::format("at most {:.0f} are allowed", most));
    variation.boxes.push_back(std::move(boxes));
  }

  // Everything except id and number.
  StandingBoxes read_boxes(const JsonCursor& json) const {
    StandingBoxes boxes;
    boxes.area = read_plan_area(json["area"], store_);
    const JsonCursor size = json["size"];
    size.numbers(3);
    boxes.size = {read_length(size.element(0)), read_length(size.element(1)), read_length(size.element(2))};
    boxes.material = names_.material(json["material"]);
    return boxes;
  }

  void read_doors(const JsonCursor& list, StoreVariation& variation) const {
    std::vector<std::string_view> ids;
    for (const auto& [fixture, where] : store_.fixtures)
      if (const Shelving* shelves = shelving_of(fixture); shelves != nullptr && shelves->doors)
        ids.push_back(shelves->id);
    for (const JsonCursor& json : list.elements()) {
      json.expect_keys({"fixtures", "open"});
      variation.doors.push_back({json["fixtures"].text(), json["open"].number(0, 1)});
    }
    expect_few_comparisons(list, ids, variation.doors);
    for (std::size_t k = 0; k < variation.doors.size(); ++k) {
      expect_running(store_.cancel);
      if (std::none_of(ids.begin(), ids.end(),
                       [&](std::string_view id) { return matches_glob(id, variation.doors[k].fixtures); }))
        list.element(k)["fixtures"].fail("matches no fixture with doors", "correct it, or remove the member");
    }
  }

  // Each pattern is compared with each id, in a time of up to the product of their lengths.
  static void expect_few_comparisons(const JsonCursor& list, const std::vector<std::string_view>& ids,
                                     const std::vector<OpenDoors>& doors) {
    constexpr std::size_t most = 100'000'000;
    std::size_t patterns = 0, names = 0;
    for (const OpenDoors& one : doors) patterns += one.fixtures.size() + 1;
    for (const std::string_view id : ids) names += id.size() + 1;
    if (names > 0 && patterns > most / names)
      list.fail(
          fmt::format("has patterns with {} characters for the {} characters of the ids of fixtures with "
                      "doors",
                      grouped(patterns), grouped(names)),
          fmt::format("the product of both is at most {}", grouped(most)));
  }

  std::string read_new_id(const JsonCursor& json) {
    std::string id = read_name(json);
    if (!ids_.insert(id).second) json.fail(fmt::format("is the duplicate id {}", in_quotes(id)), "rename it");
    return id;
  }

  static UniformNumber read_whole_range(const JsonCursor& json) {
    json.numbers(2);
    const UniformNumber ends{json.element(0).integer(0, max_boxes), json.element(1).integer(0, max_boxes)};
    if (ends.high < ends.low) json.fail("has its second number below its first", "swap them");
    return ends;
  }

  static constexpr std::int64_t max_boxes = 1000;
  static constexpr double max_mean = 500;

  const StoreNames& names_;
  const Store& store_;
  std::set<std::string> ids_;
  double boxes_ = 0;  ///< people and objects so far: the largest number, or the mean
};

Json json_of(const PlanArea& area) {
  if (const auto* name = std::get_if<std::string>(&area)) return *name;
  return std::get<Polygon>(area);
}

}  // namespace

StoreVariation read_variation(const JsonCursor& json, const StoreNames& names, const Store& store) {
  return VariationReader(names, store).read(json);
}

Json resolved(const StoreVariation& variation, const Store& store) {
  Json json{{"stocking", resolved(variation.stocking)}, {"correlation", variation.correlation}};
  for (const StandingBoxes& boxes : variation.boxes) {
    Json one{{"id", boxes.id},
             {"area", json_of(boxes.area)},
             {"size", array_of(boxes.size)},
             {"material", store.materials[boxes.material.value].name}};
    if (const auto* poisson = std::get_if<PoissonNumber>(&boxes.number))
      one["number"] = {{"poisson", poisson->mean}};
    else if (const auto* uniform = std::get_if<UniformNumber>(&boxes.number))
      one["number"] = {{"uniform", {uniform->low, uniform->high}}};
    else
      one["present"] = std::get<Presence>(boxes.number).probability;
    json[boxes.is_person ? "people" : "objects"].push_back(std::move(one));
  }
  for (const OpenDoors& doors : variation.doors)
    json["doors"].push_back({{"fixtures", doors.fixtures}, {"open", doors.open}});
  json["mounting"] = {{"position", variation.position}, {"tilt_deg", variation.tilt_deg}};
  json["unit_power_db"] = variation.unit_power_db;
  json["label_sensitivity_db"] = variation.label_sensitivity_db;
  return json;
}

}  // namespace shelfbeam
