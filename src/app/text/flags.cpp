#include "app/text/flags.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/text/terminal.hpp"

namespace shelfbeam::app {

std::string with_flags(std::string_view message, std::span<const Setting> settings) {
  std::vector<std::string> named;
  for (const Setting setting : settings) {
    if (setting == Setting::overwriting_with_reuse)
      named.emplace_back("--overwrite, --signal");
    else if (const std::string_view name = to_text(setting); !name.empty())
      named.push_back(fmt::format("--{}", name));
  }
  return named.empty() ? std::string(message) : fmt::format("{} ({})", message, fmt::join(named, ", "));
}

std::string with_flag(std::string_view message, Setting setting) {
  return with_flags(message, {&setting, 1});
}

jobs::JobError job_error(const std::exception& error, Setting setting) {
  jobs::JobError end = jobs::error_of(error);
  end.message = one_line(with_flag(end.message, setting));
  return end;
}

}  // namespace shelfbeam::app
