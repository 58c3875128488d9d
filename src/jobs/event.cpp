#include "jobs/event.hpp"

#include <cmath>
#include <exception>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam::jobs {

namespace {

using Json = nlohmann::ordered_json;

std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

template <class T>
void read(const Json& json, const char* key, std::optional<T>& value) {
  if (const auto found = json.find(key); found != json.end() && !found->is_null()) value = found->get<T>();
}

// The object of a line of this kind; null for any other line.
Json object_of(std::string_view line, std::string_view kind) {
  Json json = Json::parse(line, nullptr, false);
  const bool is_of_kind = json.is_object() && json.contains("event") && json["event"] == kind;
  return is_of_kind ? json : Json(nullptr);
}

}  // namespace

ExitCode exit_code_of(const JobEnd& end) {
  const auto* error = std::get_if<JobError>(&end);
  return error != nullptr ? error->code : std::get<JobResult>(end).summary.code;
}

JobError error_of(const std::exception& error) {
  JobError end{exit_code_of(error), error.what()};
  end.is_interruption = dynamic_cast<const Interrupted*>(&error) != nullptr;
  // Outputs that cannot be written mention the checkpoint that remains.
  if (const auto* input = dynamic_cast<const InputError*>(&error))
    end.is_of_checkpoint =
        input->setting() == Setting::resumption && dynamic_cast<const OutputError*>(input) == nullptr;
  return end;
}

std::string line_of(const JobEnd& end) {
  if (const auto* error = std::get_if<JobError>(&end))
    return line({{"event", "error"},
                 {"code", static_cast<int>(error->code)},
                 {"message", error->message},
                 {"of_checkpoint", error->is_of_checkpoint},
                 {"interrupted", error->is_interruption}});
  const auto& [summary, is_complete] = std::get<JobResult>(end);
  Json result = {{"event", "result"}, {"code", static_cast<int>(summary.code)}, {"complete", is_complete}};
  result.update(to_json(summary));
  result["selected"] = summary.selected;
  return line(result);
}

namespace {

std::optional<JobEnd> end_of(std::string_view line) {
  if (const Json json = object_of(line, "error"); !json.is_null())
    return JobError{json.at("code").get<ExitCode>(), json.at("message"), json.at("of_checkpoint"),
                    json.at("interrupted")};
  const Json json = object_of(line, "result");
  if (json.is_null()) return {};
  return JobResult{{read_numbers(json), json.at("code").get<ExitCode>(), json.at("selected")},
                   json.at("complete")};
}

}  // namespace

std::optional<JobEnd> read_end(std::string_view line) try {
  return end_of(line);
} catch (const Json::exception&) {  // of another program
  return {};
}

void EventProgress::report(Task task, double fraction, std::string_view detail) {
  constexpr std::chrono::milliseconds pause(250);
  const Clock::time_point now = Clock::now();
  const Progress progress =
      stages_.update(task, fraction, detail, std::chrono::duration<double>(now - begun_).count());
  if (progress.task != task) next_ = {};  // of a step
  if (shown_ && shown_->task != progress.task) {
    // The last incumbent of a task is its result.
    if (has_unwritten_bounds_) write(*shown_);
    bounds_ = {};
  }
  has_unwritten_bounds_ = has_unwritten_bounds_ || next_.incumbent || next_.lower || next_.selected;
  if (next_.incumbent) bounds_.incumbent = next_.incumbent;
  if (next_.lower) bounds_.lower = next_.lower;
  if (next_.selected) bounds_.selected = std::move(next_.selected);
  next_ = {};
  shown_ = progress;
  if (written_ && now - *written_ < pause) return;
  written_ = now;
  write(progress);
}

void EventProgress::write(const Progress& progress) {
  has_unwritten_bounds_ = false;
  const auto known = [](double value) { return value < 0 ? Json(nullptr) : Json(value); };
  Json json{{"event", "progress"},
            {"task", to_text(progress.task)},
            {"share", known(progress.fraction)},
            {"seconds_left", known(progress.seconds_left)},
            {"incumbent", or_null(bounds_.incumbent)},
            {"lower_bound", or_null(bounds_.lower)},
            {"detail", progress.detail}};
  if (bounds_.selected && *bounds_.selected != written_selection_) {
    written_selection_ = *bounds_.selected;
    json["selected"] = written_selection_;
  }
  write_(line(json));
}

void EventProgress::bounds(double incumbent, double lower_bound) {
  if (std::isfinite(incumbent)) next_.incumbent = incumbent;
  if (std::isfinite(lower_bound)) next_.lower = lower_bound;
}

void EventProgress::selection(const std::vector<std::string>& ids) {
  next_.selected = ids;
}

bool pass_on(std::string_view line, ProgressSink& sink) {
  const Json json = object_of(line, "progress");
  if (json.is_null()) return false;
  std::optional<double> share, incumbent, lower_bound;
  read(json, "share", share);
  read(json, "incumbent", incumbent);
  read(json, "lower_bound", lower_bound);
  const auto task = from_text<Task>(json.at("task").get<std::string>());
  if (!task) return false;  // of another version
  if (incumbent && lower_bound) sink.bounds(*incumbent, *lower_bound);
  if (const auto found = json.find("selected"); found != json.end())
    sink.selection(found->get<std::vector<std::string>>());
  sink.report(*task, share.value_or(-1), json.at("detail").get<std::string>());
  return true;
}

}  // namespace shelfbeam::jobs
