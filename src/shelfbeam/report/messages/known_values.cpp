#include "shelfbeam/report/messages/known_values.hpp"

#include <fmt/format.h>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

std::string verified_words(const Words& words, const CertifiedPlan& plan) {
  return words.say(fmt::format("verdict.certified.yes.{}", to_text(plan.weakest_state())));
}

namespace {

std::string with_amount(const Words& words, const DecisiveValue& value, const std::string& name) {
  if (!(value.amount > 0)) return name;
  return words.say(
      "values.value", name,
      words.say(fmt::format("values.amount.{}", to_text(value.kind)), words.plain(value.amount, 4)));
}

}  // namespace

std::string value_words(const Words& words, const DecisiveValue& value) {
  return with_amount(words, value, words.say(fmt::format("values.kind.{}", to_text(value.kind)), value.of));
}

// "threshold of standard (0.03 W/m²), large (0.024 W/m²); ceiling height (4.2 m)"
std::string assumed_sentence(const Words& words, const CertifiedPlan& plan) {
  std::string assumed;
  const DecisiveValue* before = nullptr;
  for (const DecisiveValue& value : plan.values) {
    if (value.state != ValueState::assumed) continue;
    const bool is_another = before != nullptr && before->kind == value.kind;
    assumed += is_another ? ", " : before != nullptr ? "; " : "";
    assumed += is_another ? with_amount(words, value, value.of) : value_words(words, value);
    before = &value;
  }
  if (assumed.empty()) return {};
  return words.say(plan.is_example ? "values.invented" : "values.assumed", assumed);
}

std::string basis_of(const Words& words, const CertifiedPlan& plan, bool is_certified) {
  std::string basis = is_certified ? verified_words(words, plan) + "." : "";
  if (const std::string assumed = assumed_sentence(words, plan); !assumed.empty())
    basis += (basis.empty() ? "" : " ") + assumed;
  return basis;
}

std::string basis_of(const Words& words, const CertifiedPlan& plan) {
  const bool is_certified =
      plan.availability
          ? plan.availability->certified && !plan.availability->is_impossible()
          : plan.certificate && plan.placement.has_selection() && plan.certificate->all_reached();
  return basis_of(words, plan, is_certified);
}

}  // namespace shelfbeam
