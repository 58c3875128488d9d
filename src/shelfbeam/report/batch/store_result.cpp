#include "shelfbeam/report/batch/store_result.hpp"

#include <algorithm>
#include <tuple>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/finding_json.hpp"

namespace shelfbeam {

using Json = nlohmann::ordered_json;

Json to_json(const PlanNumbers& numbers) {
  const auto optional = [](const auto& value) { return value ? Json(*value) : Json(); };
  return {{"answer", numbers.answer},
          {"basis", numbers.basis},
          {"labels", numbers.labels},
          {"units", optional(numbers.units)},
          {"lower_bound", optional(numbers.lower_bound)},
          {"price", optional(numbers.price)},
          {"price_lower_bound", optional(numbers.price_lower_bound)},
          {"currency", numbers.currency},
          {"warnings", to_json(numbers.warnings)}};
}

PlanNumbers read_numbers(const Json& json) {
  PlanNumbers numbers;
  const auto read = [&](const char* key, auto& value) {
    if (json.contains(key) && !json.at(key).is_null())
      value = json.at(key).get<typename std::decay_t<decltype(value)>::value_type>();
  };
  numbers.answer = json.at("answer");
  numbers.basis = json.value("basis", "");  // earlier versions do not write it
  numbers.labels = json.at("labels");
  read("units", numbers.units);
  read("lower_bound", numbers.lower_bound);
  read("price", numbers.price);
  read("price_lower_bound", numbers.price_lower_bound);
  numbers.currency = json.at("currency");
  numbers.warnings = findings_of(json.at("warnings"));
  return numbers;
}

void sort_by_need(std::vector<StoreResult>& results) {
  const auto need = [](const StoreResult& result) {
    return std::tuple(result.status, result.warnings.empty(), -result.price.value_or(0), result.name);
  };
  std::sort(results.begin(), results.end(),
            [&](const StoreResult& a, const StoreResult& b) { return need(a) < need(b); });
}

}  // namespace shelfbeam
