#include <cstddef>
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
#include <fmt/ranges.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/store/store.hpp"

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
  std::vector<fs::path> catalogues;
  bool no_browser = false, no_light = false, demo = false;
};

// The folder that a user means, perhaps by the store.json in it.
fs::path project_folder(const fs::path& given) {
  std::error_code error;
  if (given.empty() || fs::is_directory(given, error)) return given.empty() ? "." : given;
  const bool exists = fs::exists(fs::symlink_status(given, error));
  if (exists && given.filename() == "store.json") return project_folder(given.parent_path());
  if (exists || lower_case(given.extension().string()) == ".json")
    throw InputError(given.string(), exists ? "is not a folder" : "does not exist",
                     "name a folder with a store.json, or a new folder");
  return given;
}

// The folder of the project; of a demo without a folder a temporary one, which is removed at the end.
class ProjectFolder {
 public:
  explicit ProjectFolder(const ServeArguments& options)
      : path_(project_folder(options.folder)), is_demo_(options.demo), is_named_(!options.folder.empty()) {}
  ~ProjectFolder() {
    std::error_code ignored;
    if (is_temporary()) fs::remove_all(temporary_, ignored);
  }
  ProjectFolder(const ProjectFolder&) = delete;
  ProjectFolder& operator=(const ProjectFolder&) = delete;

  void make() {
    if (is_demo_ && !is_named_) {
      std::string pattern = (fs::temp_directory_path() / "shelfbeam-demo-XXXXXX").string();
      if (::mkdtemp(pattern.data()) == nullptr) cannot_write(pattern, system_reason());
      temporary_ = pattern;
      path_ = temporary_ / "grocery-demo";
    }
    if (is_demo_) write_template("grocery", path_);
    make_output_folder(path_);
  }

  const fs::path& path() const { return path_; }
  bool is_temporary() const { return !temporary_.empty(); }

 private:
  fs::path path_, temporary_;
  bool is_demo_, is_named_;
};

void print_addresses(const serve::Planner& planner, const ServeArguments& options, bool is_temporary) {
  const std::vector<std::string> addresses = planner.addresses();
  if (options.common.json) {
    print_json({{"address", addresses.front()}, {"addresses", addresses}});
  } else if (options.common.quiet) {
    fmt::print("{}\n", fmt::join(addresses, "\n"));
  } else {
    fmt::print("Planner of {}: {}\n", fs::current_path().string(), addresses.front());
    for (std::size_t k = 1; k < addresses.size(); ++k) fmt::print("From other computers: {}\n", addresses[k]);
    fmt::print("Ctrl-C ends it; {}.\n", is_temporary
                                            ? "this temporary copy is then removed (name a FOLDER to keep it)"
                                            : "everything is saved");
  }
  std::fflush(stdout);
}

int run_serve(const ServeArguments& options) {
  if (!serve::has_page())
    throw InputError("serve",
                     "this build of shelfbeam has no page: it was made with SHELFBEAM_VIEWER=OFF, or without "
                     "Node.js or its packages",
                     "install nodejs and npm, and build it with SHELFBEAM_VIEWER=ON");
  const CancelToken& cancel = cancel_on_signal();  // before anybody knows the address
  const ThreadLimit allowed(0);
  ProjectFolder folder(options);
  serve::http::Options http;
  http.address = options.address;
  http.port = options.port;
  http.hosts = options.hosts;
  std::vector<fs::path> catalogues;
  for (const fs::path& catalogue : options.catalogues) {
    expect_catalogue(JsonCursor::parse_file(catalogue));  // before a folder is made
    catalogues.push_back(fs::absolute(catalogue));
  }
  const auto make_folder = [&]() -> fs::path {
    folder.make();
    // Names of files in messages are then relative to the folder, which other programs may rename.
    fs::current_path(folder.path());
    return ".";
  };
  serve::Planner planner(
      make_folder, std::move(http), cancel,
      [](std::string_view what) { print_message("internal error: {}\n", one_line(what)); }, !options.no_light,
      catalogues);
  if (!options.address.starts_with("127.") && options.address != "::1")
    print_message(
        "Other computers can reach this planner at {}; by a name only with --allow-host NAME. Anyone with "
        "its "
        "address can read and change the shop. Address and data are not encrypted.\n",
        options.address);
  print_addresses(planner, options, folder.is_temporary());
  if (!options.no_browser) open_browser(planner.addresses().front(), ".shelfbeam");
  planner.run();
  return done;
}

}  // namespace

void add_serve(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("serve", "Correct a shop in the browser");
  auto options = std::make_shared<ServeArguments>();
  const OptionGroup first(*verb);
  first.add("FOLDER", options->folder, a_path(),
            "Folder of the project, which contains store.json; an empty or a new folder gets an empty shop. "
            "Default: this folder");
  first.add_flag(
      "--demo", options->demo,
      "Work on a copy of the example grocery, which is removed at the end unless a FOLDER is given");
  first
      .add("--catalogue", options->catalogues, a_path("FILE"),
           "Catalogue with products of a vendor, which is copied into the project and remembered there")
      ->allow_extra_args(false);
  first.add_flag("--no-light", options->no_light,
                 "Compute no signals while the shop is drawn, for slow computers");
  const OptionGroup network(*verb, "Network");
  network.add("--port", options->port, whole_number("N", 1, 65535), "Port; default: any free one");
  network.add_flag("--no-browser", options->no_browser, "Only print the address");
  network.add("--listen", options->address, a_path("ADDRESS"),
              "Listen on this address, or with 0.0.0.0 on all, which other computers may reach; default "
              "127.0.0.1");
  // Or the parser takes the brackets of "[::1]" for those of a list.
  network
      .add("--allow-host", options->hosts, a_path("NAME"),
           "Accept requests to this name of the computer, too")
      ->allow_extra_args(false);
  finish_verb(*verb, chosen, options, run_serve,
              "Examples:\n"
              "  shelfbeam serve --demo\n"
              "  shelfbeam serve my-shop\n"
              "  shelfbeam serve my-shop --catalogue vendor.json\n"
              "  shelfbeam serve my-shop --no-browser --port 8080");
  // It has one thread and no random numbers. The address is what it is for.
  verb->remove_option(verb->get_option("--seed"));
  verb->remove_option(verb->get_option("--threads"));
  verb->get_option("--quiet")->description("Print the addresses only");
  verb->get_option("--json")->description("Print the addresses as JSON");
}

}  // namespace shelfbeam::app
