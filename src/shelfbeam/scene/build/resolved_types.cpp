#include "shelfbeam/scene/build/resolved_types.hpp"

#include <cstddef>
#include <vector>

#include "shelfbeam/scene/build/degrees.hpp"

namespace shelfbeam {

namespace {

using Json = nlohmann::ordered_json;

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

Json resolved(const Emission& emission) {
  Json json{{"type", type_name(emission)}};
  json.update(std::visit([](const auto& e) { return keys(e); }, emission));
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

Json resolved(const LabelType& type) {
  return {{"responsivity", std::visit([](const auto& r) { return responsivity(r); }, type.responsivity)},
          {"size", type.size},
          {"threshold", type.threshold},
          {"safety_factor", type.safety_factor},
          {"link_cost", type.link_cost},
          {"signal_cost", type.signal_cost}};
}

Json resolved(const TransceiverType& type) {
  return {{"emission", resolved(type.emission)}, {"radius", type.radius}, {"cost", type.cost}};
}

}  // namespace shelfbeam
