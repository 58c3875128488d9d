#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

Responsivity read_table(const JsonCursor& cursor) {
  cursor.expect_keys({"type", "theta_deg", "response"});
  const std::vector<double> theta = read_angles_from_zero(cursor["theta_deg"], 90);
  if (theta.size() < 2) cursor["theta_deg"].fail("has one angle", "at least two are needed");
  return ResponseTable{{theta, {0}, read_amounts(cursor["response"], theta.size())}};
}

Responsivity read_responsivity(const JsonCursor& cursor) {
  const std::string type = cursor["type"].choice({"cosine", "cosine_power", "table"});
  if (type == "table") return read_table(cursor);
  if (type == "cosine_power") {
    cursor.expect_keys({"type", "exponent", "cutoff_deg"});
    const double exponent = cursor["exponent"].number(0, 1000);
    const auto cutoff = cursor.find("cutoff_deg");
    return CosinePowerResponse{exponent, radians(cutoff ? cutoff->number(0.1, 90) : 90)};
  }
  cursor.expect_keys({"type"});
  return CosineResponse{};
}

std::array<double, 2> read_size(const JsonCursor& cursor) {
  cursor.numbers(2);
  const auto values = cursor.elements();
  const std::array size{read_extent(values[0], 1e-3), read_extent(values[1], 1e-3)};
  if ((size[0] > 0) != (size[1] > 0))
    cursor.fail("is 0 in one direction only", "give [width, height], or [0, 0] for a point");
  return size;
}

/// The signal of the unit that a label faces, on a straight line without anything in between: tau = I R(0) /
/// d^2.
double read_range(const JsonCursor& cursor, const Store& store, const StoreNames& names,
                  const Responsivity& responsivity) {
  cursor.expect_keys({"hears", "at_m", "angle_deg"});
  const TransceiverType& unit = store.transceiver_types[names.transceiver_type(cursor["hears"]).value];
  const double distance = read_length(cursor["at_m"]);
  const auto given = cursor.find("angle_deg");
  const double angle_deg = given ? given->number(0, 180) : 0;
  // Rounding leaves a trace of light where a closed form has none.
  const double intensity = mean_intensity(unit.emission, radians(angle_deg));
  if (!(intensity > 1e-12 * power(unit.emission)))
    cursor.fail(fmt::format("'{}' emits nothing at {} degrees from its axis", unit.name, angle_deg),
                "give the 'angle_deg' of a direction that it shines in");
  const double ahead = response(responsivity, 1);
  if (!(ahead > 0))
    cursor.fail("a label of this type hears nothing from straight ahead", "give the threshold as a number");
  const double threshold = intensity * ahead / (distance * distance);
  if (threshold < least_quantity || threshold > largest_amount)
    cursor.fail(fmt::format("makes a threshold of {:.3g} W/m^2, which is outside {} to {}", threshold,
                            least_quantity, largest_amount),
                "check distance and angle");
  return threshold;
}

}  // namespace

void read_label_types(const JsonCursor& section, Store& store) {
  const StoreNames names(store);
  for (const auto& [name, cursor] : section.members()) {
    cursor.expect_keys({"responsivity", "size", "threshold", "safety_factor", "link_cost", "signal_cost"});
    LabelType type;
    type.name = check_name(name, cursor.where());
    if (const auto responsivity = cursor.find("responsivity")) {
      type.responsivity = made_at(*responsivity, [&] { return read_responsivity(*responsivity); });
      if (!(integral(type.responsivity) > 0)) responsivity->fail("hears nothing", "give it some response");
    }
    if (const auto size = cursor.find("size")) type.size = read_size(*size);
    const JsonCursor threshold = cursor["threshold"];
    type.threshold = threshold.is_object() ? read_range(threshold, store, names, type.responsivity)
                                           : read_quantity(threshold);
    if (const auto factor = cursor.find("safety_factor")) type.safety_factor = read_quantity(*factor);
    if (const auto cost = cursor.find("link_cost")) type.link_cost = read_amount(*cost);
    if (const auto cost = cursor.find("signal_cost")) type.signal_cost = read_amount(*cost);
    store.label_types.push_back(std::move(type));
  }
}

}  // namespace shelfbeam
