#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "app/options/arguments.hpp"
#include "app/options/usage.hpp"
#include "app/text/flags.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::app;

// Otherwise an output file would take the number of a closed stream, and messages would overwrite it. These
// replacements fail when they are used, as the closed streams would.
void occupy_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// Prints one line of limited length, regardless of the contents of names and paths.
void print_line(std::string_view kind, std::string_view text) {
  const Style style = kind == "stopped" ? Style::warning : Style::error;
  print_message("{} {}\n", styled(style, fmt::format("{}:", kind), stderr), one_line(text));
}

// Names the program and adds every verb. Parsing fills `chosen`, which must outlive `app`.
void define_command_line(CLI::App& app, ChosenVerb& chosen) {
  app.description(
      "Plans where to mount infrared transceivers so that every electronic shelf label\nhears them.");
  app.name("shelfbeam");
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", std::string(program_version()), "Print the version");
  app.require_subcommand(1);
  app.footer(
      "Start with 'shelfbeam new grocery my-store'. 'shelfbeam VERB --help' shows the\n"
      "options of a verb, and examples.\n\n"
      "Exit codes: 0 success; 1 no feasible placement, or labels missed; 2 invalid\n"
      "input; 3 stopped by a limit or by the user (results so far are saved);\n"
      "4 internal error; 5 out of memory.");
  add_new(app, chosen);
  add_inspect(app, chosen);
  add_simulate(app, chosen);
  add_merge(app, chosen);
  add_place(app, chosen);
  add_plan(app, chosen);
  add_batch(app, chosen);
  add_preview(app, chosen);
  add_verify(app, chosen);
  add_report(app, chosen);
  add_compare(app, chosen);
  add_diff(app, chosen);
  add_export(app, chosen);
  add_serve(app, chosen);
  for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) verb->group("Verbs");
  add_job(app, chosen);
  add_light(app, chosen);
  add_archive(app, chosen);
  for (const char* hidden : {"job", "light", "archive"}) app.get_subcommand(hidden)->group("");
}

// The exit code of a program that has printed all that it has to print.
int ended(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  print_line("error", fmt::format("standard output: cannot be written ({}); check the disk or the program "
                                  "that reads it",
                                  system_reason()));
  return wrong_input;
}

// Names the verb and its first argument, the input.
void report_lack_of_memory(const CLI::App& app) {
  const CLI::App* verb = app.get_subcommands().front();
  const auto arguments =
      verb->get_options([](const CLI::Option* option) { return option->get_positional(); });
  const std::string input =
      arguments.empty() || arguments.front()->empty() ? "" : arguments.front()->results().front();
  print_line("error", jobs::lack_of_memory(input, verb->get_name()));
}

int run(const CLI::App& app, const ChosenVerb& verb) {
  try {
    return ended(verb());
  } catch (const InputError& error) {
    print_line("error", with_flag(error.what(), error.setting()));
    return jobs::exit_code_of(error);
  } catch (const Interrupted& stop) {
    print_line("stopped", with_flag(stop.what(), stop.setting()));
    return stopped_early;
  } catch (const std::exception& error) {
    if (jobs::exit_code_of(error) == out_of_memory) {
      report_lack_of_memory(app);
      return out_of_memory;
    }
    if (std::ferror(stdout) != 0) return ended(wrong_input);
    print_line("internal error", error.what());
    return internal_error;
  }
}

// Memory for the way from a failed allocation to its message: destructors may allocate, too.
void* memory_reserve = nullptr;

void reserve_memory() {
  constexpr std::size_t reserve = 8 << 20;
  memory_reserve = std::malloc(reserve);
  std::set_new_handler([] {
    std::free(memory_reserve);
    memory_reserve = nullptr;
    throw std::bad_alloc();
  });
}

}  // namespace

int main(int argc, char** argv) {
  occupy_standard_streams();
  reserve_memory();
  // Writing beyond a file size limit then fails, which is reported like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app;
  ChosenVerb chosen;
  define_command_line(app, chosen);
  try {
    parse_command_line(app, argc, argv);
  } catch (const CLI::Success& help) {
    return ended(app.exit(help));
  } catch (const WrongUsage& error) {
    print_line("error", error.what());
    return wrong_input;
  }
  return run(app, chosen);
}
