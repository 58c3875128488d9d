#include "shelfbeam/plan/states/assumed_variation.hpp"

namespace shelfbeam {

AssumedVariation assumed_variation(const Store& store) {
  if (!store.variation) return {};
  const StoreVariation& variation = *store.variation;
  const auto has = [&](const auto& test) { return any_shelving(store.fixtures, test); };
  AssumedVariation assumed;
  if (variation.is_assumed && has([](const Shelving&) { return true; }))
    assumed.stocking = {variation.stocking.low, variation.stocking.high};
  if (variation.doors.empty() &&
      has([](const Shelving& shelves) { return shelves.doors.has_value() && !shelves.variation.open; }))
    assumed.open_doors = variation.open_doors;
  return assumed;
}

}  // namespace shelfbeam
