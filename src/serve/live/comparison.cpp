#include "serve/live/comparison.hpp"

#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

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
    : folder_(std::move(folder)), program_(std::move(program)) {}

void Comparison::start(const std::string& file, bool of_pairs) {
  if (child_) throw InputError(file, "another comparison is running", "wait for its end");
  plan_ = newest_plan(folder_);
  if (plan_.empty())
    throw InputError(file, "the folder of the project has no plan",
                     "run 'shelfbeam plan store.json -o plan' there first");
  if (!is_plain_file(folder_ / fs::path(file).filename())) throw InputError(file, "is missing in the folder");
  output_ = free_name(folder_);
  std::vector<std::string> words{program_,
                                 "compare",
                                 (folder_ / plan_ / "signal.h5").string(),
                                 (folder_ / fs::path(file).filename()).string(),
                                 "-o",
                                 (folder_ / output_).string() + "/",
                                 "--json"};
  if (!of_pairs) words.insert(words.end(), {"--placement", (folder_ / plan_ / "placement.json").string()});
  child_.emplace(std::move(words), memory_limit());
}

std::optional<Json> Comparison::poll() {
  jobs::ChildEnd end;
  if (!child_ || !child_->has_ended(end)) return {};
  child_.reset();
  Json summary = Json::parse(end.out, nullptr, false);
  if (end.exit_code != 0 || !summary.is_object()) {
    std::string message = end.err.substr(0, end.err.find('\n'));
    if (constexpr std::string_view mark = "error: "; message.starts_with(mark)) message.erase(0, mark.size());
    return Json{{"message", message.empty() ? "the comparison has failed" : message}};
  }
  summary["plan"] = plan_;
  summary["output"] = output_;
  return summary;
}

}  // namespace shelfbeam::serve
