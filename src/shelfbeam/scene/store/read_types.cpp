#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

EmissionTable read_emission_table(const JsonCursor& cursor) {
  cursor.expect_keys({"type", "theta_deg", "phi_deg", "intensity"});
  const std::vector<double> theta = read_angles(cursor["theta_deg"], 180);
  if (theta.size() < 2) cursor["theta_deg"].fail("has one angle", "at least two are required");
  std::vector<double> phi{0}, values;
  const JsonCursor intensity = cursor["intensity"];
  const auto add_row = [&](const JsonCursor& row) {
    const std::vector<double> amounts = read_amounts(row, theta.size());
    values.insert(values.end(), amounts.begin(), amounts.end());
  };
  if (const auto given = cursor.find("phi_deg")) {
    phi = read_angles_from_zero(*given, 360);
    const auto rows = intensity.elements();
    if (rows.size() != phi.size())
      intensity.fail(fmt::format("has {} rows for {} values of phi", rows.size(), phi.size()),
                     "give one row of values for each phi");
    for (const JsonCursor& row : rows) add_row(row);
    if (phi.size() > 1 && phi.back() < 2 * pi) {
      // The profile is periodic: the plane at 360 degrees repeats the plane at 0.
      phi.push_back(2 * pi);
      values.insert(values.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(theta.size()));
    }
  } else {
    add_row(intensity);
  }
  return EmissionTable{{theta, phi, values}};
}

template <class Read>
EmissionTable read_photometry(const JsonCursor& cursor, const StoreFolder& folder, Read read) {
  cursor.expect_keys({"type", "file", "flux"});
  const std::filesystem::path path = folder.find(cursor["file"]);
  const JsonCursor flux = cursor["flux"];
  const double watts = read_quantity(flux);
  const DirectionTable table = [&] {
    try {
      return read(path).with_integral(watts);
    } catch (const InputError& refused) {
      // Adds the location in the store file to an error inside the photometric file.
      throw InputError(cursor["file"].where(), refused.what());
    }
  }();
  const double peak = *std::max_element(table.values().begin(), table.values().end());
  if (peak > largest_amount)
    flux.fail(fmt::format("produces an intensity of {:.3g} W/sr with this profile", peak), "reduce it");
  return EmissionTable{table};
}

Emission read_profile(const JsonCursor& cursor, const StoreFolder& folder) {
  const std::string type =
      cursor["type"].choice({"sin2theta", "isotropic", "lambertian", "table", "ies", "eulumdat"});
  if (type == "table") return read_emission_table(cursor);
  if (type == "ies") return read_photometry(cursor, folder, read_ies);
  if (type == "eulumdat") return read_photometry(cursor, folder, read_eulumdat);
  if (type == "isotropic") {
    cursor.expect_keys({"type", "intensity"});
    return IsotropicHemisphere{read_quantity(cursor["intensity"])};
  }
  if (type == "lambertian") {
    cursor.expect_keys({"type", "order", "flux"});
    const auto order = cursor.find("order");
    return GeneralizedLambertian{order ? order->number(0, 1e6) : 1, read_quantity(cursor["flux"])};
  }
  cursor.expect_keys({"type", "peak"});
  return SinTwoTheta{read_quantity(cursor["peak"])};
}

Responsivity read_response_table(const JsonCursor& cursor) {
  cursor.expect_keys({"type", "theta_deg", "response"});
  const std::vector<double> theta = read_angles_from_zero(cursor["theta_deg"], 90);
  if (theta.size() < 2) cursor["theta_deg"].fail("has one angle", "at least two are required");
  return ResponseTable{{theta, {0}, read_amounts(cursor["response"], theta.size())}};
}

