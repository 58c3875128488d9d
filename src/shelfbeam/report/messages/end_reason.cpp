#include "shelfbeam/report/messages/end_reason.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string cause_text(const Words& words, const EndReason& reason) {
  switch (reason.cause) {
    case EndCause::labels_cost:
      return words.say_count("end.labels_cost", reason.labels);
    case EndCause::proof_cost:
      return reason.bounds_cost ? words.say("end.proof_cost.cost", words.plain(reason.bound))
                                : words.say_count("end.proof_cost", static_cast<std::uint64_t>(reason.bound));
    case EndCause::other:
      return reason.text;
    default:
      return words.say(fmt::format("end.{}", to_text(reason.cause)));
  }
}

}  // namespace

std::string end_text(const Words& words, const EndReason& reason) {
  return reason.leaves_cheaper ? fmt::format("{}; {}", words("end.cheaper"), cause_text(words, reason))
                               : cause_text(words, reason);
}

std::string with_effort(const Words& words, std::string answer, const std::optional<EndReason>& open) {
  if (!open || open->seconds <= 0) return answer;
  const auto seconds = static_cast<std::uint64_t>(std::max(1.0, std::ceil(open->seconds)));
  return fmt::format("{} {}", answer, words.say("end.effort", words.grouped(seconds)));
}

}  // namespace shelfbeam
