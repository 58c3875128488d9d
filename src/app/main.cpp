#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "verbs.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::app;

int run(const ChosenVerb& verb) {
  try {
    return verb();
  } catch (const InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return wrong_input;
  } catch (const Interrupted& stop) {
    fmt::print(stderr, "stopped: {}\n", stop.what());
    return stopped_early;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return internal_error;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plans where to mount infrared transceivers so that every electronic shelf label hears them.");
  app.name("shelfbeam");
  app.set_version_flag("--version", std::string(program_version()));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done; 1 the answer is no (infeasible); 2 wrong input; 3 stopped by a limit, the result\n"
      "so far is saved; 4 internal error. 'shelfbeam VERB --help' shows examples.");
  ChosenVerb chosen;
  add_new(app, chosen);
  add_inspect(app, chosen);
  add_simulate(app, chosen);
  add_place(app, chosen);
  add_plan(app, chosen);
  add_report(app, chosen);
  add_export(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return wrong_input;
  }
  return run(chosen);
}
