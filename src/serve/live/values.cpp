#include "serve/live/values.hpp"

#include <utility>

#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

namespace shelfbeam::serve {

namespace {

using Json = nlohmann::ordered_json;

template <class Type>
Json product(const Type& type, double amount, Json price) {
  return {{"name", type.name},
          {"source", type.origin.source ? Json(to_text(*type.origin.source)) : Json()},
          {"order_number", type.order_number},
          {"picture", type.picture},
          {"amount", amount},
          {"price", std::move(price)}};
}

}  // namespace

Json values_of(const Draft& draft) {
  Json all = Json::array();
  // Elements with problems have defaults, which nobody should confirm.
  if (!draft.problems.empty()) return all;
  for (const DecisiveValue& value : draft.scene.values) {
    all.push_back(to_json(value, draft.store.unit));
    all.back()["words"] = value_words(english(), value);
  }
  return all;
}

Json products_of(const Draft& draft) {
  const Store& store = draft.store;
  Json labels = Json::array(), units = Json::array();
  for (std::size_t k = 0; k < store.shared.label_types; ++k) {
    const LabelType& type = store.label_types[k];
    labels.push_back(product(type, type.threshold, type.price ? Json(*type.price) : Json()));
  }
  for (std::size_t k = 0; k < store.shared.transceiver_types; ++k) {
    const TransceiverType& type = store.transceiver_types[k];
    units.push_back(product(type, power(type.emission), type.has_cost ? Json(type.cost) : Json()));
  }
  return {{"label_types", std::move(labels)}, {"transceiver_types", std::move(units)}};
}

}  // namespace shelfbeam::serve
