#include "app/batch/record.hpp"

#include <algorithm>
#include <csignal>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

#include "app/exit_details.hpp"
#include "app/plan_folder.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {
namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

namespace {

constexpr std::uint32_t record_version = 1;

// Paths need not be UTF-8.
std::string text_of(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// The first line after warnings, without the scope of the confidence, which all plans of a batch share.
std::string answer_in(std::string_view text) {
  while (text.starts_with("warning: ")) text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
  std::string line = first_line(std::string(text));
  if (const std::size_t scope = line.find(words("certificate.scope")); scope != std::string::npos)
    line.erase(scope > 0 ? scope - 1 : 0);
  return line;
}

// The last line that begins with a kind of message.
std::string message_in(const std::string& text, std::string_view kind) {
  const std::size_t at = text.rfind(kind);
  return at == std::string::npos ? "" : first_line(text.substr(at + kind.size()));
}

StoreStatus status_of(int exit_code) {
  switch (exit_code) {
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

// The object that has the bound of the answer: if labels are verified, the certificate.
const Json& bound_source(const Json& plan) {
  const auto certificate = plan.find("certificate");
  return certificate != plan.end() && !certificate->at("reached").is_null() ? *certificate : plan;
}

// The numbers of placement.json.
void read_plan(const BatchFolder& folder, StoreResult& result) {
  const fs::path plan = folder.plan(result.name);
  const Json json = Json::parse(read_file(plan / placement_name));
  result.labels = json.at("labels");
  // Without an answer, units and bound are those of the shop as the file gives it.
  const bool is_answer = result.status != StoreStatus::infeasible;
  if (const std::uint64_t count = json.at("count"); is_answer && count > 0) result.units = count;
  if (const Json& bound = bound_source(json)["count_lower_bound"];
      is_answer && bound.is_number_unsigned() && bound > 0)
    result.lower_bound = bound;
  if (const auto price = json.find("price"); price != json.end() && price->is_object()) {
    result.price = price->at("new");
    if (const auto& currency = price->at("currency"); currency.is_string()) result.currency = currency;
  }
  if (const auto warnings = json.find("warnings"); warnings != json.end())
    result.warnings = warnings->get<std::vector<std::string>>();
  result.report = (plan.lexically_relative(folder.path) / report_name).generic_string();
}

Json to_json(const StoreRecord& record) {
  const StoreResult& result = record.result;
  const PlanEffort& effort = result.effort;
  const auto optional = [](const auto& value) { return value ? Json(*value) : Json(); };
  return {{"format", record_version},
          {"input", record.input},
          {"final", record.is_final},
          {"name", result.name},
          {"store", result.store},
          {"status", to_text(result.status)},
          {"answer", result.answer},
          {"labels", result.labels},
          {"units", optional(result.units)},
          {"lower_bound", optional(result.lower_bound)},
          {"price", optional(result.price)},
          {"currency", result.currency},
          {"warnings", result.warnings},
          {"report", result.report},
          {"effort",
           {{"cpu_s", effort.cpu_s},
            {"wall_s", effort.wall_s},
            {"peak_memory", effort.peak_memory},
            {"runs", effort.runs}}}};
}

StoreRecord from_json(const Json& json) {
  StoreRecord record;
  StoreResult& result = record.result;
  const auto read = [&](const char* key, auto& value) {
    if (!json.at(key).is_null())
      value = json.at(key).get<typename std::decay_t<decltype(value)>::value_type>();
  };
  record.input = json.at("input");
  record.is_final = json.at("final");
  result.name = json.at("name");
  result.store = json.at("store");
  result.status = from_text<StoreStatus>(json.at("status").get<std::string>()).value();
  result.answer = json.at("answer");
  result.labels = json.at("labels");
  read("units", result.units);
  read("lower_bound", result.lower_bound);
  read("price", result.price);
  result.currency = json.at("currency");
  result.warnings = json.at("warnings").get<std::vector<std::string>>();
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

std::string failure_of(const ChildEnd& end) {
  for (const std::string_view kind : {"internal error: ", "error: "})
    if (std::string message = message_in(end.err, kind); !message.empty()) return message;
  return end.exit_code > 128 ? fmt::format("the plan was ended by signal {}", end.exit_code - 128)
                             : fmt::format("the plan ended with exit code {}", end.exit_code);
}

bool was_interrupted(const ChildEnd& end) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (end.exit_code == 128 + signal) return true;
  return end.exit_code == interrupted;
}

PlanEffort with_run(PlanEffort effort, const ChildEnd& end) {
  effort.cpu_s += end.cpu_s;
  effort.wall_s += end.wall_s;
  effort.peak_memory = std::max(effort.peak_memory, end.peak_memory);
  ++effort.runs;
  return effort;
}

StoreResult result_of(const BatchFolder& folder, const ListedStore& store, const ChildEnd& end) {
  const StoreStatus status = status_of(end.exit_code);
  if (status == StoreStatus::failed) return failed_result(store, failure_of(end));
  StoreResult result = without_result(store);
  result.status = status;
  result.answer = answer_in(end.out);
  try {
    read_plan(folder, result);
  } catch (const std::exception& error) {
    return failed_result(store, fmt::format("the plan cannot be read ({})", error.what()));
  }
  return result;
}

}  // namespace shelfbeam::app
