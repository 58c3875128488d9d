#include "shelfbeam/report/messages/signals.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string reason_text(const MisfitReason& reason) {
  const std::string key = fmt::format("signals.misfit.{}", to_text(reason.code));
  return reason.missing > 0 ? say_count(key, reason.missing, reason.first_missing) : say(key);
}

}  // namespace

std::string signals_text(const GivenSignals& given, std::size_t labels, std::size_t candidates,
                         const std::string& name) {
  if (const auto* misfit = std::get_if<MisfitReason>(&given))
    return say("signals.again", name, reason_text(*misfit));
  return say("signals.reused", grouped(labels), grouped(candidates), name);
}

}  // namespace shelfbeam
