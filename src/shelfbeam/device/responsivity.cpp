#include "shelfbeam/device/responsivity.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/device/direction_densities.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

double response(const CosineResponse&, double cos_theta) {
  return std::max(0.0, cos_theta);
}
double largest(const CosineResponse&) {
  return 1;
}
double integral(const CosineResponse&) {
  return pi;
}
double pdf(const CosineResponse&, const Vec3& d) {
  return pdf_cosine_hemisphere(d);
}
Vec3 draw(const CosineResponse&, double u1, double u2) {
  return sample_cosine_hemisphere(u1, u2);
}
detail::CosinePower lobe(const CosinePowerResponse& r) {
  return {r.exponent, std::cos(r.cutoff)};
}
double response(const CosinePowerResponse& r, double cos_theta) {
  return lobe(r).value(cos_theta);
}
double largest(const CosinePowerResponse&) {
  return 1;
}
double integral(const CosinePowerResponse& r) {
  return lobe(r).integral();
}
double pdf(const CosinePowerResponse& r, const Vec3& d) {
  return lobe(r).pdf(d);
}
Vec3 draw(const CosinePowerResponse& r, double u1, double u2) {
  return lobe(r).draw(u1, u2);
}
double response(const ResponseTable& r, double cos_theta) {
  return cos_theta > 0 ? r.response.value(std::acos(std::min(1.0, cos_theta)), 0) : 0;
}

double largest(const ResponseTable& r) {
  return std::ranges::max(r.response.values());
}
double integral(const ResponseTable& r) {
  return r.response.integral();
}

double pdf(const ResponseTable& r, const Vec3& d) {
  return r.response.pdf(d);
}
template <class Closed>
std::optional<DirectionSample> drawn(const Closed& r, double u1, double u2) {
  const Vec3 direction = draw(r, u1, u2);
  return usable(direction, pdf(r, direction));
}
std::optional<DirectionSample> drawn(const ResponseTable& r, double u1, double u2) {
  return r.response.sample(u1, u2);
}

}  // namespace

double response(const Responsivity& responsivity, double cos_theta) {
  return std::visit([&](const auto& r) { return response(r, cos_theta); }, responsivity);
}

double largest(const Responsivity& responsivity) {
  return std::visit([](const auto& r) { return largest(r); }, responsivity);
}

double integral(const Responsivity& responsivity) {
  return std::visit([](const auto& r) { return integral(r); }, responsivity);
}

std::optional<DirectionSample> sample(const Responsivity& responsivity, double u1, double u2) {
  return std::visit([&](const auto& r) { return drawn(r, u1, u2); }, responsivity);
}

double pdf(const Responsivity& responsivity, const Vec3& direction) {
  return std::visit([&](const auto& r) { return pdf(r, direction); }, responsivity);
}

std::string_view type_name(const Responsivity& responsivity) {
  return std::visit([](const auto& r) { return r.type_name; }, responsivity);
}

}  // namespace shelfbeam
