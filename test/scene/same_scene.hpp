#pragma once

#include <bit>
#include <cstdint>
#include <sstream>
#include <string>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::test {

/// Every bit of a scene that a result can depend on, written out; doubles as their bits.
inline std::string fingerprint(const Scene& scene) {
  std::ostringstream out;
  const auto bits = [&](double x) { out << std::hex << std::bit_cast<std::uint64_t>(x) << ' '; };
  const auto point = [&](const Vec3& p) { bits(p.x), bits(p.y), bits(p.z); };
  const auto polygon = [&](const std::vector<std::array<double, 2>>& corners) {
    for (const auto& [x, y] : corners) bits(x), bits(y);
  };
  out << scene.name << '\n';
  bits(scene.wavelength_nm);
  if (scene.room) point(*scene.room);
  point(scene.lower), point(scene.upper);
  for (const auto& [name, material] : scene.materials)
    out << "\nmaterial " << name << ' ', bits(std::get<Lambertian>(material).reflectance);
  for (const LabelType& type : scene.label_types) {
    out << "\nlabel type " << type.name << ' ';
    bits(type.threshold), bits(type.safety_factor), bits(type.link_cost), bits(type.signal_cost);
  }
  for (const TransceiverType& type : scene.transceiver_types) {
    out << "\ntransceiver type " << type.name << ' ' << type.emission.index() << ' ';
    bits(type.cost), bits(power(type.emission));
    if (const auto* table = std::get_if<EmissionTable>(&type.emission))
      for (const auto* list :
           {&table->intensity.theta(), &table->intensity.phi(), &table->intensity.values()})
        for (const double value : *list) bits(value);
  }
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
  for (const std::string& warning : scene.warnings) out << "\nwarning " << warning;
  return out.str();
}

}  // namespace shelfbeam::test
