#include "shelfbeam/scene/variation.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/field_values.hpp"

namespace shelfbeam {

Range read_share_range(const JsonCursor& json) {
  if (json.is_number()) {
    const double fixed = json.number(0, 1);
    return {fixed, fixed};
  }
  json.expect_keys({"uniform"});
  const JsonCursor ends = json["uniform"];
  ends.numbers(2);
  const Range range{ends.element(0).number(0, 1), ends.element(1).number(0, 1)};
  if (range.high < range.low) ends.fail("has its second number below its first", "swap them");
  return range;
}

nlohmann::ordered_json resolved(const Range& range) {
  return {{"uniform", {range.low, range.high}}};
}

namespace {

constexpr std::int64_t max_boxes = 1000;
constexpr double max_decibels = 20, max_mean = 500;

UniformNumber read_whole_range(const JsonCursor& json) {
  json.numbers(2);
  const UniformNumber ends{json.element(0).integer(0, max_boxes), json.element(1).integer(0, max_boxes)};
  if (ends.high < ends.low) json.fail("has its second number below its first", "swap them");
  return ends;
}

std::variant<PoissonNumber, UniformNumber, Presence> read_number(const JsonCursor& json) {
  if (json.is_number()) {
    const auto exact = json.integer(0, max_boxes);
    return UniformNumber{exact, exact};
  }
  json.expect_keys({"poisson", "uniform"});
  const auto mean = json.find("poisson"), ends = json.find("uniform");
  if (mean.has_value() == ends.has_value())
    json.fail("must have one of 'poisson' and 'uniform'", "keep one of them");
  if (ends) return read_whole_range(*ends);
  return PoissonNumber{mean->number(0, max_mean)};
}

}  // namespace

void StandingBoxes::fields(Fields& f) {
  f.text("id", id,
         {.says = is_person ? "the boxes are named after it" : "the box is named after it",
          .is_name = true,
          .is_optional = is_person,
          .otherwise = is_person ? "`person`" : ""});
  describe_plan_area(
      f, area, "`\"room\"`, `\"room without zones\"`, the id of a [zone](room.md#ceilings), or a polygon");
  describe_triple(f, "size", Scalar::length, size, {.says = "`[length, width, height]`"});
  f.material("material", material, {.says = "material of the surface"});
  if (!is_person) {
    double share = std::holds_alternative<Presence>(number) ? std::get<Presence>(number).probability : 0;
    if (f.scalar("present", Scalar::share, share, {.says = "share of the time"})) number = Presence{share};
    return;
  }
  const CustomValue count{[this](const JsonCursor& json) { number = read_number(json); },
                          [this]() -> nlohmann::ordered_json {
                            if (const auto* poisson = std::get_if<PoissonNumber>(&number))
                              return {{"poisson", poisson->mean}};
                            const auto& ends = std::get<UniformNumber>(number);
                            return {{"uniform", {ends.low, ends.high}}};
                          },
                          R"({"$ref": "#/$defs/number_of_people"})"};
  f.custom(
      "number", count,
      {.says =
           "a number, `{ \"poisson\": mean }`, or `{ \"uniform\": [low, high] }` with both ends included; "
           "at most 1000, a mean of at most 500; together with the other people and the objects at most "
           "5000"});
}

void OpenDoors::fields(Fields& f) {
  f.text("fixtures", fixtures, {.says = "pattern of ids; `*` matches any run of characters, `?` one"});
  f.scalar("open", Scalar::share, open, {.says = "share of the time in which the doors are open"});
}

bool StoreVariation::varies(Cause cause) const {
  return std::find(without.begin(), without.end(), cause) == without.end();
}

void StoreVariation::leave_out(const std::vector<Cause>& causes) {
  without.insert(without.end(), causes.begin(), causes.end());
  std::sort(without.begin(), without.end());
  without.erase(std::unique(without.begin(), without.end()), without.end());
}

void StoreVariation::fields(Fields& f) {
  if (describe_share_range(
          f, "stocking", stocking,
          {.says = "stocking of each gondola and freezer, independent of the others: all values "
                   "between two ends are equally likely; a number is the same in all states",
           .is_optional = true,
           .otherwise = "`{ \"uniform\": [0.4, 1] }`"}))
    is_assumed = false;
  f.scalar(
      "correlation", Scalar::share, correlation,
      {.says = "correlation between the rows of goods of a fixture; with 1 they have one level, with 0 they "
               "are independent",
       .is_optional = true});
  std::vector<StandingBoxes> people, objects;
  for (StandingBoxes& one : boxes) (one.is_person ? people : objects).push_back(one);
  const auto part = [](std::vector<StandingBoxes>& list, bool is_person) {
    return [&list, is_person](Fields& fields, std::size_t k) {
      if (k >= list.size()) list.resize(k + 1);
      list[k].is_person = is_person;
      list[k].fields(fields);
    };
  };
  Field field{.says = "[people](#people-and-objects)", .is_optional = true, .otherwise = "none"};
  field.is_written = !people.empty();
  bool is_read = f.objects("people", people.size(), part(people, true), field);
  field.says = "[objects](#people-and-objects)";
  field.is_written = !objects.empty();
  is_read = f.objects("objects", objects.size(), part(objects, false), field) || is_read;
  if (is_read) {
    boxes = std::move(people);
    boxes.insert(boxes.end(), objects.begin(), objects.end());
  }
  const auto door = [this](Fields& fields, std::size_t k) {
    if (k >= doors.size()) doors.resize(k + 1);
    doors[k].fields(fields);
  };
  f.objects(
      "doors", doors.size(), door,
      {.says =
           "list of `{ \"fixtures\": pattern, \"open\": share }`: share of the time in which the doors of "
           "the fixtures are open; `*` matches any run of characters, `?` one; the last matching member "
           "applies; 0.03 for doors that no member names",
       .is_optional = true,
       .otherwise = "none",
       .is_written = !doors.empty()});
  f.object(
      "mounting",
      [this](Fields& mounting) {
        mounting.scalar("position", Scalar::distance, position,
                        {.says = "standard deviation of the position of a unit in both horizontal directions",
                         .most = 1,
                         .is_optional = true});
        mounting.scalar("tilt_deg", Scalar::degrees, tilt_deg,
                        {.says = "standard deviation of its tilt about two directions",
                         .least = 0,
                         .most = 45,
                         .is_optional = true});
      },
      {.says = "`position`: standard deviation of the position of a unit in both horizontal directions, at "
               "most 1 m ([near walls](#units-near-walls)); `tilt_deg`: standard deviation of its tilt about "
               "two directions, at most 45",
       .unit = "m, degrees",
       .is_optional = true,
       .otherwise = "0"});
  f.scalar("unit_power_db", Scalar::number, unit_power_db,
           {.says = "standard deviation of the power of a unit; the median is the power of its type, and the "
                    "largest deviation is 20 dB",
            .least = 0,
            .most = max_decibels,
            .unit = "dB",
            .is_optional = true});
  f.scalar("label_sensitivity_db", Scalar::number, label_sensitivity_db,
           {.says = "the same for the sensitivity of a label",
            .least = 0,
            .most = max_decibels,
            .unit = "dB",
            .is_optional = true});
  std::vector<std::string_view> left_out;
  for (const Cause cause : without) left_out.push_back(key_of(cause));
  if (f.choices(
          "without", left_out, cause_keys, false,
          {.says = "causes that are [left out](#causes-left-out): they are as in the file in all states",
           .is_optional = true,
           .otherwise = "none",
           .is_written = !without.empty()})) {
    without.clear();
    std::vector<Cause> causes;
    for (const std::string_view key : left_out) causes.push_back(cause_of_key(key));
    leave_out(causes);
  }
}

}  // namespace shelfbeam
