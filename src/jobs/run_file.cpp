#include "jobs/run_file.hpp"

#include <chrono>
#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::jobs {

namespace {

using Json = nlohmann::ordered_json;

constexpr int run_format = 1;
constexpr auto hash_begin = ",\n  \"hash\": \"", hash_end = "\"\n}\n";

double wall_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_now() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::uint64_t peak_memory() {
  constexpr std::uint64_t kibibyte = 1024;
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return kibibyte * static_cast<std::uint64_t>(used.ru_maxrss);
}

void add_effort(Json& json, const char* name, const std::optional<EndReason>& open) {
  if (open && open->seconds > 0) json[name] = open->seconds;
}

Json to_json(const GivenSignals& given) {
  if (const auto* misfit = std::get_if<MisfitReason>(&given)) {
    Json json = {{"reused", false}, {"misfit", to_text(misfit->code)}};
    if (misfit->missing)
      json.update({{"missing", misfit->missing->count}, {"first_missing", misfit->missing->first}});
    return json;
  }
  const auto& [labels, transceivers, seed] = std::get<ReusedSignals>(given);
  return {{"reused", true}, {"labels", labels}, {"transceivers", transceivers}, {"seed", seed}};
}

}  // namespace

RunClock::RunClock() : wall_(wall_now()), cpu_(cpu_now()) {}

RunEffort RunClock::effort(unsigned threads) const {
  return {wall_now() - wall_, cpu_now() - cpu_, peak_memory(), threads};
}

std::string run_json(const Plan& plan, const RunEffort& effort, const std::string& store) {
  Json seconds = {{"simulation", plan.simulation.summary.seconds}, {"placement", plan.placement.seconds}};
  if (plan.certificate) seconds["certificate"] = plan.certificate->seconds;
  if (plan.availability) seconds["states"] = plan.availability->seconds;
  if (plan.sensitivity) seconds["sensitivity"] = plan.sensitivity->seconds;
  seconds["total"] = effort.wall_s;
  Json json = {
      {"format", run_format},     {"program", program_version()},      {"store", store},
      {"seconds", seconds},       {"processor_seconds", effort.cpu_s}, {"peak_memory", effort.peak_memory},
      {"threads", effort.threads}};
  if (plan.signals) json["signals"] = to_json(*plan.signals);
  if (plan.certificate) add_effort(json, "seconds_to_decide", plan.certificate->open);
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  const std::string values = text.substr(0, text.size() - 2);  // without "\n}"
  return fmt::format("{}{}{}{}", values, hash_begin, content_hash(values), hash_end);
}

bool is_run_file(const std::filesystem::path& file) {
  constexpr std::uint64_t max_size = 1 << 16;
  std::string text;
  try {
    text = read_file(file, max_size);
  } catch (const InputError&) {  // too large, or not a file
    return false;
  }
  const std::size_t at = text.rfind(hash_begin);
  if (at == std::string::npos) return false;
  const std::string values = text.substr(0, at);
  return text.substr(at) == fmt::format("{}{}{}", hash_begin, content_hash(values), hash_end);
}

}  // namespace shelfbeam::jobs
