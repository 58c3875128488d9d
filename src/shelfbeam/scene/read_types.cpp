#include <fmt/format.h>

#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store_parts.hpp"

namespace shelfbeam {

namespace {

Material read_material(const JsonCursor& cursor) {
  cursor.expect_keys({"type", "reflectance"});
  cursor["type"].choice({"lambertian"});
  const JsonCursor reflectance = cursor["reflectance"];
  const double value = reflectance.non_negative();
  if (value > 1)
    reflectance.fail(fmt::format("is {}: a surface cannot reflect more than it receives", value),
                     "use a value from 0 to 1");
  return Lambertian{value};
}

std::vector<double> read_angles(const JsonCursor& cursor, double last_deg) {
  std::vector<double> angles = cursor.numbers();
  if (angles.empty() || angles.front() != 0) cursor.fail("does not begin at 0", "angles ascend from 0");
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (i > 0 && angles[i] <= angles[i - 1]) cursor.fail("does not ascend", "sort the angles");
    if (angles[i] > last_deg)
      cursor.fail(fmt::format("goes beyond {} degrees", last_deg),
                  fmt::format("end at {} at most", last_deg));
  }
  for (double& angle : angles) angle = radians(angle);
  return angles;
}

EmissionTable read_table(const JsonCursor& cursor) {
  cursor.expect_keys({"type", "theta_deg", "phi_deg", "intensity"});
  const std::vector<double> theta = read_angles(cursor["theta_deg"], 180);
  if (theta.size() < 2) cursor["theta_deg"].fail("has one angle", "at least two are needed");
  std::vector<double> phi{0}, values;
  const JsonCursor intensity = cursor["intensity"];
  const auto add_row = [&](const JsonCursor& row) {
    for (const JsonCursor& value : row.elements()) values.push_back(read_amount(value));
    if (row.elements().size() != theta.size())
      row.fail(fmt::format("has {} values for {} angles", row.elements().size(), theta.size()),
               "give one value for each theta");
  };
  if (const auto given = cursor.find("phi_deg")) {
    phi = read_angles(*given, 360);
    const auto rows = intensity.elements();
    if (rows.size() != phi.size())
      intensity.fail(fmt::format("has {} rows for {} values of phi", rows.size(), phi.size()),
                     "give one row of values for each phi");
    for (const JsonCursor& row : rows) add_row(row);
    if (phi.size() > 1 && phi.back() < 2 * pi) {
      // The profile is periodic: the plane at 360 degrees is the one at 0.
      phi.push_back(2 * pi);
      values.insert(values.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(theta.size()));
    }
  } else {
    add_row(intensity);
  }
  return EmissionTable{{theta, phi, values}};
}

Emission read_emission(const JsonCursor& cursor) {
  const std::string type = cursor["type"].choice({"sin2theta", "isotropic", "lambertian", "table"});
  if (type == "table") return read_table(cursor);
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

double amount_or(const JsonCursor& cursor, const char* key, double fallback) {
  const auto found = cursor.find(key);
  return found ? read_amount(*found) : fallback;
}

void expect_zero(const JsonCursor& extent, const char* what) {
  if (extent.number() != 0)
    extent.fail(fmt::format("is not 0, but this version knows only {}", what), "set it to 0");
}

}  // namespace

void read_materials(const JsonCursor& section, Store& store) {
  for (const auto& [name, cursor] : section.members())
    store.materials.push_back({check_name(name, cursor.where()), read_material(cursor)});
}

void read_label_types(const JsonCursor& section, Store& store) {
  for (const auto& [name, cursor] : section.members()) {
    cursor.expect_keys({"responsivity", "size", "threshold", "safety_factor", "link_cost", "signal_cost"});
    LabelType type;
    type.name = check_name(name, cursor.where());
    if (const auto responsivity = cursor.find("responsivity")) {
      responsivity->expect_keys({"type"});
      (*responsivity)["type"].choice({"cosine"});
    }
    if (const auto size = cursor.find("size")) {
      size->numbers(2);
      for (const JsonCursor& extent : size->elements()) expect_zero(extent, "labels without extent");
    }
    type.threshold = read_quantity(cursor["threshold"]);
    if (const auto factor = cursor.find("safety_factor")) type.safety_factor = read_quantity(*factor);
    type.link_cost = amount_or(cursor, "link_cost", 0);
    type.signal_cost = amount_or(cursor, "signal_cost", 0);
    store.label_types.push_back(std::move(type));
  }
}

void read_transceiver_types(const JsonCursor& section, Store& store) {
  for (const auto& [name, cursor] : section.members()) {
    cursor.expect_keys({"emission", "radius", "cost"});
    if (const auto radius = cursor.find("radius")) expect_zero(*radius, "point transceivers");
    TransceiverType type;
    type.name = check_name(name, cursor.where());
    type.emission = read_emission(cursor["emission"]);
    type.cost = amount_or(cursor, "cost", 1);
    if (!(power(type.emission) > 0)) cursor["emission"].fail("emits nothing", "give it some intensity");
    store.transceiver_types.push_back(std::move(type));
  }
}

}  // namespace shelfbeam
