#include "app/files.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "app/options/arguments.hpp"
#include "app/plan_folder.hpp"

namespace shelfbeam::app {

Store load_store(const std::filesystem::path& path, bool allow_outside, std::size_t memory,
                 const std::filesystem::path& output, const CancelToken* cancel, Problems* problems) {
  return read_store(path, {allow_outside, memory == 0 ? memory_limit() : memory, output, cancel}, problems);
}

void protect_store(const std::filesystem::path& folder, const std::filesystem::path& file,
                   const std::string& resolved) {
  std::error_code missing;
  const auto home = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (std::filesystem::equivalent(folder, home, missing) && read_file(file) != resolved)
    throw InputError(folder.string(), "is the folder of the store file; a plan needs a folder of its own",
                     "choose another folder for the plan");
}

void expect_no_warnings(const Scene& scene, bool strict) {
  if (!strict || scene.warnings.empty()) return;
  const std::size_t others = scene.warnings.size() - 1;
  throw InputError(
      "", scene.warnings.front().sentence,
      others == 0 ? "warnings count as errors"
                  : fmt::format("there are {}; warnings count as errors", counted(others, "other warning")),
      Setting::strictness);
}

void add_store_options(CLI::App& verb, bool& allow_outside) {
  verb.add_flag("--allow-outside", allow_outside,
                "Allow the store file to name files (meshes, tables, profiles) outside its folder")
      ->group(group::runs);
}

void add_strict_option(CLI::App& verb, bool& strict) {
  verb.add_flag("--strict", strict, "Treat warnings about the store as errors")->group(group::runs);
}

CLI::Option* add_safe_csv(CLI::App& verb, bool& safe_csv) {
  return verb
      .add_flag("--safe-csv", safe_csv,
                "In CSV files, write an apostrophe before ids and names that a spreadsheet would take for "
                "formulas")
      ->group(group::runs);
}

void expect_room_for_matrix(const std::filesystem::path& folder, const Scene& scene,
                            const SimulationOptions& options, std::size_t others) {
  // Matrix: three floats and a flag per entry, and two floats per layer. Checkpoint: doubles instead.
  const double each = (13 + 24) + (8 + 16) * static_cast<double>(options.layers());
  const double bytes =
      each * static_cast<double>(scene.labels.size()) * static_cast<double>(scene.transceivers.size());
  // A simulation that exceeds the memory is refused for that reason.
  if (bytes < static_cast<double>(options.memory)) expect_room(folder, bytes + static_cast<double>(others));
}

void write_report(AtomicFolder& files, const ReportInput& input) {
  files.add(labels_name).write(labels_csv(input));
  files.add(placement_table_name).write(placement_csv(input));
  files.add(mounting_table_name).write(mounting_csv(input));
  files.add(mounting_drawing_name).write(mounting_dxf(input));
  files.add(report_name).write(report_html(input));
}

}  // namespace shelfbeam::app