Responsivity read_responsivity(const JsonCursor& cursor) {
  const std::string type = cursor["type"].choice({"cosine", "cosine_power", "table"});
  if (type == "table") return read_response_table(cursor);
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

/// The threshold as the signal of an unobstructed unit straight in front of the label: tau = I R(0) / d^2.
double read_range(const JsonCursor& cursor, const Store& store, const StoreNames& names,
                  const Responsivity& responsivity) {
  cursor.expect_keys({"hears", "at_m", "angle_deg"});
  const TransceiverType& unit = store.transceiver_types[names.transceiver_type(cursor["hears"]).value];
  const double distance = read_length(cursor["at_m"].with_unit(LengthUnit::m));
  const auto given = cursor.find("angle_deg");
  const double angle_deg = given ? given->number(0, 180) : 0;
  // Rounding leaves a trace of intensity in directions where the closed form is zero.
  const double intensity = mean_intensity(unit.emission, radians(angle_deg));
  if (!(intensity > 1e-12 * power(unit.emission)))
    cursor.fail(fmt::format("{} emits nothing at {} degrees from its axis", in_quotes(unit.name), angle_deg),
                "give an 'angle_deg' at which it emits");
  const double ahead = response(responsivity, 1);
  if (!(ahead > 0))
    cursor.fail("a label of this type has no response straight ahead", "give the threshold as a number");
  const double threshold = intensity * ahead / (distance * distance);
  if (threshold < min_quantity || threshold > largest_amount)
    cursor.fail(fmt::format("produces a threshold of {:.3g} W/m^2, which is outside {} to {}", threshold,
                            min_quantity, largest_amount),
                "check distance and angle");
  return threshold;
}

}  // namespace

Emission read_emission(const JsonCursor& cursor, const StoreFolder& folder) {
  Emission emission = make_or_fail(cursor, [&] { return read_profile(cursor, folder); });
  if (!(power(emission) > 0)) cursor.fail("emits nothing", "give a positive intensity");
  return emission;
}

void read_label_types(const JsonCursor& section, Store& store) {
  const StoreNames names(store);
  for (const auto& [name, cursor] : section.members()) {
    cursor.expect_keys(
        {"responsivity", "size", "threshold", "safety_factor", "link_cost", "signal_cost", "availability"});
    LabelType type;
    type.name = new_name(name, store.label_types, cursor);
    if (const auto responsivity = cursor.find("responsivity")) {
      type.responsivity = make_or_fail(*responsivity, [&] { return read_responsivity(*responsivity); });
      if (!(integral(type.responsivity) > 0)) responsivity->fail("is zero", "give a positive response");
    }
    if (const auto size = cursor.find("size")) type.size = read_size(*size);
    const JsonCursor threshold = cursor["threshold"];
    type.threshold = threshold.is_object() ? read_range(threshold, store, names, type.responsivity)
                                           : read_quantity(threshold);
    if (threshold.is_object()) type.range_m = threshold["at_m"].number();
    if (const auto factor = cursor.find("safety_factor")) type.safety_factor = read_quantity(*factor);
    if (const auto share = cursor.find("availability")) type.availability = share->number(0.01, 0.9999);
    if (const auto cost = cursor.find("link_cost")) type.link_cost = read_amount(*cost);
    if (const auto cost = cursor.find("signal_cost")) type.signal_cost = read_amount(*cost);
    store.label_types.push_back(std::move(type));
  }
}

void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, Store& store) {
  for (const auto& [name, cursor] : section.members()) {
    cursor.expect_keys({"emission", "radius", "cost"});
    TransceiverType type;
    type.name = new_name(name, store.transceiver_types, cursor);
    const JsonCursor emission = cursor["emission"];
    type.emission = read_emission(emission, folder);
    if (const auto file = emission.find("file"))
      type.file = std::filesystem::path(file->text()).filename().string();
    if (const auto radius = cursor.find("radius")) type.radius = read_extent(*radius, 1e-4);
    if (const auto cost = cursor.find("cost")) type.cost = read_amount(*cost);
    store.transceiver_types.push_back(std::move(type));
  }
}

}  // namespace shelfbeam
