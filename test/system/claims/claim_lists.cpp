#include <fmt/format.h>

#include "system/claims/claim_conditions.hpp"

namespace shelfbeam::test {

namespace {

std::vector<Claim> terminal() {
  std::vector<Claim> claims{
      {"cooperative, even if any one unit fails", {}, holds("redundant")},
      {"non-cooperative, even if any one unit fails", {}, holds("redundant")},
      {"(cooperative) ", {}, fails("redundant")},
      {"(non-cooperative) ", {}, fails("redundant")},
      {"No selection reaches", {}, holds("infeasible"), {nothing}},
      {"if any one unit fails ", {}, holds("redundant")},
      {"  chosen: {0}\n", {"?"}},
      {"{0}: maximum signal {1}, requirement {2}\n", {"?", "?", "?"}, holds("infeasible")},
      {"  and {0} more\n", {"?"}},
      {"  {0}: value {1}, lower bound {2}, gap {3} %; {4}\n",
       {"?", "~ objective", "< bound of objective", "?", "?"}},
      {"  infeasible; {0}\n", {"?"}, holds("infeasible")},
      {"  bound: {0}\n", {"?"}},
      {"  labels lost if one unit fails: {0}\n", {"?"}, [](T t) { return t("most dependent") > 0; }},
      {"  prices differ but are not considered in this order of objectives\n", {}},
      {"  no label depends on a single unit\n", {}, [](T t) { return t("most dependent") == 0; }},
      {"alternatives on the simulated signals:\n", {}, {}, {signals}},
      {"    every failure survived: not possible with these candidates\n", {}, holds("no survivor")},
  };
  const auto add = [&](const std::string& name, const std::string& value, const std::string& effect,
                       const std::vector<std::string>& places, const std::function<bool(T)>& is_true = {}) {
    for (const char* plural : {"", "s"})
      for (const bool has_price : {false, true}) {
        claims.push_back({fmt::format("{}: {{0}} transceiver{}{}; {}\n", name, plural,
                                      has_price ? ", new spend {1}" : "", effect),
                          {value + " units", value + " spend"},
                          is_true});
        claims.back().places.insert(claims.back().places.end(), places.begin(), places.end());
      }
  };
  const std::string fewer = "One unit fewer", more = "One unit more", survivor = "Survives any one failure";
  for (const char* name : {"one fewer", "fewer"}) {
    add(name, fewer, "{2} label{3} lost", {fewer + " lost", "?"}, holds("One unit fewer proven"));
    add(name, fewer, "{2} label{3} lost (at least {4})", {fewer + " lost", "?", fewer + " least lost"},
        fails("One unit fewer proven"));
  }
  add("one more ({5})", more,
      "the weakest label receives {2} times its requirement, {3} of {4} labels survive any failure",
      {"~ " + more + " weakest", more + " secure", "labels", "?"}, fails("threshold assumed"));
  add("one more ({4})", more, "{2} of {3} labels survive any failure", {more + " secure", "labels", "?"},
      holds("threshold assumed"));
  add("every failure survived", survivor, "proven minimum", {}, holds("Survives any one failure proven"));
  add("every failure survived", survivor, "not proven to be the minimum", {},
      fails("Survives any one failure proven"));
  return claims;
}

// Lines "Placement: Transceivers: 4" of the facts.
std::vector<Claim> facts() {
  const auto with_states = [](T t) { return t("over states") != 0; };
  return {
      {"Placement: Transceivers: {0}\n", {"units"}},
      {"Placement: Lower bound on the count: {0}\n", {"simulated units"}, fails("over states")},
      {"Placement: Lower bound on the count: {0}, with {1} confidence\n",
       {"simulated units", "confidence"},
       with_states},
      {"Placement: Gap of the count: {0}\n", {"% gap of units"}},
      {"Placement: Objective value: {0}\n", {"~ objective"}},
      {"Placement: Lower bound on the objective: {0}\n", {"< bound of objective"}, fails("over states")},
      {"Placement: Lower bound on the objective: {0}, with {1} confidence\n",
       {"< state bound", "confidence"},
       with_states},
      {"Placement: Gap of the objective: {0}\n", {"% gap"}},
      {"Certificate from independent samples: Joint confidence: {0}\n", {"confidence"}},
      {"Certificate from independent samples: Labels reached: {0} of {1}\n",
       {"confirmed", "labels"},
       holds("verified")},
      {"Certificate from independent samples: Labels reached: not verified yet\n", {}, fails("verified")},
      {"Certificate from independent samples: Missed: {0}: {1}\n", {"missed", "?"}},
      {"Certificate from independent samples: Missed: none\n", {}, [](T t) { return t("missed") == 0; }},
      {"Certificate from independent samples: Undecided: {0}: {1}\n", {"undecided", "?"}},
      {"Certificate from independent samples: Undecided: none\n",
       {},
       [](T t) { return t("undecided") == 0; }},
      {"Certificate from independent samples: Not verified yet: {0}: {1}\n", {"unverified", "?"}},
      {"Certificate from independent samples: Lower bound on the cost: {0}\n", {"< cost bound"}},
      {"Certificate from independent samples: Lower bound on the count: {0}\n", {"count bound"}},
      {"Certificate from independent samples: Lower bound: not examined\n",
       {},
       [](T t) { return t("cost bound") == 0 && t("count bound") == 0; }},
      {"Certificate from independent samples: Proven from: {0} label{1}\n", {"bound labels", "?"}},
  };
}

// Cells of the page's table of alternatives: "Alternatives, This plan, Units: 4".
std::vector<Claim> alternatives() {
  std::vector<Claim> claims;
  for (const char* choice :
       {"This plan", "One unit fewer", "Fewer units", "One unit more", "Survives any one failure"}) {
    const std::string name = choice, head = "Alternatives, " + name + ", ";
    const std::string value = name == "Fewer units" ? "One unit fewer" : name;
    claims.insert(claims.end(), {{head + "Units: {0}\n", {value + " units"}},
                                 {head + "Price of new units: {0}\n", {value + " spend"}},
                                 {head + "Labels reached: {0}\n", {value + " reached"}},
                                 {head + "Weakest label: {0} ×\n", {"~ " + value + " weakest"}},
                                 {head + "Safe labels: {0}\n", {value + " secure"}}});
  }
  const auto unproven = [](bool by_spend) {
    return [=](T t) { return !is(t, "Survives any one failure proven") && is(t, "by spend") == by_spend; };
  };
  for (const char* choice : {"One unit fewer", "Fewer units"})
    claims.push_back({fmt::format("Alternatives, {}, Labels reached: {{0}} (at most {{1}})\n", choice),
                      {"One unit fewer reached", "One unit fewer at most"},
                      fails("One unit fewer proven")});
  claims.push_back({"Alternatives, Survives any one failure, Units: {0} (or fewer)\n",
                    {"Survives any one failure units"},
                    unproven(false)});
  claims.push_back({"Alternatives, Survives any one failure, Price of new units: {0} (or less)\n",
                    {"Survives any one failure spend"},
                    unproven(true)});
  return claims;
}

std::vector<Claim> over_states() {
  const auto is_sample = [](bool by_spend, bool is_proven) {
    return [=](T t) { return is(t, "by spend") == by_spend && is(t, "sample holds") == is_proven; };
  };
  return {
      {"availability.goal.labels", {"required"}},
      {"availability.goal.types", {"required", "required most"}},
      {"availability.goal.shop", {"goal"}},
      {"availability.goal.misses", {"goal"}},
      {"availability.goal.none", {}},
      {"availability.nothing", {"@"}, fails("certified states")},
      {"availability.no_addition", {}, fails("certified states")},
      {"The best addition is {0} at ({1}) m. In {2} simulated states, without it",
       {"?", "?", "nominal states"},
       {},
       {without_addition}},
      {"with it", {}, {}, {with_addition}},
      {"availability.certified", {"@", "@", "@", "confidence"}, holds("certified states")},
      {"availability.sampled", {"@", "@", "@", "sample states"}, fails("certified states")},
      {"availability.open", {"units", "@", "@"}, fails("certified states")},
      {"availability.impossible", {"@", "?", "nominal states"}, holds("impossible"), {nothing}},
      {"availability.impossible_together", {"@", "nominal states"}, holds("impossible"), {nothing}},
      {"availability.ended", {"?"}},
      {"availability.responsible", {"?"}},
      {"availability.bound", {"< state bound", "confidence"}, fails("state bound holds")},
      {"availability.no_fewer", {"confidence"}, holds("state bound holds")},
      {"availability.spend_bound", {"< state bound", "confidence"}, holds("by spend")},
      {"availability.sample",
       {"sample units", "sample states"},
       [=](T t) { return is_sample(false, false)(t) && t("sample bound") == 0; }},
      {"availability.sample_at_least",
       {"sample units", "sample states", "sample bound"},
       is_sample(false, false)},
      {"availability.sample_spend",
       {"sample units", "sample states"},
       [=](T t) { return is_sample(true, false)(t) && t("sample bound") == 0; }},
      {"availability.sample_spend_at_least",
       {"sample units", "sample states", "< sample bound"},
       is_sample(true, false)},
      {"availability.sample_fewest", {"sample units", "sample states"}, is_sample(false, true)},
      {"availability.sample_cheapest", {"sample units", "sample states"}, is_sample(true, true)},
      {"availability.price", {"more to certify"}},
      {"availability.nominal.enough", {"nominal units"}, holds("nominal enough")},
      {"availability.nominal.not_enough", {"nominal units", "@"}, fails("nominal enough")},
      {"availability.outcome.labels", {"nominal below", "@", "< nominal worst", "< nominal all"}},
      {"availability.outcome.shop", {"< nominal all"}},
      {"availability.outcome.misses", {"~ nominal missed"}},
      {"availability.assumed", {"?"}},
      {"availability.left_out", {"?"}},
      {"recommendation.states.certified", {"units"}, holds("certified states")},
      {"recommendation.states.open", {"units"}, fails("certified states")},
      {"recommendation.states.enough", {}, holds("nominal enough")},
      {"recommendation.states.nominal", {"nominal units", "@"}, fails("nominal enough")},
      {"recommendation.states.labels", {"nominal below"}},
      {"recommendation.states.goal", {}, fails("nominal enough")},
      {"reasons.shares", {"?"}},
      {"reasons.only_together", {}},
      {"reasons.rest", {"?"}},
      {"reasons.lost", {"?"}},
      {"reasons.title", {}},
      {"reasons.line", {"?", "?", "?"}},
      {"reasons.line_mounted", {"?", "?"}},
      {"availability.scope", {}},
      {"availability.scope_as_given", {}},
      {"summary.answer.often", {"@", "@", "@"}, holds("certified states")},
      {"summary.answer.not_confirmed", {"@", "@", "@"}, fails("certified states")},
      {"summary.checked_states", {"answer states", "confidence"}, holds("certified states")},
      {"summary.risks.rarest", {"?"}},
  };
}

}  // namespace

std::vector<Claim> claims_of_lists() {
  std::vector<Claim> joined;
  for (const auto& part : {terminal(), facts(), alternatives(), over_states()})
    joined.insert(joined.end(), part.begin(), part.end());
  return joined;
}

}  // namespace shelfbeam::test
