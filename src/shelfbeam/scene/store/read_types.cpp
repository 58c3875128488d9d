#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/fields/describe_choice.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/device/picture.hpp"
#include "shelfbeam/math/warp.hpp"
#include "shelfbeam/scene/field_values.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

Json in_degrees(const std::vector<double>& angles) {
  Json result = Json::array();
  for (const double angle : angles) result.push_back(degrees_of(angle));
  return result;
}

// Types in the resolved store: without references, and identical to the bit when read back.

Json keys(const SinTwoTheta& e) {
  return {{"peak", e.peak}};
}
Json keys(const IsotropicHemisphere& e) {
  return {{"intensity", e.intensity}};
}
Json keys(const GeneralizedLambertian& e) {
  return {{"order", e.order}, {"flux", e.flux}};
}
Json keys(const EmissionTable& e) {
  const DirectionTable& table = e.intensity;
  Json json{{"theta_deg", in_degrees(table.theta())}};
  if (table.phi().size() == 1) {
    json["intensity"] = table.values();
    return json;
  }
  json["phi_deg"] = in_degrees(table.phi());
  json["intensity"] = Json::array();
  const auto width = static_cast<std::ptrdiff_t>(table.theta().size());
  for (auto row = table.values().begin(); row != table.values().end(); row += width)
    json["intensity"].push_back(std::vector<double>(row, row + width));
  return json;
}
Json keys(const CosineResponse&) {
  return Json::object();
}
Json keys(const CosinePowerResponse& r) {
  return {{"exponent", r.exponent}, {"cutoff_deg", degrees_of(r.cutoff)}};
}
Json keys(const ResponseTable& r) {
  return {{"theta_deg", in_degrees(r.response.theta())}, {"response", r.response.values()}};
}

template <class Variant>
Json with_type(const Variant& value) {
  Json json{{"type", type_name(value)}};
  json.update(std::visit([](const auto& one) { return keys(one); }, value));
  return json;
}

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

