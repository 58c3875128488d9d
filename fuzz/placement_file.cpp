#include "shelfbeam/plan/io/plan_file.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"
#include "small_values.hpp"

namespace shelfbeam::fuzz {

namespace {

void fuzz_placement_file(std::string_view bytes) {
  static const SignalTable table = small_table();
  read_plan(scratch().write("placement.json", bytes), table);
}

std::vector<std::string> placement_file_seeds() {
  const SignalTable table = small_table();
  CertifiedPlan plan;
  plan.placement.selected = {1, 3};
  plan.placement.unreachable = {{0, 0.02, 0.01}};
  const std::string plain = plan_json(plan, table);
  Certificate& certificate = plan.certificate.emplace();
  certificate.labels.resize(table.rows());
  for (LabelVerdict& label : certificate.labels) label.verdict = Verdict::reached;
  return {plain, plan_json(plan, table)};
}

}  // namespace

extern const Reader placement_file;
const Reader placement_file{"placement_file", fuzz_placement_file, placement_file_seeds};

}  // namespace shelfbeam::fuzz
