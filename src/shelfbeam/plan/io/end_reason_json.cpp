#include "shelfbeam/plan/io/end_reason_json.hpp"

#include <cstdint>
#include <limits>

namespace shelfbeam::detail {

namespace {

constexpr std::int64_t max_number = std::numeric_limits<std::uint32_t>::max();

}  // namespace

Json to_json(const std::optional<EndReason>& reason) {
  if (!reason) return nullptr;
  Json object = {{"code", to_text(reason->cause)}};
  if (reason->cause == EndCause::labels_cost) object["labels"] = reason->labels;
  if (reason->cause == EndCause::proof_cost && reason->bounds_cost) object["cost"] = reason->bound;
  if (reason->cause == EndCause::proof_cost && !reason->bounds_cost)
    object["count"] = static_cast<std::int64_t>(reason->bound);
  if (reason->cause == EndCause::other) object["text"] = reason->text;
  if (reason->leaves_cheaper) object["leaves_cheaper"] = true;
  return object;
}

std::optional<EndReason> read_end_reason(const JsonCursor& json) {
  if (json.is_null()) return {};
  if (json.is_string()) {
    const std::string text = json.text();
    if (text.empty()) return {};
    return EndReason{.cause = EndCause::other, .text = text};
  }
  json.expect_keys({"code", "labels", "count", "cost", "text", "leaves_cheaper"});
  EndReason reason{json["code"].choice<EndCause>()};
  if (const auto labels = json.find("labels"))
    reason.labels = static_cast<std::size_t>(labels->integer(0, max_number));
  if (const auto count = json.find("count"))
    reason.bound = static_cast<double>(count->integer(0, max_number));
  if (const auto cost = json.find("cost")) {
    reason.bound = cost->non_negative();
    reason.bounds_cost = true;
  }
  if (const auto text = json.find("text")) reason.text = text->text();
  if (const auto more = json.find("leaves_cheaper")) reason.leaves_cheaper = more->boolean();
  return reason;
}

}  // namespace shelfbeam::detail
