#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::test {

/// The values of a type in one line, doubles as their bits.
class TypePrint {
 public:
  std::string of(const NamedMaterial& named) {
    out_ << "material " << named.name << ' ' << named.material.index() << ' ';
    std::visit([this](const auto& m) { print(m); }, named.material);
    if (named.reflectance_range) all(*named.reflectance_range);
    return take();
  }
  std::string of(const LabelType& type) {
    out_ << "label type " << type.name << ' ' << type.responsivity.index() << ' ';
    std::visit([this](const auto& r) { print(r); }, type.responsivity);
    all(type.size), all(std::array{type.threshold, type.safety_factor, type.link_cost, type.signal_cost});
    return take();
  }
  std::string of(const TransceiverType& type) {
    out_ << "transceiver type " << type.name << ' ' << type.emission.index() << ' ';
    std::visit([this](const auto& e) { print(e); }, type.emission);
    all(std::array{type.radius, type.cost, power(type.emission)});
    return take();
  }

 private:
  std::string take() { return std::exchange(out_, std::ostringstream()).str(); }
  template <class List>
  void all(const List& values) {
    for (const double x : values) out_ << std::hex << std::bit_cast<std::uint64_t>(x) << ' ';
    out_ << "/ ";
  }
  void print(const std::optional<Microfacets>& f) {
    if (!f) return;
    out_ << static_cast<int>(f->distribution) << ' ' << static_cast<int>(f->masking) << ' '
         << static_cast<int>(f->sampling) << ' ';
    all(std::array{f->alpha_x, f->alpha_y});
  }
  void print(const DirectionTable& t) { all(t.theta()), all(t.phi()), all(t.values()); }
  void print(const Lambertian& m) { all(std::array{m.reflectance}); }
  void print(const Conductor& m) { all(std::array{m.eta, m.k}), print(m.facets); }
  void print(const Plastic& m) {
    all(std::array{m.ior, m.reflectance, m.base_scale, m.base_albedo}), print(m.facets);
  }
  void print(const Dielectric& m) { all(std::array{m.ior}), print(m.facets); }
  void print(const ThinDielectric& m) { all(std::array{m.ior, m.thickness, m.absorption_per_m}); }
  void print(const SinTwoTheta& e) { all(std::array{e.peak}); }
  void print(const IsotropicHemisphere& e) { all(std::array{e.intensity}); }
  void print(const GeneralizedLambertian& e) { all(std::array{e.order, e.flux}); }
  void print(const EmissionTable& e) { print(e.intensity); }
  void print(const CosineResponse&) {}
  void print(const CosinePowerResponse& r) { all(std::array{r.exponent, r.cutoff}); }
  void print(const ResponseTable& r) { print(r.response); }

  std::ostringstream out_;
};

/// All values of a scene on which results depend, as text; doubles as their bits.
inline std::string fingerprint(const Scene& scene) {
  std::ostringstream out;
  const auto bits = [&](double x) { out << std::hex << std::bit_cast<std::uint64_t>(x) << ' '; };
  const auto point = [&](const Vec3& p) { bits(p.x), bits(p.y), bits(p.z); };
  const auto polygon = [&](const std::vector<std::array<double, 2>>& corners) {
    for (const auto& [x, y] : corners) bits(x), bits(y);
  };
  out << scene.name << '\n';
  bits(scene.wavelength_nm);
  if (scene.room) point(scene.room->upper());
  point(scene.lower), point(scene.upper);
  TypePrint types;
  for (const NamedMaterial& material : scene.materials) out << '\n' << types.of(material);
  for (const LabelType& type : scene.label_types) out << '\n' << types.of(type);
  for (const TransceiverType& type : scene.transceiver_types) out << '\n' << types.of(type);
  out << "\nmesh ";
  for (const Vec3& vertex : scene.mesh.vertices) point(vertex);
  for (const auto& [a, b, c] : scene.mesh.triangles) out << a << ' ' << b << ' ' << c << ' ';
  for (const MaterialId material : scene.mesh.materials) out << material.value << ' ';
  for (const FixtureOutline& fixture : scene.fixtures) {
    out << "\nfixture " << fixture.id << ' ' << fixture.type << ' ';
    polygon(fixture.footprint), bits(fixture.height), bits(fixture.rotation_deg);
  }
  for (const Part& part : scene.parts) {
    out << "\npart " << static_cast<int>(part.kind) << ' ' << part.fixture << ' ' << part.material.value
        << ' ';
    polygon(part.footprint), bits(part.bottom), bits(part.top);
  }
  for (const Label& label : scene.labels) {
    out << "\nlabel " << label.id << ' ' << label.type.value << ' ';
    point(label.position), point(label.normal);
  }
  for (const Transceiver& unit : scene.transceivers) {
    out << "\ntransceiver " << unit.id << ' ' << unit.type.value << ' ' << unit.installed << ' ';
    point(unit.position), point(unit.axis), bits(unit.roll_deg);
  }
  // Warnings name positions in the file, which differ if generated items are listed.
  out << "\nwarnings " << std::dec << scene.warnings.size();
  return out.str();
}

}  // namespace shelfbeam::test
