#include "shelfbeam/plan/io/scene_table.hpp"

namespace shelfbeam {

SignalTable table_without_signals(const Scene& scene) {
  SignalTable table;
  for (const Label& label : scene.labels) {
    const double requirement = scene.requirement_of(label);
    table.labels.push_back({label.id, requirement, requirement, 0, 0});
  }
  for (const Transceiver& unit : scene.excluded) table.excluded.push_back(unit.id);
  for (const Transceiver& unit : scene.transceivers)
    table.transceivers.push_back(
        {unit.id, scene.type_of(unit).cost, unit.installed || unit.pinned, unit.position, unit.pinned});
  table.row_begin.assign(table.labels.size() + 1, 0);
  return table;
}

}  // namespace shelfbeam
