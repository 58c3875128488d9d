#include "app/text/flags.hpp"

#include <map>

#include <fmt/format.h>

#include "app/text/terminal.hpp"

namespace shelfbeam::app {

std::string with_flag(std::string_view message, Setting setting) {
  static const std::map<Setting, std::string_view> flags{{Setting::memory, "--memory"},
                                                         {Setting::files_outside, "--allow-outside"},
                                                         {Setting::resumption, "--resume"},
                                                         {Setting::requirement, "--threshold"},
                                                         {Setting::forbidden_pairs, "--forbid"},
                                                         {Setting::share, "--share"},
                                                         {Setting::units, "--at-most"},
                                                         {Setting::failure, "--survive-failure"},
                                                         {Setting::estimator, "--estimator"},
                                                         {Setting::strategy, "--strategy"},
                                                         {Setting::direct_light, "--direct"},
                                                         {Setting::bounces, "--max-bounces"},
                                                         {Setting::strictness, "--strict"},
                                                         {Setting::overwriting, "--overwrite"},
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
                                                         {Setting::sampled, "--sampled"}};
  const auto found = flags.find(setting);
  return found == flags.end() ? std::string(message) : fmt::format("{} ({})", message, found->second);
}

jobs::JobError job_error(const std::exception& error, Setting setting) {
  jobs::JobError end = jobs::error_of(error);
  end.message = one_line(with_flag(end.message, setting));
  return end;
}

}  // namespace shelfbeam::app
