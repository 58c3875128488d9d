#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"

#include "serve/http/options.hpp"

namespace shelfbeam::serve {

/// Whether this build contains the page of the planner.
bool has_page();

/// The planner of one project folder in the browser: serves the page, and applies the edits of all pages to
/// the folder's store.json (docs/formats/planner.md).
class Planner {
 public:
  /// `make_folder` is called when the server has its address, so that nothing is left behind if it cannot
  /// have it, and returns the folder. Creates a shop in an empty one. `cancel` ends it, and must outlive it.
  /// `log` is told of errors of the program while it serves. `has_light`: signals are computed while the shop
  /// is drawn. `catalogues` are added to the project (add_catalogue). Throws InputError, for example if
  /// another planner uses the folder, OutputError, and Interrupted.
  Planner(const std::function<std::filesystem::path()>& make_folder, http::Options options,
          const CancelToken& cancel, std::function<void(std::string_view)> log = {}, bool has_light = true,
          const std::vector<std::filesystem::path>& catalogues = {});
  ~Planner();
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// The addresses of the page, which contain the token (http/server.hpp).
  std::vector<std::string> addresses() const;
  /// Serves until the token is cancelled.
  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace shelfbeam::serve
