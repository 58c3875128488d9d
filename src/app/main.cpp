#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/command_line.hpp"

namespace {

using namespace shelfbeam;
using namespace shelfbeam::app;

// One line, whatever names and paths hold.
void print_line(std::string_view kind, std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      line += c == '\n' ? "\\n" : fmt::format("\\x{:02x}", c);
    else
      line += c;
  }
  fmt::print(stderr, "{}: {}\n", kind, line);
}

int run(const ChosenVerb& verb) {
  try {
    const int code = verb();
    if (std::fflush(stdout) != 0) throw InputError("standard output", "cannot be written", "check the disk");
    return code;
  } catch (const InputError& error) {
    print_line("error", error.what());
    return wrong_input;
  } catch (const Interrupted& stop) {
    print_line("stopped", stop.what());
    return stopped_early;
  } catch (const std::bad_alloc&) {
    print_line("internal error", "not enough memory");
    return internal_error;
  } catch (const std::exception& error) {
    print_line("internal error", error.what());
    return internal_error;
  }
}

int wrong_usage(const CLI::App& app, const CLI::ParseError& error) {
  const auto chosen = app.get_subcommands();
  const auto extra = app.remaining();
  std::string problem = error.what();
  if (chosen.empty() && !extra.empty() && !extra.front().starts_with('-')) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(verb->get_name());
    problem = fmt::format("there is no verb '{}'; {}", extra.front(),
                          suggest(extra.front(), std::vector<std::string_view>(names.begin(), names.end())));
  }
  const std::string verb = chosen.empty() ? "" : " " + chosen.front()->get_name();
  print_line("error", fmt::format("{}; see 'shelfbeam{} --help'", problem, verb));
  return wrong_input;
}

}  // namespace

int main(int argc, char** argv) {
  // Beyond a limit of file sizes writing fails, which is told like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app;
  ChosenVerb chosen;
  define_command_line(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return wrong_usage(app, error);
  }
  return run(chosen);
}
