#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "jobs/child.hpp"
#include "serve/live/errand.hpp"

namespace shelfbeam::serve {

/// Compares measured signals with those of the newest plan in the folder of a project (`shelfbeam compare`),
/// in a process of its own, which alone opens the signal file.
class Comparison {
 public:
  /// `program`: shelfbeam.
  explicit Comparison(std::filesystem::path folder, std::string program = jobs::own_program);

  /// `file`: a CSV file in the folder; `of_pairs`: it names a transceiver for every signal. Throws InputError
  /// without a plan, and while another comparison is running.
  void start(const std::string& file, bool of_pairs);
  /// To be called often. Returns the summary once it is known: that of `compare --json`, with `plan` and
  /// `output`, the names of folders of the project; or `message`, if it fails.
  std::optional<nlohmann::ordered_json> poll();

 private:
  std::filesystem::path folder_;
  std::string plan_, output_;
  Errand errand_;
};

}  // namespace shelfbeam::serve
