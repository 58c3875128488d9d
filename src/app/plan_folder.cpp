#include "plan_folder.hpp"

#include "shelfbeam/base/file.hpp"

namespace shelfbeam::app {

void write_report(const std::filesystem::path& folder, const ReportInput& input) {
  write_file(folder / "labels.csv", labels_csv(input));
  write_file(folder / "placement.csv", placement_csv(input));
  write_file(folder / report_name, report_html(input));
}

}  // namespace shelfbeam::app
