#include "shelfbeam/plan/states/assumed_variation.hpp"

namespace shelfbeam {

AssumedVariation assumed_variation(const Store& store) {
  if (!store.variation) return {};
  const StoreVariation& variation = *store.variation;
  const auto has = [&](const auto& test) { return any_shelving(store.fixtures, test); };
  AssumedVariation assumed;
  if (variation.is_assumed && variation.varies(Cause::stock) && has([](const Shelving&) { return true; }))
    assumed.stocking = {variation.stocking.low, variation.stocking.high};
  if (variation.doors.empty() && variation.varies(Cause::doors) &&
      has([](const Shelving& shelves) { return shelves.doors.has_value() && !shelves.variation.open; }))
    assumed.open_doors = variation.open_doors;
  return assumed;
}

std::vector<std::string> causes_left_out(const Store& store) {
  std::vector<std::string> names;
  if (store.variation)
    for (const Cause cause : store.variation->without) names.emplace_back(to_text(cause));
  return names;
}

}  // namespace shelfbeam
