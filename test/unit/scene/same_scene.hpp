#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::test {

/// All values of a scene on which results depend, and those that drawings show, as text; doubles as their
/// bits.
inline std::string fingerprint(Scene scene) {
  scene.store_hash.clear();  // so that scene_hash is that of the values
  std::string text = scene.name + " " + scene_hash(scene);
  const auto bits = [&](double x) { text += fmt::format(" {:x}", std::bit_cast<std::uint64_t>(x)); };
  const auto point = [&](const Vec3& p) { bits(p.x), bits(p.y), bits(p.z); };
  const auto polygon = [&](const Polygon& corners) {
    for (const auto& [x, y] : corners) bits(x), bits(y);
  };
  point(scene.lower), point(scene.upper), point(scene.room ? scene.room->upper() : Vec3{});
  for (const FixtureOutline& fixture : scene.fixtures) {
    text += fmt::format("\nfixture {} {}", fixture.id, fixture.type);
    polygon(fixture.footprint), bits(fixture.height), bits(fixture.rotation_deg);
  }
  for (const Part& part : scene.parts) {
    text += fmt::format("\npart {} {} {}", static_cast<int>(part.kind), part.fixture, part.material.value);
    polygon(part.footprint), bits(part.bottom), bits(part.top);
  }
  // Warnings name positions in the file, which differ if generated items are listed.
  return fmt::format("{}\nwarnings {}", text, scene.warnings.size());
}

/// Expects that the resolved store, read in a folder without any other file, is the same scene and the same
/// text. Returns its text.
inline std::string expect_same_scene(const Store& store) {
  const Scene scene = make_scene(store);
  std::string resolved = resolved_store_json(store, scene);
  const Store again = parse_store(resolved, store.file, "/nowhere");
  const Scene copy = make_scene(again);
  EXPECT_EQ(fingerprint(copy), fingerprint(scene));
  EXPECT_EQ(copy.store_hash, scene.store_hash);
  EXPECT_EQ(resolved_store_json(again, copy), resolved);
  return resolved;
}

}  // namespace shelfbeam::test
