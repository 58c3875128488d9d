#pragma once

#include <array>
#include <map>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam::test {

/// A small store for comparing strategies: two gondolas with labels on all sides, and four units of two
/// types.
class StrategyStore {
 public:
  Scene scene() const {
    Scene scene = make_scene(parse_store(text(), "strategies", "."));
    for (NamedMaterial& named : scene.materials)
      if (const auto found = materials_.find(named.name); found != materials_.end())
        named.material = found->second;
    for (TransceiverType& type : scene.transceiver_types) type.radius = radius;
    for (LabelType& type : scene.label_types) type.size = label_size;
    return scene;
  }

  /// Assigns another model to a material of the store.
  void set(const std::string& name, const Material& material) { materials_[name] = material; }

  /// Plastic packs, brushed steel, painted walls.
  void add_glossy() {
    set("floor", make_plastic(1.5, 0.4, make_microfacets(FacetDistribution::beckmann, 0.25, 0.25)));
    set("steel", make_conductor(2.6, 4.5, make_microfacets(FacetDistribution::ggx, 0.3, 0.5)));
    set("pack", make_plastic(1.5, 0.5, make_microfacets(FacetDistribution::ggx, 0.4, 0.4)));
  }

  /// A mirror on the wall, a pane in front of a shelf, a block of glass.
  void add_glass() {
    fixtures_ = R"(,
      {"type": "box", "id": "mirror", "min": [5.96, 1.2, 0.6], "max": [5.99, 3.8, 2.2], "material": "mirror"},
      {"type": "mesh", "id": "pane", "at": [1, 2.3, 0], "parts": [{"name": "p", "material": "pane",
        "vertices": [[0, 0, 0.1], [3, 0, 0.1], [3, 0, 1.7], [0, 0, 1.7]], "faces": [[0, 1, 2], [0, 2, 3]]}]},
      {"type": "box", "id": "block", "min": [2.2, 2.45, 1.0], "max": [2.9, 2.95, 1.9], "material": "glass"})";
    set("mirror", make_conductor(0.2, 6));
    set("pane", make_thin_dielectric(1.5, 0.006, 2));
    set("glass", make_dielectric(1.5));
  }

  double radius = 0;
  std::array<double, 2> label_size{0, 0};

 private:
  std::string text() const {
    std::string gondolas;
    for (const double y : {1.1, 3.3})
      gondolas += fmt::format(
          R"({}{{"type": "gondola", "id": "A{}", "at": [1, {}], "length": 3, "depth": 0.8, "height": 1.6,
            "material": "steel", "goods": "pack", "shelves": [0.5, 1.1], "stocking": 0.7,
            "labels": {{"type": "standard", "spacing": 1.2}}}})",
          gondolas.empty() ? "" : ",", gondolas.empty() ? 1 : 2, y);
    return fmt::format(R"({{
      "room": {{"size": [6, 5, 3], "floor": "floor", "ceiling": "paint", "walls": "paint"}},
      "materials": {{"paint": {{"type": "lambertian", "reflectance": 0.7}},
        "floor": {{"type": "lambertian", "reflectance": 0.4}}, "steel": {{"type": "lambertian", "reflectance": 0.6}},
        "pack": {{"type": "lambertian", "reflectance": 0.5}}, "mirror": {{"type": "lambertian", "reflectance": 0}},
        "pane": {{"type": "lambertian", "reflectance": 0}}, "glass": {{"type": "lambertian", "reflectance": 0}}}},
      "label_types": {{"standard": {{"threshold": 0.02}}}},
      "transceiver_types": {{"wide": {{"emission": {{"type": "sin2theta", "peak": 1}}}},
                            "narrow": {{"emission": {{"type": "lambertian", "order": 2, "flux": 3}}}}}},
      "fixtures": [{}{}],
      "labels": [{{"id": "floor", "position": [5, 2.5, 0.02], "normal": [0, 0, 1], "type": "standard"}},
                 {{"id": "wall", "position": [0.02, 2.6, 1.2], "normal": [1, 0, 0], "type": "standard"}},
                 {{"id": "tilted", "position": [4.6, 4.4, 1.1], "normal": [-0.6, 0, 0.8], "type": "standard"}},
                 {{"id": "looks at the mirror", "position": [4.4, 2.0, 1.2], "normal": [1, 0, 0], "type": "standard"}}],
      "transceivers": {{"list": [{{"id": "T1", "position": [1.2, 0.8, 2.9], "type": "wide"}},
        {{"id": "T2", "position": [4.4, 1.4, 2.9], "type": "narrow"}},
        {{"id": "T3", "position": [2.5, 2.6, 2.9], "type": "wide", "axis": [0.3, 0, -1]}},
        {{"id": "T4", "position": [4.9, 4.2, 2.9], "type": "wide"}}]}}
    }})",
                       gondolas, fixtures_);
  }

  std::string fixtures_;
  std::map<std::string, Material> materials_;
};

}  // namespace shelfbeam::test
