#include <string_view>

#include <fmt/format.h>

#include "system/claims/claim_conditions.hpp"

namespace shelfbeam::test {

namespace {

// Sentences about the minimum that no confidence covers, on the first page.
bool is_open_on_signals(T t) {
  return !is(t, "simulated holds") && !is(t, "certified holds") && t("simulated") > t("certified");
}
bool is_open(T t) {
  return !is(t, "certified holds") && !is(t, "simulated holds") &&
         t("certified") >= t("simulated") * (1 - 1e-9);
}
bool is_proven_on_signals(T t) {
  return is(t, "simulated holds") && !is(t, "certified holds");
}
// A certified bound below the value, for which samples were needed.
bool is_certified_part(T t) {
  return is(t, "verified") && !is(t, "certified holds") && t("certified") > 0 && t("bound labels") > 0;
}

std::vector<Claim> counts_of_labels() {
  return {
      {"noun.label", {"labels"}},
      {"reach.units", {"units"}},
      // The number that is all depends on the subject.
      {"reach.all", {"reached"}},
      {"reach.some", {"labels", "reached"}},
      {"reach.none", {"@"}, holds("infeasible"), {nothing}},
      {"reach.failure", {}, holds("redundant")},
      {"reach.lost.candidates", {"out of reach"}, holds("infeasible")},
      {"reach.lost.candidates_failure", {"out of reach"}, holds("infeasible")},
      {"reach.lost.best", {"out of reach"}, holds("infeasible")},
      {"reach.lost.two", {"out of reach"}, holds("infeasible")},
      {"reach.lost_of.candidates", {"candidates", "out of reach", "@"}, holds("infeasible")},
      {"reach.lost_of.best", {"candidates", "out of reach", "@"}, holds("infeasible")},
      {"reach.lost_of.two", {"out of reach", "@"}, holds("infeasible")},
      {"reach.lost.options", {"out of reach"}, holds("infeasible")},
      {"reach.lost.options_failure", {"out of reach"}, holds("infeasible")},
      {"reach.lost_of.options", {"points", "out of reach", "@"}, holds("infeasible")},
      {"reach.dark", {"dark"}, [](T t) { return t("dark") > 0; }},
      {"reach.excluded", {"pairs"}},
      {"reach.excluded_because", {"pairs", "?"}},
      {"reach.greedy", {}},
  };
}

std::vector<Claim> proofs_on_signals() {
  const auto costs = [](T t) { return is(t, "by spend") && !is(t, "simulated holds"); };
  return {
      {"proof.needed", {"simulated units"}, fails("simulated units hold")},
      {"proof.fewer.any", {}, holds("simulated units hold")},
      {"it is proven that {0} is not enough", {"units less one"}, holds("simulated units hold")},
      {"it is proven that {0} are not enough", {"units less one"}, holds("simulated units hold")},
      {"proof.no_cheaper", {}, holds("simulated holds")},
      {"proof.no_cheaper_or_fewer", {}, [](T t) { return is(t, "optimal") && is(t, "by spend"); }},
      {"proof.costs", {"< simulated"}, costs},
      {"proof.gap", {"simulated units", "% gap of units"}, fails("simulated units hold")},
      {"proof.no_bound", {}, [](T t) { return t("simulated units") == 0; }},
      {"proof.price", {"total price"}},
      {"proof.price_both", {"new spend", "total price"}},
      {"proof.by", {"?"}},
      {"proof.ties", {}},
      {"objective.not_optimised", {"?"}},
      {"objective.unit_costs", {}},
      {"objective.total.plain", {"?", "~ objective"}, holds("by sum")},
      {"objective.total.proven", {"?", "~ objective"}, holds("optimal")},
      {"objective.total.stopped", {"?", "~ objective", "< bound of objective", "% gap"}, holds("stopped")},
      {"objective.secondary.plain", {"?", "~ objective"}},
      {"objective.secondary.proven", {"?", "~ objective"}, holds("optimal")},
      {"objective.secondary.stopped",
       {"?", "~ objective", "< bound of objective", "% gap"},
       holds("stopped")},
  };
}

std::vector<Claim> certificates() {
  const auto holds_part = [](T t) { return is(t, "verified") && !is(t, "certified holds"); };
  return {
      {"certificate.confidence", {"confidence"}},
      {"certificate.spend", {"new spend"}, holds("by spend")},
      {"certificate.cost", {"~ value"}, holds("by sum")},
      {"certificate.costs_at_least", {"< certified"}, holds_part},
      {"certificate.no_cheaper", {}, holds("certified holds")},
      {"certificate.at_least", {"certified"}, holds_part},
      {"certificate.fewer.any", {}, holds("certified holds")},
      {", and {0} is not enough", {"units less one"}, holds("certified holds")},
      {", and {0} are not enough", {"units less one"}, holds("certified holds")},
      {"certificate.missed", {"missed"}},
      {"certificate.undecided", {"undecided"}},
      {"certificate.unverified", {"unverified"}},
      {"certificate.without_cost", {}, holds("depends on signals")},
      {"certificate.without_objective", {"?"}, holds("depends on signals")},
      {"certificate.scope", {}, holds("certificate")},
      {"certificate.lacking", {}, fails("verified")},
      {"certificate.not_yet", {"@", "@", "@"}, fails("verified")},
      {"certificate.none_not_yet", {"@"}, fails("verified"), {nothing}},
      {"certificate.none_undecided",
       {"@"},
       [](T t) { return is(t, "verified") && t("missed") == 0; },
       {nothing}},
      {"at least {0} cannot be reached", {"missed"}, holds("infeasible")},
      {"certificate.ended", {"?"}, fails("settled")},
  };
}

std::vector<Claim> open_bounds() {
  const auto has_certificate = [](T t) { return is(t, "open") && is(t, "all reached") && is(t, "verified"); };
  const auto has_none = [](T t) { return is(t, "open") && !is(t, "verified"); };
  const auto may_decide = [](T t) { return is(t, "open") || !is(t, "all reached"); };
  std::vector<Claim> claims{{"open.certified", {"labels", "@"}, has_certificate},
                            {"open.uncertified", {"@"}, has_none}};
  for (const char* group : {"range", "only_signals"}) {
    const bool is_proven = std::string_view(group) == "only_signals";
    const auto holds_so_far = [=](T t) { return is(t, "open") && is(t, "simulated holds") == is_proven; };
    const std::string key = fmt::format("open.{}.", group);
    claims.insert(claims.end(), {{key + "fewer", {"open bound", "units"}, holds_so_far},
                                 {key + "fewer_new", {"open bound new", "new units"}, holds_so_far},
                                 {key + "cheaper", {"< open bound", "new spend"}, holds_so_far},
                                 {key + "sum", {"< open bound", "~ value"}, holds_so_far}});
  }
  for (const char* remedy : {"budget", "search", "both", "exact", "near"})
    claims.push_back({fmt::format("open.remedy.{}", remedy), {}, may_decide});
  return claims;
}

std::vector<Claim> headlines() {
  return {
      {"headline.spacing", {"?"}},
      {"headline.installed.all", {}, [](T t) { return t("installed") == t("units"); }},
      {"headline.installed", {"installed"}},
      {"headline.stopped", {}, holds("stopped")},
      {"headline.greedy", {}, holds("greedy")},
      {"headline.infeasible", {}, holds("infeasible"), {nothing}},
      {"headline.out_of_reach", {"@"}, holds("infeasible"), {nothing}},
      {"headline.remedies", {"?"}},
      {"headline.plans", {"?"}},
      {"headline.not_together", {"?"}, holds("infeasible"), {nothing}},
      {"headline.nothing.within", {}, holds("stopped")},
      {"headline.nothing.within_bound", {"@"}, holds("stopped")},
      {"headline.nothing.by", {"@"}, holds("stopped")},
      {"headline.nothing.by_bound", {"@", "@"}, holds("stopped")},
      {"headline.unknown.exact", {}},
      {"headline.unknown.time", {}},
      {"headline.unknown.mip", {}},
      {"headline.no_errors", {}},
      {"headline.simulated", {"@"}, holds("certificate"), {signals}},
      {"headline.close", {"?"}, fails("certificate")},
      {"headline.unverified", {"@"}, fails("certificate"), {signals}},
      {"headline.errors", {"?", "?", "?"}},
      {"headline.flagged", {"?", "?"}},
      {"sensitivity.margin", {"~ weakest dark", "~ weakest light"}, fails("threshold assumed")},
      {"sensitivity.largest", {"?"}},
      {"sensitivity.all",
       {"reached dark", "labels", "@", "@", "@", "missed dark", "undecided dark"},
       [](T t) { return t("lost dark") == 0; },
       {reflectances}},
      {"sensitivity.not_all",
       {"reached dark", "labels", "@", "@", "@", "missed dark", "undecided dark"},
       [](T t) { return t("lost dark") > 0; },
       {reflectances}},
  };
}

std::vector<Claim> first_page() {
  const auto greedy = [](T t) {
    return is(t, "greedy") && !is(t, "certified holds") && !is(t, "simulated holds");
  };
  const auto by_count = [](T t) { return !is(t, "by spend") && !is(t, "by sum"); };
  const auto confirms_all = [=](T t) {
    const bool claims_nothing = t("new units") == 0 || (t("simulated") == 0 && t("certified") == 0) ||
                                (by_count(t) && t("simulated new") < 1 && t("certified") == 0);
    return is(t, "all reached") && (is(t, "certified holds") || claims_nothing);
  };
  const auto all = [](T t) { return t("confirmed") == t("labels"); };
  const auto some = [](T t) { return t("confirmed") < t("labels"); };
  const auto is_certified_yes = [](T t) {
    return is(t, is(t, "over states") ? "certified states" : "all reached");
  };
  const auto known = fails("threshold assumed");  // so that a reserve has a meaning
  std::vector<Claim> claims{
      {"verdict.certified.yes.assumed", {}, [=](T t) { return is_certified_yes(t) && is(t, "any assumed"); }},
      {"verdict.certified.yes.given",
       {},
       [=](T t) { return is_certified_yes(t) && !is(t, "any assumed") && is(t, "any given"); }},
      {"verdict.certified.yes.confirmed",
       {},
       [=](T t) { return is_certified_yes(t) && !is(t, "any assumed") && !is(t, "any given"); }},
      {"values.assumed", {"?"}, [](T t) { return is(t, "any assumed") && !is(t, "example"); }},
      {"values.invented", {"?"}, [](T t) { return is(t, "any assumed") && is(t, "example"); }},
      {"recommendation.ample", {"~ weakest"}, known},
      {"recommendation.only", {"~ weakest"}, known},
      {"recommendation.this", {"~ weakest", "~ One unit more weakest"}, known},
      {"recommendation.more", {"One unit more units", "?", "~ weakest", "~ One unit more weakest"}, known},
      {"recommendation.confirm", {}, holds("threshold assumed")},
      {"verdict.certified.open",
       {},
       [](T t) {
         return is(t, "over states") ? !is(t, "certified states") : !is(t, "all reached") && t("missed") == 0;
       }},
      {"verdict.certified.no",
       {},
       [](T t) { return is(t, "over states") ? is(t, "impossible") : t("missed") > 0; }},
      {"verdict.uncertified.yes", {}, [](T t) { return !is(t, "certificate"); }},
      {"verdict.uncertified.uncertain",
       {"?"},
       [](T t) { return !is(t, "certificate") && is(t, "simulated holds"); }},
      {"verdict.uncertified.open", {}, [](T t) { return !is(t, "simulated holds"); }},
      {"verdict.uncertified.no", {}, holds("infeasible")},
      {"summary.answer.mount", {"new units"}},
      {"summary.answer.beside", {"installed", "@"}},
      {"summary.answer.nothing",
       {"installed"},
       [=](T t) {
         return t("new units") == 0 && (is(t, "over states") ? is(t, "certified states") : all(t));
       }},
      {"summary.answer.keep", {"installed"}, [](T t) { return t("new units") == 0; }},
      {"summary.answer.reaches_all", {"@", "labels", "@"}, all},
      {"summary.answer.reaches", {"@", "confirmed", "@", "@"}, some},
      {"summary.answer.confirmed",
       {"@", "confirmed", "@", "@"},
       [=](T t) { return some(t) && is(t, "verified"); }},
      {"summary.answer.even_if", {}, holds("redundant")},
      {"summary.price", {"new units", "new spend"}},
      {"summary.price_both", {"new units", "new spend", "total price"}},
      {"summary.bound.some.fewer", {"simulated new"}, is_open_on_signals},
      {"summary.bound.some.fewer_new", {"simulated new"}, is_open_on_signals},
      {"summary.bound.some.cheaper", {"< simulated"}, is_open_on_signals},
      {"summary.bound.some.sum", {"< simulated"}, is_open_on_signals},
      {"summary.bound.confirmed_some.fewer", {"certified new", "@"}, is_certified_part},
      {"summary.bound.confirmed_some.fewer_new", {"certified new", "@"}, is_certified_part},
      {"summary.bound.confirmed_some.cheaper", {"< certified", "@"}, is_certified_part},
      {"summary.bound.confirmed_some.sum", {"< certified", "@"}, is_certified_part},
      {"summary.confirms.this", {"confidence"}, confirms_all},
      {"summary.confirms.part", {"confidence", "@"}},
      {"summary.confirms.labels", {"?", "@"}},
      {"summary.checked", {"@"}, holds("verified"), {certificate}},
      {"summary.unchecked", {"@"}, fails("verified")},
      {"summary.not_examined", {}},
      {"summary.none.out_of_reach", {"@"}, holds("infeasible"), {nothing}},
      {"summary.none.not_together", {"?"}, holds("infeasible"), {nothing}},
      {"summary.none.infeasible", {}, holds("infeasible"), {nothing}},
      {"summary.none.not_found", {}, holds("stopped"), {nothing}},
      {"summary.none.bound", {"simulated units"}, holds("stopped")},
      {"summary.none.unknown", {}},
      {"summary.none.labels", {"?"}},
      {"summary.none.remedies", {}},
      {"summary.none.undecided", {}, [](T t) { return is(t, "verified") && t("missed") == 0; }},
      {"summary.none.checked", {"missed", "confidence"}, [](T t) { return t("missed") > 0; }},
      {"summary.achieves.weakest", {"?", "~ weakest"}, known},
      {"summary.achieves.weakest_short", {"?", "# weakest percent"}, known},
      {"summary.achieves.unknown", {}, holds("threshold assumed")},
      {"summary.risks.threshold", {}, holds("threshold assumed")},
      {"summary.achieves.secure_all", {"labels"}, [](T t) { return t("secure") == t("labels"); }},
      {"summary.achieves.secure", {"single", "secure"}},
      {"summary.risks.missed", {"missed", "?"}},
      {"summary.risks.undecided", {"undecided", "?"}},
      {"summary.risks.unverified", {"unverified"}},
      {"summary.risks.close", {"close"}, known},
      {"summary.risks.unit", {"most lost", "?"}},
      {"summary.risks.darker_holds", {}, [](T t) { return t("lost dark") == 0; }},
      {"summary.risks.darker", {"lost dark"}},
      {"summary.risks.stopped", {}, holds("stopped")},
      {"summary.risks.flagged", {"?"}},
      {"summary.risks.warnings", {"warnings"}},
  };
  for (const char* kind : {"fewer", "fewer_new", "cheaper", "sum"}) {
    const std::string name = kind;
    claims.push_back({"summary.bound.proven." + name, {}, is_proven_on_signals});
    claims.push_back({"summary.bound.certified." + name, {}, holds("certified holds")});
    claims.push_back({"summary.bound.open." + name, {}, is_open});
    claims.push_back({"summary.bound.confirmed." + name, {"@"}, holds("certified holds")});
    claims.push_back({"summary.bound.greedy." + name, {}, greedy});
  }
  return claims;
}

}  // namespace

const std::vector<Claim>& claims() {
  static const std::vector<Claim> all = [] {
    std::vector<Claim> joined;
    for (const auto& part : {counts_of_labels(), proofs_on_signals(), certificates(), open_bounds(),
                             headlines(), first_page(), claims_of_lists()})
      joined.insert(joined.end(), part.begin(), part.end());
    return joined;
  }();
  return all;
}

}  // namespace shelfbeam::test
