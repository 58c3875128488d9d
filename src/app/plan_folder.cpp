#include "plan_folder.hpp"

#include "shelfbeam/base/file.hpp"

#include "arguments.hpp"

namespace shelfbeam::app {

void prepare_plan_folder(const std::filesystem::path& folder) {
  make_output_folder(folder);
  for (const char* name : {signal_name, placement_name, store_name, labels_name, placement_table_name,
                           verification_name, report_name})
    expect_writable(folder / name);
}

void write_report(const std::filesystem::path& folder, const ReportInput& input) {
  write_file(folder / labels_name, labels_csv(input));
  write_file(folder / placement_table_name, placement_csv(input));
  write_file(folder / report_name, report_html(input));
}

}  // namespace shelfbeam::app
