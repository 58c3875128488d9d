#include "shelfbeam/report/messages/end_reason.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string cause_text(const EndReason& reason) {
  switch (reason.cause) {
    case EndCause::labels_cost:
      return say_count("end.labels_cost", reason.labels);
    case EndCause::proof_cost:
      return reason.bounds_cost ? say("end.proof_cost.cost", plain(reason.bound))
                                : say_count("end.proof_cost", static_cast<std::uint64_t>(reason.bound));
    case EndCause::other:
      return reason.text;
    default:
      return say(fmt::format("end.{}", to_text(reason.cause)));
  }
}

}  // namespace

std::string end_text(const EndReason& reason) {
  return reason.leaves_cheaper ? fmt::format("{}; {}", words("end.cheaper"), cause_text(reason))
                               : cause_text(reason);
}

std::string with_effort(std::string answer, const std::optional<EndReason>& open) {
  if (!open || open->seconds <= 0) return answer;
  const auto seconds = static_cast<std::uint64_t>(std::max(1.0, std::ceil(open->seconds)));
  return fmt::format("{} {}", answer, say("end.effort", grouped(seconds)));
}

}  // namespace shelfbeam
