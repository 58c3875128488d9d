#include "shelfbeam/placement/io/placement_file.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"
#include "small_values.hpp"

namespace shelfbeam::fuzz {

namespace {

void read(std::string_view bytes) {
  static const SignalTable table = small_table();
  read_placement(scratch().write("placement.json", bytes), table);
}

std::vector<std::string> seeds() {
  const SignalTable table = small_table();
  Placement placement;
  placement.selected = {1, 3};
  placement.unreachable = {{0, 0.02, 0.01}};
  const std::string plain = placement_json(placement, table);
  Certificate certificate;
  certificate.confidence = 0.99;
  certificate.labels.resize(table.rows());
  for (LabelVerdict& label : certificate.labels) label.verdict = Verdict::reached;
  placement.certificate = certificate;
  return {plain, placement_json(placement, table)};
}

}  // namespace

extern const Reader placement_file;
const Reader placement_file{"placement_file", read, seeds};

}  // namespace shelfbeam::fuzz
