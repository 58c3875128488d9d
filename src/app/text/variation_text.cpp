#include "app/text/variation_text.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::app {

namespace {

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

std::string number_text(const StandingBoxes& boxes) {
  if (const auto* poisson = std::get_if<PoissonNumber>(&boxes.number))
    return fmt::format("{:.3g} on average", poisson->mean);
  if (const auto* ends = std::get_if<UniformNumber>(&boxes.number))
    return ends->low == ends->high ? fmt::format("{}", ends->low)
                                   : fmt::format("{} to {}", ends->low, ends->high);
  return percent(std::get<Presence>(boxes.number).probability) + " of the time";
}

std::string area_text(const PlanArea& area) {
  const auto* name = std::get_if<std::string>(&area);
  if (name == nullptr) return "in an area";
  if (*name == room_without_zones) return "in the room outside its zones";
  return *name == whole_room ? "in the whole room" : "in " + in_quotes(*name);
}

}  // namespace

std::vector<std::string> variation_lines(const Store& store) {
  if (!store.variation) return {};
  const StoreVariation& variation = *store.variation;
  std::vector<std::string> lines;
  const auto has = [&](const auto& test) { return any_shelving(store.fixtures, test); };
  if (has([](const Shelving&) { return true; })) {
    const auto& [low, high] = variation.stocking;
    lines.push_back(fmt::format("shelves are {} full{}",
                                low == high ? percent(low) : percent(low) + " to " + percent(high),
                                variation.is_assumed ? " (assumed)" : ""));
  }
  const auto has_own = [](const Shelving& shelves) { return shelves.variation.stocking.has_value(); };
  if (has(has_own)) lines.push_back("some fixtures have their own stock");
  if (has([](const Shelving& shelves) { return shelves.doors.has_value(); })) {
    for (const OpenDoors& doors : variation.doors)
      lines.push_back(fmt::format("doors of {} are open for {} of the time", in_quotes(doors.fixtures),
                                  percent(doors.open)));
    if (variation.doors.empty() &&
        has([](const Shelving& shelves) { return shelves.doors.has_value() && !shelves.variation.open; }))
      lines.push_back(
          fmt::format("doors are open for {} of the time (assumed)", percent(variation.open_doors)));
  }
  for (const StandingBoxes& boxes : variation.boxes)
    lines.push_back(fmt::format("{}: {} {}", boxes.is_person ? "people" : boxes.id, number_text(boxes),
                                area_text(boxes.area)));
  if (variation.position > 0 || variation.tilt_deg > 0)
    lines.push_back(
        fmt::format("units are mounted within {:.3g} cm and {:.3g} degrees of the plan (standard deviations)",
                    100 * variation.position, variation.tilt_deg));
  if (variation.unit_power_db > 0)
    lines.push_back(
        fmt::format("the power of units varies by {:.3g} dB (standard deviation)", variation.unit_power_db));
  if (variation.label_sensitivity_db > 0)
    lines.push_back(fmt::format("the sensitivity of labels varies by {:.3g} dB (standard deviation)",
                                variation.label_sensitivity_db));
  if (!variation.without.empty()) {
    std::vector<std::string_view> keys;
    for (const Cause cause : variation.without) keys.push_back(key_of(cause));
    lines.push_back(fmt::format("left out: {}", fmt::join(keys, ", ")));
  }
  return lines;
}

}  // namespace shelfbeam::app
