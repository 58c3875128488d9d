#include "shelfbeam/report/messages/signals.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/text/catalogue.hpp"

namespace shelfbeam {

namespace {

std::string reason_text(const MisfitReason& reason) {
  const std::string key = fmt::format("signals.misfit.{}", to_text(reason.code));
  return reason.missing ? say_count(key, reason.missing->count, reason.missing->first) : say(key);
}

}  // namespace

std::string signals_text(const GivenSignals& given, std::size_t labels, std::size_t candidates,
                         const std::string& name) {
  if (const auto* misfit = std::get_if<MisfitReason>(&given))
    return say("signals.again", name, reason_text(*misfit));
  const auto& all = std::get<ReusedSignals>(given);
  if (all.labels == labels && all.transceivers == candidates)
    return say("signals.reused", grouped(labels), grouped(candidates), name);
  return say("signals.reused_some", grouped(labels), grouped(candidates), name, grouped(all.labels),
             grouped(all.transceivers));
}

}  // namespace shelfbeam
