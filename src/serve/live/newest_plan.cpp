#include "serve/live/newest_plan.hpp"

#include <system_error>

namespace shelfbeam::serve {

namespace fs = std::filesystem;

bool is_plain_file(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() == fs::file_type::regular;
}

std::optional<fs::file_time_type> time_of_plan(const fs::path& folder) {
  const fs::path placement = folder / "placement.json";
  if (!is_plain_file(placement)) return {};
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(placement, error);
  return error ? std::nullopt : std::optional(time);
}

std::string newest_plan(const fs::path& folder) {
  std::string newest;
  std::optional<fs::file_time_type> last;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.symlink_status(error).type() != fs::file_type::directory) continue;
    if (!is_plain_file(entry.path() / "signal.h5")) continue;
    const auto time = time_of_plan(entry.path());
    if (!time || (last && *time <= *last)) continue;
    newest = entry.path().filename().string();
    last = time;
  }
  return newest;
}

}  // namespace shelfbeam::serve
