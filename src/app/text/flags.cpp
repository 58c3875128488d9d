#include "app/text/flags.hpp"

#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/text/terminal.hpp"

namespace shelfbeam::app {

std::string with_flags(std::string_view message, std::span<const Setting> settings) {
  static const std::map<Setting, std::string_view> flags{
      {Setting::memory, "--memory"},
      {Setting::files_outside, "--allow-outside"},
      {Setting::resumption, "--resume"},
      {Setting::requirement, "--threshold"},
      {Setting::forbidden_pairs, "--forbid"},
      {Setting::share, "--share"},
      {Setting::units, "--at-most"},
      {Setting::share_of_labels, "--reach"},
      {Setting::failure, "--survive-failure"},
      {Setting::estimator, "--estimator"},
      {Setting::strategy, "--strategy"},
      {Setting::direct_light, "--direct"},
      {Setting::bounces, "--max-bounces"},
      {Setting::strictness, "--strict"},
      {Setting::overwriting, "--overwrite"},
      {Setting::overwriting_with_reuse, "--overwrite, --signal"},
      {Setting::part, "--part"},
      {Setting::reading, "--read-as"},
      {Setting::heuristic, "--heuristic"},
      {Setting::lengths, "--by-length"},
      {Setting::relative_error, "--relative-error"},
      {Setting::curve, "--curve"},
      {Setting::sensitivity, "--sensitivity"},
      {Setting::objective, "--objective"},
      {Setting::availability, "--availability"},
      {Setting::all_at_once, "--all-at-once"},
      {Setting::mean_missed, "--mean-missed"},
      {Setting::sampled, "--sampled"},
      {Setting::budget, "--budget"},
      {Setting::time_limit, "--time-limit"},
      {Setting::solver, "--solver"},
      {Setting::pinned, "--pin"},
      {Setting::excluded, "--exclude"},
      {Setting::without, "--without"}};
  std::vector<std::string_view> named;
  for (const Setting setting : settings)
    if (const auto found = flags.find(setting); found != flags.end()) named.push_back(found->second);
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
