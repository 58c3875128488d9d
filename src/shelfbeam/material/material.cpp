#include "shelfbeam/material/material.hpp"

#include <stdexcept>

namespace shelfbeam {

namespace {

template <class Model>
const Model& from_below(const Model& model) {
  return model;
}
Dielectric from_below(const Dielectric& model) {
  return {1 / model.ior, model.facets};
}

// Turns the surface over where the known direction lies below it, so that the models need not.
class Side {
 public:
  explicit Side(const Vec3& known) : below_(known.z < 0) {}

  Vec3 turn(const Vec3& w) const { return {w.x, w.y, below_ ? -w.z : w.z}; }

  template <class Action>
  auto visit(const Material& material, const Action& action) const {
    return std::visit([&](const auto& m) { return below_ ? action(from_below(m)) : action(m); }, material);
  }

 private:
  bool below_;
};

}  // namespace

double eval(const Material& material, const Vec3& known, const Vec3& sampled) {
  if (known.z == 0 || sampled.z == 0) return 0;
  const Side side(known);
  return side.visit(material, [&](const auto& m) { return m.eval(side.turn(known), side.turn(sampled)); });
}

double pdf(const Material& material, const Vec3& known, const Vec3& sampled) {
  if (known.z == 0 || sampled.z == 0) return 0;
  const Side side(known);
  return side.visit(material, [&](const auto& m) { return m.pdf(side.turn(known), side.turn(sampled)); });
}

std::optional<ScatterSample> sample(const Material& material, const Vec3& known, double u_lobe, double u1,
                                    double u2) {
  if (known.z == 0) return std::nullopt;
  const Side side(known);
  auto drawn =
      side.visit(material, [&](const auto& m) { return m.sample(side.turn(known), u_lobe, u1, u2); });
  if (drawn) drawn->direction = side.turn(drawn->direction);
  return drawn;
}

double albedo(const Material& material, const Vec3& known) {
  if (known.z == 0) return 0;
  const Side side(known);
  return side.visit(material, [&](const auto& m) { return m.albedo(side.turn(known)); });
}

double specular_reflectance(const Material& material, const Vec3& known) {
  if (known.z == 0) return 0;
  const Side side(known);
  return side.visit(material, [&](const auto& m) { return m.specular_reflectance(side.turn(known)); });
}

bool has_only_specular(const Material& material) {
  return std::visit([](const auto& m) { return m.has_only_specular(); }, material);
}

std::optional<double> given_reflectance(const Material& material) {
  if (const auto* diffuse = std::get_if<Lambertian>(&material)) return diffuse->reflectance;
  if (const auto* coated = std::get_if<Plastic>(&material)) return coated->reflectance;
  return std::nullopt;
}

Material with_reflectance(const Material& material, double reflectance) {
  if (std::holds_alternative<Lambertian>(material)) return make_lambertian(reflectance);
  if (const auto* coated = std::get_if<Plastic>(&material))
    return make_plastic(coated->ior, reflectance, coated->facets);
  throw std::invalid_argument("a material without a reflectance of its own was to get one");
}

std::string_view type_name(const Material& material) {
  return std::visit([](const auto& m) { return m.type_name; }, material);
}

}  // namespace shelfbeam
