#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

EmissionTable read_table(const JsonCursor& cursor) {
  cursor.expect_keys({"type", "theta_deg", "phi_deg", "intensity"});
  const std::vector<double> theta = read_angles(cursor["theta_deg"], 180);
  if (theta.size() < 2) cursor["theta_deg"].fail("has one angle", "at least two are needed");
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
      // The profile is periodic: the plane at 360 degrees is the one at 0.
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
      // Its place is in the photometric file; the store file that names it may name others.
      throw InputError(cursor["file"].where(), refused.what());
    }
  }();
  const double peak = *std::max_element(table.values().begin(), table.values().end());
  if (peak > largest_amount)
    flux.fail(fmt::format("makes an intensity of {:.3g} W/sr with this profile", peak), "use less");
  return EmissionTable{table};
}

Emission read_profile(const JsonCursor& cursor, const StoreFolder& folder) {
  const std::string type =
      cursor["type"].choice({"sin2theta", "isotropic", "lambertian", "table", "ies", "eulumdat"});
  if (type == "table") return read_table(cursor);
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

}  // namespace

Emission read_emission(const JsonCursor& cursor, const StoreFolder& folder) {
  Emission emission = made_at(cursor, [&] { return read_profile(cursor, folder); });
  if (!(power(emission) > 0)) cursor.fail("emits nothing", "give it some intensity");
  return emission;
}

}  // namespace shelfbeam
