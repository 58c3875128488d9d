#include "shelfbeam/plan/io/end_reason_json.hpp"

namespace shelfbeam::detail {

void describe(Record& record, EndReason& reason) {
  const EndCause cause = reason.cause;
  record.name("code", reason.cause);
  if (record.has("labels", cause == EndCause::labels_cost)) record.count("labels", reason.labels);
  if (record.has("cost", cause == EndCause::proof_cost && reason.bounds_cost)) {
    record.non_negative("cost", reason.bound);
    reason.bounds_cost = true;
  }
  if (record.has("count", cause == EndCause::proof_cost && !reason.bounds_cost)) {
    auto count = static_cast<std::size_t>(reason.bound);
    record.count("count", count);
    reason.bound = static_cast<double>(count);
  }
  if (record.has("text", cause == EndCause::other)) record.text("text", reason.text);
  if (record.has("leaves_cheaper", reason.leaves_cheaper))
    record.boolean("leaves_cheaper", reason.leaves_cheaper);
}

void describe_end(Record& record, std::optional<EndReason>& reason) {
  const auto write = [&] { return reason ? Record::write(*reason, record.ids()) : Json(nullptr); };
  record.custom("open", write, [&](const JsonCursor& json) {
    if (!json.is_string() && !json.is_null())
      reason = Record::read<EndReason>(json, record.ids());
    else if (json.is_string() && !json.text().empty())
      reason = {.cause = EndCause::other, .text = json.text()};
  });
}

}  // namespace shelfbeam::detail
