#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/states/plan_states.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam::test {

/// A shop with known availabilities: three aisles between black walls, one label in the middle of each, a
/// unit at each end, and a pallet in each half that blocks the light of its unit while it stands there. One
/// free unit reaches the label.
class KnownStates {
 public:
  /// The shares of the time in which the pallets stand, left and right of each label.
  using Pallets = std::array<std::array<double, 2>, 3>;

  /// `more`: further keys of the section "variation", each with a comma behind.
  explicit KnownStates(const Pallets& pallets, const std::string& more = "") : pallets_(pallets) {
    std::string objects, units, labels, walls;
    for (std::size_t k = 0; k < pallets.size(); ++k) {
      const double y = 2 + 4 * static_cast<double>(k);
      labels +=
          fmt::format(R"({}{{"id": "L{}", "type": "l", "position": [6, {}, 0.5], "normal": [0, 0, 1]}})",
                      k > 0 ? "," : "", k, y);
      if (k > 0)
        walls += fmt::format(R"({}{{"id": "W{}", "from": [0, {}], "to": [12, {}], "thickness": 0.1,
          "height": "ceiling", "material": "black"}})",
                             k > 1 ? "," : "", k, y - 2, y - 2);
      for (const int right : {0, 1}) {
        units +=
            fmt::format(R"({}{{"id": "U{}{}", "type": "t", "position": [{}, {}, 2.9], "axis": [0, 0, -1]}})",
                        units.empty() ? "" : ",", k, right, right == 0 ? 1 : 11, y);
        const double x = right == 0 ? 3 : 9;
        objects += fmt::format(R"({}{{"id": "P{}{}", "present": {}, "size": [1, 1, 2.4], "material": "black",
          "area": [[{}, {}], [{}, {}], [{}, {}], [{}, {}]]}})",
                               objects.empty() ? "" : ",", k, right, pallets[k][right], x - 0.02, y - 0.02,
                               x + 0.02, y - 0.02, x + 0.02, y + 0.02, x - 0.02, y + 0.02);
      }
    }
    text_ = fmt::format(R"({{
      "room": {{"size": [12, 12, 3], "floor": "black", "ceiling": "black", "walls": "black", "inner_walls": [{}]}},
      "materials": {{"black": {{"type": "lambertian", "reflectance": 0}}}},
      "label_types": {{"l": {{"threshold": 0.004, "availability": 0.95}}}},
      "transceiver_types": {{"t": {{"emission": {{"type": "lambertian", "flux": 3}}}}}},
      "labels": [{}], "transceivers": {{"list": [{}]}}, "variation": {{{} "objects": [{}]}}}})",
                        walls, labels, units, more, objects);
    store_ = parse_store(text_, "known.json", ".");
  }

  const std::string& text() const { return text_; }
  const Store& store() const { return store_; }

  /// The availability of the label in an aisle, from the columns that are chosen.
  double availability(std::size_t aisle, const Selection& selected) const {
    double blocked = 1;
    for (const std::uint32_t j : selected)
      if (j / 2 == aisle) blocked *= pallets_[aisle][j % 2];
    return 1 - blocked;
  }
  bool keeps_to(double required, const Selection& selected) const {
    for (std::size_t k = 0; k < pallets_.size(); ++k)
      if (availability(k, selected) < required) return false;
    return true;
  }
  /// The fewest units that keep every label at 95 %.
  std::size_t fewest() const {
    std::size_t best = 6;
    for (std::uint32_t set = 0; set < 64; ++set) {
      Selection selected;
      for (std::uint32_t j = 0; j < 6; ++j)
        if ((set >> j & 1U) != 0) selected.push_back(j);
      if (keeps_to(0.95, selected)) best = std::min(best, selected.size());
    }
    return best;
  }

  static SimulationOptions simulation(std::uint64_t seed) {
    SimulationOptions simulation;
    simulation.samples = 200;
    simulation.direct = DirectLight::exact;
    simulation.seed = seed;
    return simulation;
  }

  PlanOverStates plan(std::uint64_t seed, StatesOptions options = {}, const RunControl& control = {}) const {
    ResultLog log({}, {}, false, 0);
    return plan(seed, log, std::move(options), control);
  }
  PlanOverStates plan(std::uint64_t seed, ResultLog& log, StatesOptions options = {},
                      const RunControl& control = {}) const {
    const SimulationOptions simulation = KnownStates::simulation(seed);
    const Scene scene = make_scene(store_);
    const SignalTable table = make_signal_table(simulate(scene, simulation).matrix);
    options.simulation = simulation;
    return plan_over_states(store_, scene, table, place(table, {}, {}), options, log, control);
  }

 private:
  Pallets pallets_;
  std::string text_;
  Store store_;
};

}  // namespace shelfbeam::test
