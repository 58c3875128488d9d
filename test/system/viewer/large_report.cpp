// large_report STORE FOLDER: writes the report of a large store whose signals are computed from distance and
// angle, because a simulation would take hours here. Prints the numbers that the page must show, as JSON.

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/report.hpp"

#include "unit/report/sample_store.hpp"

namespace {

using namespace shelfbeam;

constexpr std::size_t kept_candidates = 4;  // one of this number
constexpr double farthest = 32;             // m

SignalMatrix made_up(const Scene& scene) {
  SignalMatrix matrix = sample_store::rows_and_columns_of(scene);
  std::uint32_t at = 0;
  for (const Label& label : scene.labels)
    for (const Transceiver& t : scene.transceivers) {
      const Vec3 way = t.position - label.position;
      const double r = std::sqrt(length_squared(way)), noise = to_uniform(philox({at++, 0, 0, 0}, 3)[0]);
      const double direct = std::max(0.0, dot(way, label.normal) / r) * way.z / r / (r * r);
      const double reflected = r > farthest ? 0 : 0.03 * std::exp(-r / 4) * (0.7 + 0.6 * noise);
      const double mean = r > farthest ? 0 : direct + reflected;
      matrix.mean.push_back(static_cast<float>(mean));
      matrix.direct.push_back(static_cast<float>(mean > 0 ? direct : 0));
      matrix.standard_error.push_back(static_cast<float>(0.03 * mean * (0.5 + noise)));
    }
  return matrix;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  Scene scene = make_scene(read_store(arguments[1]));
  std::vector<Transceiver> candidates;
  for (std::size_t j = 0; j < scene.transceivers.size(); j += kept_candidates)
    candidates.push_back(scene.transceivers[j]);
  scene.transceivers = candidates;
  const SignalMatrix matrix = made_up(scene);
  CertifiedPlan plan;
  Placement& placement = plan.placement;
  placement.status = Status::feasible;
  for (std::uint32_t j = 3; j < matrix.columns(); j += 8) placement.selected.push_back(j);
  placement.objective_value = placement.count_lower_bound = static_cast<double>(placement.count());
  const ReportInput input{scene, matrix, plan};
  const std::filesystem::path folder = arguments[2];
  const std::string html = report_html(input);
  write_file(folder / "report.html", html);
  write_file(folder / "labels.csv", labels_csv(input));
  write_file(folder / "placement.csv", placement_csv(input));
  write_file(folder / "mounting.csv", mounting_csv(input));
  fmt::print("{{\"labels\":{},\"candidates\":{},\"units\":{},\"reached\":{},\"bytes\":{}}}\n", matrix.rows(),
             matrix.columns(), placement.count(), outcome_of(matrix, placement).met, html.size());
}
