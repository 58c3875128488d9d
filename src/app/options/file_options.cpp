#include "app/options/file_options.hpp"

#include "app/options/arguments.hpp"

namespace shelfbeam::app {

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

}  // namespace shelfbeam::app
