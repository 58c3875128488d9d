#include "shelfbeam/material/material.hpp"

#include <stdexcept>

namespace shelfbeam {

namespace {

template <class Model>
decltype(auto) from_below(const Model& model) {
  if constexpr (requires { model.from_below(); })
    return model.from_below();
  else
    return (model);
}

// Turns the surface over if `wo` lies below it, so that the models do not need to.
class Side {
 public:
  explicit Side(const Vec3& wo) : below_(wo.z < 0) {}

  Vec3 turn(const Vec3& w) const { return {w.x, w.y, below_ ? -w.z : w.z}; }

  template <class Action>
  auto visit(const Material& material, const Action& action) const {
    return std::visit([&](const auto& m) { return below_ ? action(from_below(m)) : action(m); }, material);
  }

 private:
  bool below_;
};

}  // namespace

double eval(const Material& material, const Vec3& wo, const Vec3& wi) {
  if (wo.z == 0 || wi.z == 0) return 0;
  const Side side(wo);
  return side.visit(material, [&](const auto& m) { return m.eval(side.turn(wo), side.turn(wi)); });
}

double pdf(const Material& material, const Vec3& wo, const Vec3& wi) {
  if (wo.z == 0 || wi.z == 0) return 0;
  const Side side(wo);
  return side.visit(material, [&](const auto& m) { return m.pdf(side.turn(wo), side.turn(wi)); });
}

std::optional<ScatterSample> sample(const Material& material, const Vec3& wo, double u_lobe, double u1,
                                    double u2) {
  if (wo.z == 0) return std::nullopt;
  const Side side(wo);
  auto drawn = side.visit(material, [&](const auto& m) { return m.sample(side.turn(wo), u_lobe, u1, u2); });
  if (drawn) drawn->direction = side.turn(drawn->direction);
  return drawn;
}

double albedo(const Material& material, const Vec3& wo) {
  if (wo.z == 0) return 0;
  const Side side(wo);
  return side.visit(material, [&](const auto& m) { return m.albedo(side.turn(wo)); });
}

double specular_reflectance(const Material& material, const Vec3& wo) {
  if (wo.z == 0) return 0;
  const Side side(wo);
  return side.visit(material, [&](const auto& m) { return m.specular_reflectance(side.turn(wo)); });
}

bool has_only_specular(const Material& material) {
  return std::visit([](const auto& m) { return m.has_only_specular(); }, material);
}

bool is_opaque(const Material& material) {
  return std::visit([](const auto& m) { return m.is_opaque(); }, material);
}

bool is_pane(const Material& material) {
  return std::holds_alternative<ThinDielectric>(material);
}

double pane_transmittance(const Material& pane, double cos_theta) {
  return pane_shares(pane, cos_theta).transmitted;
}

PaneShares pane_shares(const Material& pane, double cos_theta) {
  return pane_shares(std::get<ThinDielectric>(pane), cos_theta);
}

bool is_solid(const Material& material) {
  return std::holds_alternative<Dielectric>(material);
}

std::optional<double> given_reflectance(const Material& material) {
  const auto given = [](const auto& m) -> std::optional<double> {
    if constexpr (requires { m.reflectance; })
      return m.reflectance;
    else
      return std::nullopt;
  };
  return std::visit(given, material);
}

Material with_reflectance(const Material& material, double reflectance) {
  const auto changed = [&](const auto& m) -> Material {
    if constexpr (requires { m.with_reflectance(reflectance); })
      return m.with_reflectance(reflectance);
    else
      throw std::invalid_argument("a material without a given reflectance cannot get one");
  };
  return std::visit(changed, material);
}

std::string_view type_name(const Material& material) {
  return std::visit([](const auto& m) { return m.type_name; }, material);
}

}  // namespace shelfbeam
