#include "placement_instances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support.hpp"

namespace shelfbeam::bench {

namespace {

// A label that a single unit reached keeps a unit that reaches it, so that no problem becomes infeasible.
void add_noise(SignalTable& table, double noise) {
  constexpr std::uint64_t seed = 1;
  const double s = std::sqrt(std::log1p(noise * noise));
  const auto weaker = [](const SignalEntry& a, const SignalEntry& b) { return a.signal < b.signal; };
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    const std::span row(table.entries.data() + table.row_begin[i],
                        table.row_begin[i + 1] - table.row_begin[i]);
    if (row.empty()) continue;
    const double strongest = std::max_element(row.begin(), row.end(), weaker)->signal;
    for (SignalEntry& entry : row) {
      const auto bits = philox({i, entry.transceiver, 0, 0}, seed);
      const double radius = std::sqrt(-2 * std::log(1 - to_uniform(bits[0])));
      const double z = radius * std::cos(2 * std::numbers::pi * to_uniform(bits[1]));
      entry.signal *= std::exp(s * z - s * s / 2);
    }
    double& kept = std::max_element(row.begin(), row.end(), weaker)->signal;
    kept = std::max(kept, std::min(strongest, table.labels[i].single_requirement));
  }
}

void for_scales(std::string name, SignalTable table, const InstanceChoice& choice,
                const std::function<void(const std::string&, const SignalTable&)>& visit) {
  if (choice.noise > 0) {
    add_noise(table, choice.noise);
    name += fmt::format(" +- {:g} %", 100 * choice.noise);
  }
  double before = 1;
  for (const double scale : choice.scales) {
    for (SignalTable::Label& label : table.labels) {
      label.requirement *= scale / before;
      label.single_requirement *= scale / before;
    }
    before = scale;
    visit(scale == 1 ? name : fmt::format("{} x {:g}", name, scale), table);
  }
}

}  // namespace

void for_instances(const InstanceChoice& choice,
                   const std::function<void(const std::string&, const SignalTable&)>& visit) {
  for (const std::string& file : choice.files)
    for_scales(std::filesystem::path(file).stem().string(), read_signal_table(file), choice, visit);
  if (!choice.files.empty()) return;

  const Scene scene = open_scene("thesis");
  const auto simulated = [&](const std::string& name, const SimulationOptions& options) {
    for_scales(name, make_signal_table(simulate(scene, options).matrix), choice, visit);
  };
  for (const std::uint64_t samples : {5000, 10000, 25000, 50000, 100000})
    simulated(fmt::format("uniform {}", samples), {EstimatorKind::uniform, samples});
  simulated("reuse 10000", {EstimatorKind::reuse, 10000});
}

}  // namespace shelfbeam::bench
