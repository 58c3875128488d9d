#include "placement_instances.hpp"

#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "support.hpp"

namespace shelfbeam::bench {

namespace {

void for_scales(const std::string& name, SignalTable table, const std::vector<double>& scales,
                const std::function<void(const std::string&, const SignalTable&)>& visit) {
  double before = 1;
  for (const double scale : scales) {
    for (SignalTable::Label& label : table.labels) {
      label.requirement *= scale / before;
      label.single_requirement *= scale / before;
    }
    before = scale;
    visit(scale == 1 ? name : fmt::format("{} x {:g}", name, scale), table);
  }
}

}  // namespace

void for_instances(const std::vector<std::string>& files, const std::vector<double>& scales,
                   const std::function<void(const std::string&, const SignalTable&)>& visit) {
  for (const std::string& file : files)
    for_scales(std::filesystem::path(file).stem().string(), read_signal_table(file), scales, visit);
  if (!files.empty()) return;

  const Scene scene = open_scene("thesis");
  const auto simulated = [&](const std::string& name, const SimulationOptions& options) {
    for_scales(name, make_signal_table(simulate(scene, {}, options).matrix), scales, visit);
  };
  for (const std::uint64_t samples : {5000, 10000, 25000, 50000, 100000})
    simulated(fmt::format("uniform {}", samples), {.samples = samples});
  simulated("reuse 10000", {.samples = 10000, .estimator = EstimatorKind::reuse});
}

}  // namespace shelfbeam::bench
