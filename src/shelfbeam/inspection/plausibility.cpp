#include "shelfbeam/inspection/plausibility.hpp"

#include <string>
#include <utility>

#include "shelfbeam/inspection/checks.hpp"

namespace shelfbeam {

Scene make_inspected_scene(const Store& store) {
  DeviceSources sources;
  Scene scene = make_scene(store, &sources);
  const Inspected inspected(store, scene, sources);
  WarningList warnings(store.file, store.ignored);
  warn_of_unusual_values(inspected, warnings);
  warn_of_types(inspected, warnings);
  warn_of_room(inspected, warnings);
  warn_of_fixtures(inspected, warnings);
  warn_of_labels(inspected, warnings);
  warn_of_units(inspected, warnings);
  warn_of_separated(inspected, warnings);
  for (Finding& warning : warnings.findings()) scene.warnings.push_back(std::move(warning));
  scene.ignored_warnings += warnings.ignored();
  return scene;
}

}  // namespace shelfbeam
