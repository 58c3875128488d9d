#include "shelfbeam/report/messages/signals.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

std::string reason_text(const Words& words, const MisfitReason& reason) {
  const std::string key = fmt::format("signals.misfit.{}", to_text(reason.code));
  return reason.missing ? words.say_count(key, reason.missing->count, reason.missing->first) : words.say(key);
}

std::string signals_text(const Words& words, const GivenSignals& given, std::size_t labels,
                         std::size_t candidates, const std::string& name) {
  if (const auto* misfit = std::get_if<MisfitReason>(&given))
    return words.say("signals.again", name, reason_text(words, *misfit));
  const auto& all = std::get<ReusedSignals>(given);
  if (all.labels == labels && all.transceivers == candidates)
    return words.say("signals.reused", words.grouped(labels), words.grouped(candidates), name);
  return words.say("signals.reused_some", words.grouped(labels), words.grouped(candidates), name,
                   words.grouped(all.labels), words.grouped(all.transceivers));
}

}  // namespace shelfbeam
