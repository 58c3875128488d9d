#include "shelfbeam/material/material.hpp"

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

double eval(const Lambertian& m, const Vec3& outgoing, const Vec3& incoming) {
  return outgoing.z > 0 && incoming.z > 0 ? m.reflectance / pi : 0;  // (2.21)
}

double pdf(const Lambertian&, const Vec3& outgoing, const Vec3& incoming) {
  return outgoing.z > 0 ? pdf_cosine_hemisphere(incoming) : 0;
}

std::optional<ScatterSample> sample(const Lambertian& m, const Vec3&, double u1, double u2) {
  if (m.reflectance <= 0) return std::nullopt;
  const Vec3 direction = sample_cosine_hemisphere(u1, u2);
  return ScatterSample{direction, m.reflectance, pdf_cosine_hemisphere(direction)};
}

double albedo(const Lambertian& m, const Vec3&) {
  return m.reflectance;
}

std::string_view type_name(const Lambertian&) {
  return "lambertian";
}

}  // namespace

double eval(const Material& material, const Vec3& outgoing, const Vec3& incoming) {
  return std::visit([&](const auto& m) { return eval(m, outgoing, incoming); }, material);
}

double pdf(const Material& material, const Vec3& outgoing, const Vec3& incoming) {
  return std::visit([&](const auto& m) { return pdf(m, outgoing, incoming); }, material);
}

std::optional<ScatterSample> sample(const Material& material, const Vec3& outgoing, double u1, double u2) {
  return std::visit([&](const auto& m) { return sample(m, outgoing, u1, u2); }, material);
}

double albedo(const Material& material, const Vec3& outgoing) {
  return std::visit([&](const auto& m) { return albedo(m, outgoing); }, material);
}

std::string_view type_name(const Material& material) {
  return std::visit([](const auto& m) { return type_name(m); }, material);
}

}  // namespace shelfbeam
