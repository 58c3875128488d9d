#include "serve/live/comparison.hpp"

#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

#include "serve/live/newest_plan.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

std::string free_name(const fs::path& folder) {
  std::error_code ignored;
  for (int number = 1;; ++number) {
    std::string name = number == 1 ? "comparison" : fmt::format("comparison-{}", number);
    if (fs::symlink_status(folder / name, ignored).type() == fs::file_type::not_found) return name;
  }
}

}  // namespace

Comparison::Comparison(fs::path folder, std::string program)
    : folder_(std::move(folder)), errand_(std::move(program), "the comparison") {}

void Comparison::start(const std::string& file, bool of_pairs) {
  if (errand_.is_running()) throw InputError(file, "another comparison is running", "wait for its end");
  plan_ = newest_plan(folder_);
  if (plan_.empty())
    throw InputError(file, "the folder of the project has no plan",
                     "run 'shelfbeam plan store.json -o plan' there first");
  if (!is_plain_file(folder_ / fs::path(file).filename())) throw InputError(file, "is missing in the folder");
  output_ = free_name(folder_);
  std::vector<std::string> words{"compare", (folder_ / plan_ / "signal.h5").string(),
                                 (folder_ / fs::path(file).filename()).string(), "-o",
                                 (folder_ / output_).string() + "/"};
  if (!of_pairs) words.insert(words.end(), {"--placement", (folder_ / plan_ / "placement.json").string()});
  errand_.start(std::move(words));
}

std::optional<Json> Comparison::poll() {
  std::optional<Json> summary = errand_.poll();
  if (!summary || summary->contains("message")) return summary;
  (*summary)["plan"] = plan_;
  (*summary)["output"] = output_;
  return summary;
}

}  // namespace shelfbeam::serve
