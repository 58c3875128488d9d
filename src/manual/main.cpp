// shelfbeam_manual FOLDER: writes the manual pages and the completion scripts there, where an installation
// has them below its prefix.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/provenance.hpp"

#include "app/command_line.hpp"
#include "command.hpp"
#include "completion.hpp"
#include "man_page.hpp"

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error(path.string() + " cannot be written");
}

void write_all(const std::filesystem::path& folder) {
  using namespace shelfbeam;
  CLI::App app;
  app::ChosenVerb chosen;
  app::define_command_line(app, chosen);
  const manual::Program program = manual::describe(app, std::string(program_version()));
  const std::string& name = program.self.name;
  write(folder / "man/man1" / (name + ".1"), manual::man_page(program));
  for (const manual::Command& verb : program.verbs)
    write(folder / "man/man1" / (name + "-" + verb.name + ".1"), manual::man_page(program, verb));
  write(folder / "bash-completion/completions" / name, manual::bash_completion(program));
  write(folder / "zsh/vendor-completions" / ("_" + name), manual::zsh_completion(program));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::runtime_error("usage: shelfbeam_manual FOLDER");
    write_all(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  }
}
