#include "shelfbeam/scene/build/resolved_types.hpp"

#include <cstddef>
#include <optional>
#include <vector>

#include "shelfbeam/scene/build/degrees.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Masking masking) {
  switch (masking) {
    case Masking::smith_rational:
      return "smith_rational";
    case Masking::cook_torrance:
      return "cook_torrance";
    case Masking::smith:
      break;
  }
  return "smith";
}

Json with_facets(Json json, const std::optional<Microfacets>& facets) {
  if (!facets) return json;
  if (facets->isotropic())
    json["roughness"] = facets->alpha_x;
  else
    json["roughness"] = {facets->alpha_x, facets->alpha_y};
  json["distribution"] = facets->distribution == FacetDistribution::ggx ? "ggx" : "beckmann";
  json["masking"] = name_of(facets->masking);
  json["sampling"] = facets->sampling == FacetSampling::visible ? "visible" : "all";
  return json;
}

Json keys(const Lambertian& m) {
  return {{"reflectance", m.reflectance}};
}
Json keys(const Conductor& m) {
  return with_facets({{"eta", m.eta}, {"k", m.k}}, m.facets);
}
Json keys(const Plastic& m) {
  return with_facets({{"ior", m.ior}, {"reflectance", m.reflectance}}, m.facets);
}
Json keys(const Dielectric& m) {
  return with_facets({{"ior", m.ior}}, m.facets);
}
Json keys(const ThinDielectric& m) {
  return {{"ior", m.ior}, {"thickness", m.thickness}, {"absorption_per_m", m.absorption_per_m}};
}

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
  Json json{{"theta_deg", degrees_of(table.theta())}};
  if (table.phi().size() == 1) {
    json["intensity"] = table.values();
    return json;
  }
  json["phi_deg"] = degrees_of(table.phi());
  json["intensity"] = Json::array();
  const auto width = static_cast<std::ptrdiff_t>(table.theta().size());
  for (auto row = table.values().begin(); row != table.values().end(); row += width)
    json["intensity"].push_back(std::vector<double>(row, row + width));
  return json;
}

template <class Variant>
Json typed(const Variant& value) {
  Json json{{"type", type_name(value)}};
  json.update(std::visit([](const auto& v) { return keys(v); }, value));
  return json;
}

Json responsivity(const CosineResponse&) {
  return {{"type", "cosine"}};
}
Json responsivity(const CosinePowerResponse& r) {
  return {{"type", "cosine_power"}, {"exponent", r.exponent}, {"cutoff_deg", degrees_of(r.cutoff)}};
}
Json responsivity(const ResponseTable& r) {
  return {
      {"type", "table"}, {"theta_deg", degrees_of(r.response.theta())}, {"response", r.response.values()}};
}

}  // namespace

Json resolved(const Material& material) {
  return typed(material);
}

Json resolved(const LabelType& type) {
  return {{"responsivity", std::visit([](const auto& r) { return responsivity(r); }, type.responsivity)},
          {"size", type.size},
          {"threshold", type.threshold},
          {"safety_factor", type.safety_factor},
          {"link_cost", type.link_cost},
          {"signal_cost", type.signal_cost}};
}

Json resolved(const TransceiverType& type) {
  return {{"emission", typed(type.emission)}, {"radius", type.radius}, {"cost", type.cost}};
}

}  // namespace shelfbeam
