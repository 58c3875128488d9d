#include "app/text/plan_folder.hpp"

#include "app/options/arguments.hpp"

namespace shelfbeam::app {

void prepare_plan_folder(const std::filesystem::path& folder) {
  make_output_folder(folder);
  for (const char* name : {signal_name, placement_name, store_name, labels_name, placement_table_name,
                           verification_name, report_name})
    expect_writable(folder / name);
}

void write_report(AtomicFolder& files, const ReportInput& input) {
  files.add(labels_name).write(labels_csv(input));
  files.add(placement_table_name).write(placement_csv(input));
  files.add(report_name).write(report_html(input));
}

}  // namespace shelfbeam::app
