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

// The rules that tie the keys of the section together, and it to the fixtures and the room.
class VariationRules {
 public:
  VariationRules(FieldReader& reader, StoreVariation& variation, const Store& store)
      : reader_(reader), variation_(variation), store_(store) {}

  void check() {
    std::size_t k = 0;
    double boxes = 0;
    const auto people = static_cast<std::size_t>(std::count_if(
        variation_.boxes.begin(), variation_.boxes.end(), [](const auto& one) { return one.is_person; }));
    for (StandingBoxes& one : variation_.boxes) {
      const JsonCursor json =
          reader_.json()[one.is_person ? "people" : "objects"].element(one.is_person ? k : k - people);
      reader_.rule({}, [&] { complete_plan_area(json["area"], one.area, store_, reader_.problems()); });
      reader_.rule({}, [&] { name(one, json, k, people); });
      reader_.rule({}, [&] { count(one, json, boxes); });
      ++k;
    }
    reader_.rule({"doors"}, [&] { check_doors(); });
  }

 private:
  void name(StandingBoxes& boxes, const JsonCursor& json, std::size_t k, std::size_t people) {
    if (boxes.id.empty()) boxes.id = people == 1 ? "person" : fmt::format("person-{}", k + 1);
    if (!ids_.insert(boxes.id).second && json.find("id"))
      json["id"].fail(fmt::format("is the duplicate id {}", in_quotes(boxes.id)), "rename it");
  }

  // Where boxes do not fit, each of them takes many attempts.
  static void count(const StandingBoxes& one, const JsonCursor& json, double& boxes) {
    constexpr double most = 5000;
    if (const auto* poisson = std::get_if<PoissonNumber>(&one.number))
      boxes += poisson->mean;
    else if (const auto* uniform = std::get_if<UniformNumber>(&one.number))
      boxes += static_cast<double>(uniform->high);
    else
      ++boxes;
    if (boxes > most)
      (one.is_person ? json["number"] : json)
          .fail(fmt::format("makes {:.0f} people and objects, together with those before", boxes),
                fmt::format("at most {:.0f} are allowed", most));
  }

  void check_doors() const {
    if (variation_.doors.empty()) return;
    const JsonCursor list = reader_.json()["doors"];
    std::vector<std::string_view> ids, patterns;
    for (const OpenDoors& one : variation_.doors) patterns.push_back(one.fixtures);
    for (const auto& [fixture, where] : store_.fixtures)
      if (const Shelving* shelves = shelving_of(fixture); shelves != nullptr && shelves->doors)
        ids.push_back(shelves->id);
    expect_few_comparisons(list, ids, patterns);
    for (std::size_t k = 0; k < variation_.doors.size(); ++k) {
      expect_running(store_.cancel);
      if (std::any_of(ids.begin(), ids.end(),
                      [&](std::string_view id) { return matches_glob(id, variation_.doors[k].fixtures); }))
        continue;
      reader_.rule({}, [&] {
        reader_.problems().expect_complete("some fixture");
        list.element(k)["fixtures"].fail("matches no fixture with doors", "correct it, or remove the member");
      });
    }
  }

  FieldReader& reader_;
  StoreVariation& variation_;
  const Store& store_;
  std::set<std::string> ids_;
};

}  // namespace

void expect_few_comparisons(const JsonCursor& list, const std::vector<std::string_view>& ids,
                            const std::vector<std::string_view>& patterns) {
  constexpr std::size_t most = 100'000'000;
  const auto size_of = [](const std::vector<std::string_view>& texts) {
    std::size_t size = 0;
    for (const std::string_view text : texts) size += text.size() + 1;
    return size;
  };
  const std::size_t characters = size_of(patterns), names = size_of(ids);
  if (names > 0 && characters > most / names)
    list.fail(fmt::format("has patterns with {} characters for the {} characters of the ids of fixtures",
                          grouped(characters), grouped(names)),
              fmt::format("the product of both is at most {}", grouped(most)));
}

StoreVariation read_variation(const JsonCursor& json, const StoreNames& names, const Store& store,
                              Problems& problems) {
  StoreVariation variation;
  read_object(
      json, names, problems, [&](Fields& f) { variation.fields(f); },
      [&](FieldReader& reader) { VariationRules(reader, variation, store).check(); });
  return variation;
}

}  // namespace shelfbeam
