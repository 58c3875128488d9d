#include "app/command_line.hpp"

#include <string>

#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::app {

void define_command_line(CLI::App& app, ChosenVerb& chosen) {
  app.description(
      "Plans where to mount infrared transceivers so that every electronic shelf label hears them.");
  app.name("shelfbeam");
  app.set_version_flag("--version", std::string(program_version()));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 the answer is no (infeasible); 2 wrong input; 3 stopped by a limit or by you, "
      "the result\n"
      "so far is saved; 4 internal error. 'shelfbeam VERB --help' shows examples.");
  add_new(app, chosen);
  add_inspect(app, chosen);
  add_simulate(app, chosen);
  add_place(app, chosen);
  add_plan(app, chosen);
  add_verify(app, chosen);
  add_report(app, chosen);
  add_compare(app, chosen);
  add_export(app, chosen);
}

}  // namespace shelfbeam::app
