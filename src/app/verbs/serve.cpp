#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "app/options/arguments.hpp"
#include "app/text/browser.hpp"
#include "app/text/templates.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "serve/planner.hpp"

namespace shelfbeam::app {

namespace {

namespace fs = std::filesystem;

struct ServeArguments {
  CommonOptions common;
  fs::path folder;
  std::uint16_t port = 0;
  std::string address = "127.0.0.1";
  std::vector<std::string> hosts;
  bool no_browser = false, demo = false;
};

// The folder of the project; of a demo without a folder a temporary one, which is removed at the end.
class ProjectFolder {
 public:
  explicit ProjectFolder(const ServeArguments& options) : path_(options.folder) {
    if (options.demo && path_.empty()) {
      std::string pattern = (fs::temp_directory_path() / "shelfbeam-demo-XXXXXX").string();
      if (::mkdtemp(pattern.data()) == nullptr) cannot_write(pattern, system_reason());
      path_ = temporary_ = pattern;
    }
    if (path_.empty()) path_ = ".";
    if (options.demo) write_template("grocery", path_);
  }
  ~ProjectFolder() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
  }
  ProjectFolder(const ProjectFolder&) = delete;
  ProjectFolder& operator=(const ProjectFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_, temporary_;
};

int run_serve(const ServeArguments& options) {
  if (!serve::has_page())
    throw InputError("serve",
                     "this build of shelfbeam has no page, because Node.js or its packages were missing",
                     "install nodejs and npm, and build again");
  const CancelToken& cancel = cancel_on_signal();  // before anybody knows the address
  const ProjectFolder folder(options);
  serve::http::Options http;
  http.address = options.address;
  http.port = options.port;
  http.hosts = options.hosts;
  // Names of files in messages are then relative to the folder, which other programs may rename.
  make_output_folder(folder.path());
  fs::current_path(folder.path());
  serve::Planner planner(".", std::move(http), [](std::string_view what) {
    print_message("internal error: {}\n", one_line(what));
  });
  if (options.address != "127.0.0.1")
    print_message(
        "Other computers can reach this planner at {}. Whoever knows the address below can read and change "
        "the "
        "shop; address and data travel unencrypted.\n",
        options.address);
  if (options.common.json)
    print_json({{"address", planner.address()}});
  else if (!options.common.quiet)
    fmt::print("Planner of {}: {}\nCtrl-C ends it; everything is saved.\n", fs::current_path().string(),
               planner.address());
  std::fflush(stdout);
  if (!options.no_browser) open_browser(planner.address(), ".shelfbeam");
  planner.run(cancel);
  return done;
}

}  // namespace

void add_serve(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("serve", "Draw and correct a shop in the browser");
  auto options = std::make_shared<ServeArguments>();
  const OptionGroup first(*verb);
  first.add("FOLDER", options->folder, a_path(),
            "Folder of the project, which contains store.json; an empty or a new folder gets an empty shop. "
            "Default: this folder");
  first.add_flag("--demo", options->demo, "Work on a copy of the example grocery");
  const OptionGroup network(*verb, "Network");
  network.add("--port", options->port, whole_number("N", 1, 65535), "Port; default: any free one");
  network.add_flag("--no-browser", options->no_browser, "Only print the address");
  network.add("--listen", options->address, a_path("ADDRESS"),
              "Listen on this address, which other computers may reach; default 127.0.0.1");
  network.add("--allow-host", options->hosts, a_path("NAME"),
              "Accept requests to this name of the computer, too");
  finish_verb(*verb, chosen, options, run_serve,
              "Examples:\n"
              "  shelfbeam serve --demo\n"
              "  shelfbeam serve my-shop\n"
              "  shelfbeam serve my-shop --no-browser --port 8080");
}

}  // namespace shelfbeam::app
