#include "shelfbeam/transport/operator/light_operator.hpp"

#include <cmath>
#include <optional>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "reader.hpp"
#include "records.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

constexpr OperatorEffort little{.label_rays = 4, .gather_rays = 2};

// A room of 1 m with a mirror, two labels and a unit.
const World& small_shop() {
  static const Scene scene = make_scene(parse_store(R"({
    "room": {"size": [1, 1, 1], "floor": "paper", "ceiling": "paper", "walls": "coat"},
    "materials": {"paper": {"type": "lambertian", "reflectance": 0.6},
                  "coat": {"type": "plastic", "ior": 1.5, "reflectance": 0.5, "roughness": 0.3}},
    "label_types": {"l": {"threshold": 0.02}},
    "transceiver_types": {"t": {"emission": {"type": "isotropic", "intensity": 1}}},
    "labels": [{"id": "A", "position": [0.3, 0.3, 0.5], "normal": [1, 0, 0], "type": "l"},
               {"id": "B", "position": [0.7, 0.3, 0.5], "normal": [0, 1, 0], "type": "l"}],
    "transceivers": {"list": [{"id": "T", "position": [0.5, 0.5, 0.9], "type": "t"}]}})",
                                                    "store.json", "."));
  static const World world(scene);
  return world;
}

// An operator that is accepted must serve any unit.
void fuzz_light_operator(std::string_view bytes) {
  const auto path = scratch().write("light.operator", bytes);
  const std::optional<LightOperator> light = LightOperator::load(path, small_shop(), 1, little);
  if (light) static_cast<void>(light->column(small_shop().scene.transceivers[0]));
}

std::vector<std::string> light_operator_seeds() {
  const auto path = scratch().path() / "seed.operator";
  LightOperator(small_shop(), 1, little).save(path);
  return {read_file(path)};
}

}  // namespace

extern const Reader light_operator;
const Reader light_operator{"light_operator", fuzz_light_operator, light_operator_seeds, repair_records};

}  // namespace shelfbeam::fuzz
