#include "serve/errands/comparison.hpp"

#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"

#include "serve/live/newest_plan.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

std::string free_name(const fs::path& folder) {
  std::error_code ignored;
  for (int number = 1;; ++number) {
    std::string name = number == 1 ? "comparison" : fmt::format("comparison-{}", number);
    if (fs::symlink_status(folder / name, ignored).type() == fs::file_type::not_found) return name;
  }
}

}  // namespace

ComparisonCommand comparison_command(const fs::path& folder, const std::string& file, bool of_pairs) {
  const std::string plan = newest_plan(folder);
  if (plan.empty())
    throw InputError(file, "the folder of the project has no plan",
                     "run 'shelfbeam plan store.json -o plan' there first");
  const fs::path measured = folder / fs::path(file).filename();
  if (!is_plain_file(measured)) throw InputError(file, "is missing in the folder");
  const std::string output = free_name(folder);
  std::vector<std::string> words{"compare", (folder / plan / "signal.h5").string(), measured.string(), "-o",
                                 (folder / output).string() + "/"};
  if (!of_pairs) words.insert(words.end(), {"--placement", (folder / plan / "placement.json").string()});
  return {std::move(words), {{"plan", plan}, {"output", output}}};
}

}  // namespace shelfbeam::serve
