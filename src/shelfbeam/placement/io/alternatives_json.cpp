#include <limits>
#include <string>

#include "shelfbeam/placement/io/placement_json.hpp"

namespace shelfbeam::detail {

namespace {

Json to_json(const Alternative& one, const SignalTable& table) {
  return {{"count", one.selected.size()},
          {"selected", ids_of(table.transceivers, one.selected)},
          {"price", price_object(one.price)},
          {"reached", one.reached},
          {"reached_upper_bound", one.max_reached},
          {"smallest_margin", number(one.smallest_margin)},
          {"secure", one.secure},
          {"proven", one.is_proven}};
}

Alternative read(const JsonCursor& json, const SignalTable& table) {
  json.expect_keys({"count", "selected", "price", "reached", "reached_upper_bound", "smallest_margin",
                    "secure", "proven"});
  const auto labels = static_cast<std::int64_t>(table.rows());
  const Positions known = positions(table.transceivers);
  Alternative one;
  for (const JsonCursor& id : json["selected"].elements())
    one.selected.push_back(position(id, known, "transceiver"));
  if (json["count"].number() != static_cast<double>(one.selected.size()))
    json["count"].fail("is not the number of selected transceivers", "correct one of them");
  one.price = read_price(json["price"]);
  one.reached = static_cast<std::size_t>(json["reached"].integer(0, labels));
  one.max_reached = static_cast<std::size_t>(json["reached_upper_bound"].integer(0, labels));
  one.smallest_margin = number_or_infinity(json["smallest_margin"]);
  one.secure = static_cast<std::size_t>(json["secure"].integer(0, labels));
  one.is_proven = json["proven"].boolean();
  return one;
}

}  // namespace

Json price_object(const std::optional<Price>& price) {
  if (!price) return nullptr;
  return {{"currency", price->currency.empty() ? Json(nullptr) : Json(price->currency)},
          {"total", price->total},
          {"new", price->to_spend}};
}

std::optional<Price> read_price(const JsonCursor& json) {
  if (json.is_null()) return {};
  json.expect_keys({"currency", "total", "new"});
  const JsonCursor currency = json["currency"];
  return Price{currency.is_null() ? "" : currency.text(), json["total"].non_negative(),
               json["new"].non_negative()};
}

Json alternatives_object(const Alternatives& alternatives, const SignalTable& table) {
  Json json = Json::object();
  const auto add = [&](const char* key, const std::optional<Alternative>& one) {
    if (one) json[key] = to_json(*one, table);
  };
  add("one_fewer", alternatives.one_fewer);
  add("one_more", alternatives.one_more);
  add("survives_failure", alternatives.survives_failure);
  json["cannot_survive"] = alternatives.cannot_survive;
  return json;
}

Alternatives read_alternatives(const JsonCursor& json, const SignalTable& table) {
  json.expect_keys({"one_fewer", "one_more", "survives_failure", "cannot_survive"});
  Alternatives alternatives;
  const auto take = [&](const char* key, std::optional<Alternative>& one) {
    if (const auto found = json.find(key)) one = read(*found, table);
  };
  take("one_fewer", alternatives.one_fewer);
  take("one_more", alternatives.one_more);
  take("survives_failure", alternatives.survives_failure);
  alternatives.cannot_survive = json["cannot_survive"].boolean();
  return alternatives;
}

}  // namespace shelfbeam::detail
