#include "jobs/plan_job_json.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/field_writer.hpp"

namespace shelfbeam::jobs {

namespace {

using Json = nlohmann::ordered_json;

// A key that may be absent, which is written if its value is not the default.
Field optional(std::string_view says, bool is_written) {
  return {.says = says, .is_optional = true, .is_written = is_written};
}

// Paths need not be UTF-8; others are lists of bytes.
std::filesystem::path read_path(const JsonCursor& json) {
  if (!json.is_array()) return json.text();
  std::string bytes;
  for (const JsonCursor& byte : json.elements()) bytes += static_cast<char>(byte.integer(0, 255));
  return bytes;
}

Json path_json(const std::filesystem::path& path) {
  const std::string text = path.string();
  if (is_utf8(text)) return text;
  Json bytes = Json::array();
  for (const char byte : text) bytes.push_back(static_cast<unsigned char>(byte));
  return bytes;
}

void path(Fields& f, std::string_view key, std::optional<std::filesystem::path>& value,
          std::string_view says) {
  f.custom(key,
           {[&](const JsonCursor& json) { value = read_path(json); }, [&] { return path_json(*value); },
            R"({"type": ["string", "array"]})"},
           optional(says, value.has_value()));
}

template <class Value, class Read, class Write>
void list(Fields& f, std::string_view key, std::vector<Value>& values, std::string_view says,
          const Read& read_one, const Write& write_one) {
  const auto read = [&](const JsonCursor& json) {
    values.clear();
    for (const JsonCursor& element : json.elements()) values.push_back(read_one(element));
  };
  const auto write = [&] {
    Json list = Json::array();
    for (const Value& value : values) list.push_back(write_one(value));
    return list;
  };
  f.custom(key, {read, write, R"({"type": "array", "items": {"type": "string"}})"},
           optional(says, !values.empty()));
}

void paths(Fields& f, std::string_view key, std::vector<std::filesystem::path>& values,
           std::string_view says) {
  list(f, key, values, says, read_path, path_json);
}

void texts(Fields& f, std::string_view key, std::vector<std::string>& values, std::string_view says) {
  list(f, key, values, says, std::mem_fn(&JsonCursor::text),
       [](const std::string& text) { return Json(text); });
}

Cause read_cause(const JsonCursor& json) {
  return cause_of_key(json.choice(std::span(cause_keys)));
}

// Limits are those of the command line, where a positive number has no other.
constexpr double above_zero = 1e-12;

struct Limits {
  double least = above_zero, most = std::numeric_limits<double>::infinity();
};

// Describes a value that has a default as one that is given or not.
template <class T, class Describe>
void with_default(T& value, const T& usual, const Describe& describe) {
  std::optional<T> given = value == usual ? std::nullopt : std::optional(value);
  describe(given);
  value = given.value_or(value);
}

void number(Fields& f, std::string_view key, std::optional<double>& value, const Limits& limits,
            std::string_view says) {
  double given = value.value_or(0);
  Field field = optional(says, value.has_value());
  field.least = limits.least;
  field.most = limits.most;
  if (f.scalar(key, Scalar::number, given, field)) value = given;
}

void number(Fields& f, std::string_view key, double& value, double usual, const Limits& limits,
            std::string_view says) {
  with_default(value, usual, [&](auto& given) { number(f, key, given, limits, says); });
}

template <class T>
void whole(Fields& f, std::string_view key, std::optional<T>& value, std::string_view says,
           std::int64_t least, std::int64_t most) {
  f.custom(key,
           {[&](const JsonCursor& json) { value = static_cast<T>(json.integer(least, most)); },
            [&] { return Json(*value); }, R"({"type": "integer", "minimum": 0})"},
           optional(says, value.has_value()));
}

template <class Enum>
void name(Fields& f, std::string_view key, std::optional<Enum>& value, std::string_view says) {
  f.custom(key,
           {[&](const JsonCursor& json) { value = json.choice<Enum>(); },
            [&] { return Json(to_text(*value)); }, R"({"type": "string"})"},
           optional(says, value.has_value()));
}

template <class Enum>
void name(Fields& f, std::string_view key, Enum& value, Enum usual, std::string_view says) {
  with_default(value, usual, [&](auto& given) { name(f, key, given, says); });
}

void flag(Fields& f, std::string_view key, bool& value, bool usual, std::string_view says) {
  f.boolean(key, value, optional(says, value != usual));
}

void describe(Fields& f, SimulationRequest& r) {
  constexpr std::int64_t max_samples = std::int64_t{1} << 36;
  name(f, "estimator", r.estimator, "`reuse` or `uniform`");
  name(f, "direct", r.direct, "of `uniform`: `sampled` or `exact`");
  whole(f, "samples", r.samples, "per label", 64, max_samples);
  number(f, "relative_error", r.relative_error, {above_zero, 1}, "to reach, instead of `samples`");
  number(f, "above", r.above, {}, "share of the requirement from which `relative_error` matters");
  whole(f, "max_samples", r.max_samples, "per label, with `relative_error`", 2096, max_samples);
  number(f, "seconds", r.time_s, {}, "time limit, instead of `samples`");
  name(f, "strategy", r.strategy, "of `uniform`");
  name(f, "heuristic", r.heuristic, "of `uniform`");
  whole(f, "max_bounces", r.max_bounces, "of `uniform`", 0, 1000);
  with_default(r.memory, std::size_t{0}, [&](auto& given) {
    whole(f, "memory", given, "limit in bytes", 0, std::numeric_limits<std::int64_t>::max());
  });
}

void describe(Fields& f, PlacementProblem& p) {
  const PlacementProblem usual = PlanRequest{}.problem;
  name(f, "model", p.model, usual.model, "`cooperative` or `non-cooperative`");
  name(f, "objective", p.objective, usual.objective, "besides the number or the price of the units");
  name(f, "combination", p.combination, usual.combination,
       "`lexicographic`, `weighted` or `spend`; default: by the prices");
  number(f, "share", p.share, usual.share, {}, "of the requirement, for an effective link");
  flag(f, "survives_failure", p.redundant, usual.redundant, "labels stay reached if any one unit fails");
}

void describe(Fields& f, PlaceOptions& p) {
  const PlaceOptions usual;
  name(f, "solver", p.solver, usual.solver, "`auto`, `search`, `mip` or `greedy`");
  f.text("backend", p.backend, optional("MIP back end", !p.backend.empty()));
  number(f, "time_limit", p.time_limit_s, usual.time_limit_s, {}, "s");
}

void describe(Fields& f, PartialQuestion& question) {
  whole(f, "at_most", question.at_most, "number of units that reach as many labels as possible", 1,
        std::numeric_limits<std::int64_t>::max());
  number(f, "reach", question.share, {above_zero, 1}, "share of the labels, with as few units as possible");
}

void describe(Fields& f, TableConstraints& c) {
  paths(f, "costs", c.costs, "CSV files with costs");
  number(f, "min_spacing", c.min_spacing, 0, {0}, "m between new units and all others");
  paths(f, "forbidden", c.forbidden, "CSV files with pairs that must not both be chosen");
}

void describe(Fields& f, AvailabilityGoal& goal) {
  name(f, "rule", goal.rule, AvailabilityRule::labels, "`labels`, `shop` or `misses`");
  const Limits limits = goal.rule == AvailabilityRule::labels ? Limits{0.5, 0.9999}
                        : goal.rule == AvailabilityRule::shop ? Limits{0.01, 0.9999}
                                                              : Limits{};
  number(f, "value", goal.value, limits, "share of the states, or mean number of missed labels");
}

void describe(Fields& f, PlanRequest& r) {
  const PlanRequest usual;
  const auto read_seed = [&](const JsonCursor& json) { r.seed = json.natural(); };
  f.custom("seed", {read_seed, [&] { return Json(r.seed); }, R"({"type": "integer", "minimum": 0})"},
           optional("of the random numbers", r.seed != usual.seed));
  f.object("simulation", [&](Fields& part) { describe(part, r.simulation); }, optional("", true));
  f.object("problem", [&](Fields& part) { describe(part, r.problem); }, optional("", true));
  describe(f, r.partial);
  f.object("place", [&](Fields& part) { describe(part, r.place); }, optional("", true));
  f.object("constraints", [&](Fields& part) { describe(part, r.constraints); }, optional("", true));
  flag(f, "certify", r.certifies, usual.certifies, "with independent samples");
  number(f, "confidence", r.confidence, usual.confidence, {0.5, 0.999999}, "of the certificate");
  number(f, "budget", r.budget_s, usual.budget_s, {}, "time limit of the certificate, s");
  flag(f, "curve", r.curve, usual.curve, "labels that fewer units can reach");
  flag(f, "alternatives", r.alternatives, usual.alternatives, "one unit fewer, one more, any failure");
  number(f, "reflectance_error", r.reflectance_error, {0, 1}, "examines the sensitivity to reflectances");
  whole(f, "states", r.states, "of a changing shop; 0: the shop as the file gives it", 0, 10'000);
  f.object("goal", [&](Fields& part) { describe(part, r.goal); }, optional("", r.goal.value.has_value()));
}

void describe(Fields& f, PlanJob& job) {
  const PlanJob usual;
  with_default(job.store, usual.store, [&](auto& given) { path(f, "store", given, "store file"); });
  with_default(job.folder, usual.folder, [&](auto& given) { path(f, "folder", given, "for the results"); });
  f.object("plan", [&](Fields& part) { describe(part, job.plan); }, optional("the request", true));
  path(f, "selection", job.selection,
       "placement.json, or a CSV of mounted units, to be examined instead of a plan; empty: those of the "
       "store");
  name(f, "model", job.model, "of a selection: instead of its own");
  texts(f, "pinned", job.units.pinned, "ids or patterns of units that are part of the plan");
  texts(f, "excluded", job.units.excluded, "ids or patterns of units that are not");
  list(f, "without", job.without, "keys of `variation`, or `reflectances`: changes that are left out",
       read_cause, [](Cause cause) { return Json(key_of(cause)); });
  path(f, "signal", job.signal, "signals to reuse if they fit: a signal file, or the folder of a plan");
  flag(f, "optional_signal", job.is_signal_optional, false, "signals that cannot be read are simulated");
  paths(f, "sampled", job.sampled, "outputs of `simulate --states N --for-plan`");
  path(f, "preview", job.preview,
       "a first answer, without a simulation and without files, by the light operators in this folder");
  with_default(job.threads, usual.threads,
               [&](auto& given) { whole(f, "threads", given, "0: one per core", 0, 256); });
  flag(f, "resume", job.checkpoint.resume, false, "continue an interrupted run in the folder");
  number(f, "checkpoint_interval", job.checkpoint.interval_s, usual.checkpoint.interval_s, {0}, "s");
  flag(f, "allow_outside", job.allow_outside, false, "the store may name files outside its folder");
  whole(f, "file_size", job.file_size, "limit of the store file and of each file that it names, bytes", 1,
        std::numeric_limits<std::int64_t>::max());
  flag(f, "strict", job.strict, false, "warnings count as errors");
  flag(f, "overwrite", job.overwrite, false, "replace a finished plan in the folder");
  flag(f, "safe_csv", job.safe_csv, false, "ids cannot be formulas of a spreadsheet");
  flag(f, "progress", job.reports_progress, true, "report it");
}

}  // namespace

std::string to_json(const PlanJob& job) {
  PlanJob copy = job;
  Json json = Json::object();
  const Store nothing;
  FieldWriter writer(json, {nothing.materials, nothing.label_types, nothing.transceiver_types});
  describe(writer, copy);
  return json.dump(-1, ' ', false, Json::error_handler_t::strict);
}

PlanJob parse_plan_job(const std::string& text, const std::string& name) {
  PlanJob job;
  const JsonCursor json = JsonCursor::parse(text, name);
  const StoreNames names{Store{}};
  Problems problems(name);
  FieldReader reader(json, names, problems);
  reader.expect_keys(keys_of([&](Fields& f) { describe(f, job); }));
  describe(reader, job);
  problems.throw_first();
  for (const auto& [key, value] : {std::pair("store", &job.store), std::pair("folder", &job.folder)})
    if (value->empty()) json.fail(fmt::format("has no '{}'", key), "add it");
  return job;
}

}  // namespace shelfbeam::jobs
