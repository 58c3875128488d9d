#include "app/batch/record.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/verbs.hpp"
#include "jobs/plan_folder.hpp"

namespace shelfbeam::app {
namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

namespace {

constexpr std::uint32_t record_version = 1;

// Paths need not be UTF-8.
std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

StoreStatus status_of(jobs::ExitCode code) {
  switch (code) {
    case done:
      return StoreStatus::planned;
    case answer_is_no:
      return StoreStatus::infeasible;
    case stopped_early:
      return StoreStatus::undecided;
    default:
      return StoreStatus::failed;
  }
}

Json to_json(const StoreRecord& record) {
  const StoreResult& result = record.result;
  const PlanEffort& effort = result.effort;
  Json json = {{"format", record_version}, {"input", record.input}, {"final", record.is_final},
               {"name", result.name},      {"store", result.store}, {"status", to_text(result.status)}};
  json.update(shelfbeam::to_json(result));
  json["report"] = result.report;
  json["effort"] = {{"cpu_s", effort.cpu_s},
                    {"wall_s", effort.wall_s},
                    {"peak_memory", effort.peak_memory},
                    {"runs", effort.runs}};
  return json;
}

StoreRecord from_json(const Json& json) {
  StoreRecord record;
  StoreResult& result = record.result;
  record.input = json.at("input");
  record.is_final = json.at("final");
  result.name = json.at("name");
  result.store = json.at("store");
  result.status = from_text<StoreStatus>(json.at("status").get<std::string>()).value();
  static_cast<PlanNumbers&>(result) = read_numbers(json);
  result.report = json.at("report");
  const Json& effort = json.at("effort");
  result.effort = {effort.at("cpu_s"), effort.at("wall_s"), effort.at("peak_memory"), effort.at("runs")};
  return record;
}

}  // namespace

std::optional<StoreRecord> read_record(const BatchFolder& folder, const ListedStore& store) {
  const fs::path path = folder.record(store.name);
  std::error_code unknown;
  if (!fs::exists(fs::symlink_status(path, unknown))) return std::nullopt;
  StoreRecord record;
  Json json;
  try {
    json = Json::parse(read_file(path));
    expect_format_version(path.string(), json.at("format").get<std::int64_t>(), record_version);
    record = from_json(json);
    if (record.result.name == store.name) return record;
    record.damage = fmt::format("{} is the record of the store {}", in_quotes(path.string()),
                                in_quotes(record.result.name));
  } catch (const InputError& error) {
    if (!json.is_null()) throw;  // a later version
    record.damage = error.what();
  } catch (const std::exception&) {
    record.damage = fmt::format("{} is not the record of a store", in_quotes(path.string()));
  }
  return StoreRecord{failed_result(store, record.damage), {}, false, record.damage};
}

void write_record(const BatchFolder& folder, const StoreRecord& record) {
  const fs::path path = folder.record(record.result.name);
  make_output_folder(path.parent_path());
  write_file(path, text_of(to_json(record)));
}

StoreResult without_result(const ListedStore& store) {
  StoreResult result;
  result.name = store.name;
  const std::string file = store.file.string();
  result.store = is_utf8(file) ? file : printable(file);
  return result;
}

StoreResult failed_result(const ListedStore& store, const std::string& reason) {
  StoreResult result = without_result(store);
  result.status = StoreStatus::failed;
  result.answer = reason;
  return result;
}

PlanEffort with_run(PlanEffort effort, const jobs::ChildEnd& end) {
  effort.cpu_s += end.cpu_s;
  effort.wall_s += end.wall_s;
  effort.peak_memory = std::max(effort.peak_memory, end.peak_memory);
  ++effort.runs;
  return effort;
}

StoreResult result_of(const BatchFolder& folder, const ListedStore& store, const jobs::JobEnd& end) {
  if (const auto* error = std::get_if<jobs::JobError>(&end)) return failed_result(store, error->message);
  const jobs::PlanSummary& summary = std::get<jobs::JobResult>(end).summary;
  StoreResult result = without_result(store);
  result.status = status_of(summary.code);
  static_cast<PlanNumbers&>(result) = summary;
  result.report =
      (folder.plan(result.name).lexically_relative(folder.path) / jobs::report_name).generic_string();
  return result;
}

}  // namespace shelfbeam::app