template <class Parse>
EmissionTable read_photometry(const JsonCursor& cursor, const StoreFolder& folder, Parse parse) {
  cursor.expect_keys({"type", "file", "flux"});
  const InputFile file = folder.find(cursor["file"]);
  const JsonCursor flux = cursor["flux"];
  const double watts = read_quantity(flux);
  const DirectionTable table = [&] {
    try {
      return parse(file.read(max_photometry_file), file.name()).with_integral(watts);
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

// A file, or in a resolved store the picture itself.
std::string read_picture(const JsonCursor& cursor, const StoreFolder& folder) {
  std::string text = cursor.text();
  if (text.starts_with("data:")) {
    if (!is_picture_uri(text))
      cursor.fail("is not a data URI of a PNG, JPEG or SVG picture of at most 500 kB", "name a file");
    return text;
  }
  const InputFile file = folder.find(cursor);
  const auto fail = [&](const std::string& problem, const char* remedy) {
    cursor.fail(fmt::format("{} {}", file.name(), problem), remedy);
  };
  if (file.size() > max_picture_file)
    fail(fmt::format("has {} bytes; the maximum of a picture is {}", grouped(file.size()),
                     grouped(max_picture_file)),
         "make the picture smaller: 400 pixels are enough");
  auto uri = picture_uri(file.read(max_picture_file));
  if (!uri) fail("is not a PNG, JPEG or SVG picture", "save it in one of these formats");
  return *uri;
}

Emission read_profile(const JsonCursor& cursor, const StoreFolder& folder) {
  const std::string type =
      cursor["type"].choice({"sin2theta", "isotropic", "lambertian", "table", "ies", "eulumdat"});
  if (type == "table") return read_emission_table(cursor);
  if (type == "ies") return read_photometry(cursor, folder, parse_ies);
  if (type == "eulumdat") return read_photometry(cursor, folder, parse_eulumdat);
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
double read_range(const JsonCursor& cursor, const TypeSource& source, const Responsivity& responsivity) {
  cursor.expect_keys({"hears", "at_m", "angle_deg"});
  const TransceiverType& unit =
      source.store.transceiver_types[source.names.transceiver_type(cursor["hears"]).value];
  source.problems.expect_complete("transceiver type " + unit.name);
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

void describe_origin(Fields& f, TypeOrigin& origin) {
  std::string product;
  f.text("product", product,
         {.says = "[product](values.md#products) of a catalogue, whose keys the type has unless it has them "
                  "itself",
          .is_name = true,
          .is_optional = true,
          .otherwise = "none",
          .is_written = false});
  describe_note(f, "name", origin.name, "name for reports; of a product its name");
  ValueSource source = origin.source.value_or(ValueSource::datasheet);
  const bool is_known = source == ValueSource::datasheet || source == ValueSource::measured;
  // The resolved store marks assumed values one by one.
  if (describe_choice<ValueSource>(f, "source", source, names_of<ValueSource>,
                                   {.says = "[origin](values.md) of the values",
                                    .is_optional = true,
                                    .otherwise = "none",
                                    .is_written = origin.source.has_value() && is_known}))
    origin.source = source;
}

void describe_picture(Fields& f, std::string& picture, const TypeSource* source, std::string_view says) {
  const std::string meaning = fmt::format("{}the name of a PNG, JPEG or SVG file", says);
  f.custom("picture",
           {[&](const JsonCursor& json) { picture = read_picture(json, source->folder); },
            [&] { return Json(picture); }, R"({"type": "string", "minLength": 1})"},
           {.says = meaning, .is_optional = true, .otherwise = "none", .is_written = !picture.empty()});
}

}  // namespace

Emission read_emission(const JsonCursor& cursor, const StoreFolder& folder) {
  Emission emission = make_or_fail(cursor, [&] { return read_profile(cursor, folder); });
  if (!(power(emission) > 0)) cursor.fail("emits nothing", "give a positive intensity");
  return emission;
}

void describe(LabelType& type, Fields& f, const TypeSource* source) {
  const CustomValue responsivity{
      [&](const JsonCursor& json) {
        type.responsivity = make_or_fail(json, [&] { return read_responsivity(json); });
        if (!(integral(type.responsivity) > 0)) json.fail("is zero", "give a positive response");
      },
      [&] { return with_type(type.responsivity); }, R"({"$ref": "#/$defs/responsivity"})"};
  f.custom("responsivity", responsivity,
           {.says = "[response](#responsivity) of the label by angle",
            .is_optional = true,
            .otherwise = "`{ \"type\": \"cosine\" }`"});
  const CustomValue size{[&](const JsonCursor& json) { type.size = read_size(json); },
                         [&] { return nlohmann::ordered_json(type.size); },
                         R"({"$ref": "#/$defs/label_size"})"};
  f.custom(
      "size", size,
      {.says =
           "`[width, height]`, width horizontal, each 0.001 to 10; the signal is averaged over this area; "
           "`[0, 0]` is a point",
       .unit = "m",
       .is_optional = true,
       .otherwise = "`[0, 0]`"});
  const CustomValue threshold{[&](const JsonCursor& json) {
                                if (json.is_object()) {
                                  type.threshold = read_range(json, *source, type.responsivity);
                                  type.range_m = json["at_m"].number();
                                  type.range_of = json["hears"].text();
                                } else {
                                  type.threshold = read_quantity(json);
                                }
                              },
                              [&] { return nlohmann::ordered_json(type.threshold); },
                              R"({"$ref": "#/$defs/threshold"})"};
  f.custom(
      "threshold", threshold,
      {.says =
           "activation threshold: a signal, or a [distance](#threshold-by-distance) at which the label is "
           "reached",
       .unit = "W/m²",
       .otherwise = "*required*, or `product`"});
  f.scalar("safety_factor", Scalar::quantity, type.safety_factor,
           {.says = "the requirement is `safety_factor` x `threshold`",
            .usual_least = 1,
            .usual_most = 10,
            .usual = "1 to 4 are typical; below 1, labels count as reached below their threshold",
            .is_optional = true});
  // These and the notes of a transceiver type stand before keys that are always written (hash_of_resolved).
  describe_origin(f, type.origin);
  describe_note(f, "order_number", type.order_number, "order number, for the choice of a product");
  describe_picture(f, type.picture, source, "picture, for the choice of a product: ");
  double price = type.price.value_or(0);
  if (f.scalar("price", Scalar::amount, price,
               {.says = "price of one label; no plan depends on it",
                .unit = "cost",
                .is_optional = true,
                .otherwise = "none",
                .is_written = type.price.has_value()}))
    type.price = price;
  f.scalar(
      "link_cost", Scalar::amount, type.link_cost,
      {.says = "cost of a link to a label of this type, for the objectives `links` and `effective-links`",
       .unit = "cost",
       .is_optional = true});
  f.scalar("signal_cost", Scalar::amount, type.signal_cost,
           {.says = "cost of signal at a label of this type, for the objective `signal`",
            .unit = "cost per W/m²",
            .is_optional = true});
  f.scalar(
      "availability", Scalar::share, type.availability,
      {.says =
           "minimum share of the states in which a label must be reached, if the shop [varies](variation.md)",
       .least = 0.01,
       .most = 0.9999,
       .is_optional = true,
       .is_written = type.availability != LabelType{}.availability});
}

void describe(TransceiverType& type, Fields& f, const TypeSource* source) {
  const CustomValue emission{[&](const JsonCursor& json) {
                               type.emission = read_emission(json, source->folder);
                               if (const auto file = json.find("file"))
                                 type.file = std::filesystem::path(file->text()).filename().string();
                             },
                             [&] { return with_type(type.emission); }, R"({"$ref": "#/$defs/emission"})"};
  f.custom("emission", emission,
           {.says = "radiant intensity by [direction](#emission)", .otherwise = "*required*, or `product`"});
  f.scalar("radius", Scalar::extent, type.radius,
           {.says = "radius of a flat disc about the axis, 0.0001 to 10; 0 is a point",
            .usual_most = 0.3,
            .usual = "up to 0.1 m is typical; correct it",
            .is_optional = true});
  describe_origin(f, type.origin);
  describe_note(f, "order_number", type.order_number, "order number, for the report");
  describe_note(f, "fixing", type.fixing,
                "how a unit is fixed, such as with a magnet on the T-bar; for the mounting sheet");
  describe_picture(f, type.picture, source, "[picture](#picture) for the mounting sheet: ");
  if (f.scalar("cost", Scalar::amount, type.cost,
               {.says = "price of one unit. Where the prices of the candidates differ, `plan` and `place` "
                        "minimise the new "
                        "spend first ([rules](../../methods/placement.md#prices))",
                .unit = "cost",
                .is_optional = true}))
    type.has_cost = true;
}

void Products::add(const JsonCursor& catalogue) {
  if (const auto section = catalogue.find(list_); section && section->is_object())
    for (const auto& [name, product] : section->members()) products_.emplace(name, product);
}

JsonCursor Products::complete(const JsonCursor& type, TypeOrigin& origin) const {
  constexpr std::pair<ValueKind, std::string_view> keys[] = {{ValueKind::threshold, "threshold"},
                                                             {ValueKind::responsivity, "responsivity"},
                                                             {ValueKind::power, "emission"},
                                                             {ValueKind::price, "cost"}};
  const auto reference = type.find("product");
  if (!reference) {
    for (const auto& [kind, key] : keys)
      if (type.find(key)) origin.sourced.push_back(kind);
    return type;
  }
  const std::string name = reference->text();
  const auto found = products_.find(name);
  if (found == products_.end()) {
    std::vector<std::string_view> known;
    for (const auto& [key, product] : products_) known.push_back(key);
    reference->fail(
        fmt::format("names the unknown product {}", in_quotes(name)),
        known.empty() ? fmt::format("define it in '{}' of a catalogue", list_) : suggest(name, known));
  }
  const JsonCursor& product = found->second;
  if (const auto other = product.find("product"))
    other->fail("is a product of another product", "give its values instead");
  const JsonCursor::Origin place{fmt::format("product {} of {}", in_quotes(name), product.file()),
                                 product.unit()};
  Json whole = type.value();
  JsonCursor::Origins origins;
  for (const auto& [key, value] : type.members()) origins[key] = {"", type.unit()};
  for (const auto& [key, value] : product.members())
    if (!whole.contains(key)) {
      whole[key] = value.value();
      origins[key] = place;
    }
  if (!whole.contains("name")) whole["name"] = name;
  const bool has_own_source = type.find("source").has_value();
  for (const auto& [kind, key] : keys)
    if (has_own_source ? type.find(key).has_value() : product.find(key) && !type.find(key))
      origin.sourced.push_back(kind);
  return type.replaced(std::move(whole), origins);
}

void read_label_types(const JsonCursor& section, const StoreFolder& folder, const Products& products,
                      Store& store, Problems& problems) {
  const StoreNames names(store, &problems);
  const TypeSource source{store, names, folder, problems};
  read_named(section, store.label_types, problems, [&](const JsonCursor& json, LabelType& type) {
    problems.collect([&] {
      const JsonCursor whole = products.complete(json, type.origin);
      read_object(whole, names, problems, [&](Fields& f) { describe(type, f, &source); });
    });
  });
}

void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, const Products& products,
                            Store& store, Problems& problems) {
  const StoreNames names(store, &problems);
  const TypeSource source{store, names, folder, problems};
  read_named(section, store.transceiver_types, problems, [&](const JsonCursor& json, TransceiverType& type) {
    bool is_read = false;
    problems.collect([&] {
      const JsonCursor whole = products.complete(json, type.origin);
      is_read = read_object(whole, names, problems, [&](Fields& f) { describe(type, f, &source); });
    });
    if (!is_read) problems.mark("transceiver type " + type.name);
  });
}

}  // namespace shelfbeam
