// Tests every sentence of a result once, as terminal and page show it: test/data/messages.txt. Other tests
// check values.

#include <numeric>
#include <regex>

#include "shelfbeam/report/messages/headline.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/proof_remarks.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/messages/reasons.hpp"
#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/messages/signals.hpp"
#include "shelfbeam/report/messages/summary.hpp"

#include "support/snapshot.hpp"
#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

const Words en = english();
constexpr auto alone = CommunicationModel::non_cooperative;
constexpr auto weighted = Combination::weighted;
using Shop = Supermarket;
using Changes = std::vector<std::function<void(Shop&)>>;

Placement of_units(std::size_t count, double bound, Status status, const PlacementProblem& problem = {}) {
  Placement placement;
  placement.problem = problem;
  placement.status = status;
  placement.selected.resize(count);
  std::iota(placement.selected.begin(), placement.selected.end(), 0U);
  placement.objective_value = 1000;
  placement.count_lower_bound = bound;
  placement.lower_bound = 900;
  return placement;
}

void put_at_one_point(Shop& s) {
  for (TransceiverColumn& unit : s.matrix.transceivers) unit.position = s.matrix.transceivers[0].position;
}

class Sentences {
 public:
  void heading(const std::string& text) { text_ += (text_.empty() ? "# " : "\n# ") + text + '\n'; }
  template <class... Parts>
  void say(const Parts&... parts) {
    ((text_ += parts, text_ += '\n'), ...);
  }
  // A sentence with its remarks, which have numbers; those that are known are only numbers.
  void say_all(std::string tone, const std::string& sentence, const std::vector<std::string>& remarks,
               std::vector<std::string>& known) {
    std::string new_ones;
    for (const std::string& remark : remarks) {
      if (remark.empty()) continue;
      const auto found = std::ranges::find(known, remark);
      tone += fmt::format(" {}", found - known.begin() + 1);
      if (found != known.end()) continue;
      known.push_back(remark);
      new_ones += fmt::format("\n  {} {}", known.size(), remark);
    }
    say("[" + tone + "] " + sentence + new_ones);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void say_selections(Sentences& to) {
  to.heading("selection");
  to.say(units_reach(en, 1) + " " + labels_reached(en, 1, 1),
         units_reach(en, 2) + " " + labels_reached(en, 1200, 1200));
  to.say(labels_reached(en, 3, 1200), no_selection_reaches(en, 12),
         "x" + std::string(failure_clause(en, {.redundant = true})));
  for (const SolvedBy& solver :
       {SolvedBy{Method::greedy}, SolvedBy{Method::search}, SolvedBy{Method::search, "cbc 2.10.8"},
        SolvedBy{Method::mip, "highs 1.10.0"}}) {
    Placement none;
    none.solver = solver;
    to.say(fmt::format("{}: '{}'", solver_text(en, solver), method_without_result(en, none)));
  }
}

void say_bounds(Sentences& to) {
  to.heading("bound");
  for (const Placement& placement :
       {of_units(4, 4, Status::optimal), of_units(4, 2.4, Status::stopped), of_units(4, 1, Status::stopped),
        of_units(4, 0, Status::stopped), of_units(4, 1, Status::optimal, {.combination = weighted})})
    to.say(terminal_bound(en, placement), page_bound(en, placement));
  for (const auto proof : {BoundProof::trivial, BoundProof::dual, BoundProof::log, BoundProof::branches,
                           BoundProof::search, BoundProof::solver})
    to.say(bound_proof_text(en, proof));
  Placement proven = of_units(2, 2, Status::optimal);
  to.say(proof_sentence(en, proven));
  proven.ties_settled = true;
  to.say(proof_sentence(en, proven), proof_sentence(en, of_units(2, 0, Status::stopped)));
  for (const auto status : {Status::optimal, Status::feasible, Status::infeasible, Status::stopped})
    to.say(status_name(en, status));
  to.heading("objective");
  const PlacementProblem links{.objective = Objective::links}, signal{.objective = Objective::signal};
  const PlacementProblem cost{.combination = weighted};
  const PlacementProblem both{.objective = Objective::effective_links, .combination = weighted, .share = 0.5};
  for (Placement placement : {of_units(2, 2, Status::optimal), of_units(2, 2, Status::optimal, links),
                              of_units(2, 1, Status::stopped, links), of_units(2, 2, Status::stopped, signal),
                              of_units(2, 1, Status::optimal, cost), of_units(2, 1, Status::stopped, both)}) {
    placement.unit_costs = placement.problem.share < 1;
    to.say(objective_name(en, placement.problem), objective_sentence(en, placement));
  }
}

void say_prices(Sentences& to) {
  to.heading("prices");
  const PlacementProblem spend{.combination = Combination::spend};
  Placement proven = of_units(4, 2, Status::optimal, spend), stopped = of_units(4, 2, Status::stopped, spend);
  proven.price = Price{"EUR", 2040, 1000};
  Placement count_open = stopped;
  count_open.lower_bound = count_open.objective_value;
  for (const Placement& placement : {proven, stopped, count_open})
    to.say(terminal_bound(en, placement), page_bound(en, placement));
  to.say(objective_name(en, spend), price_sentence(en, proven), "x" + price_sentence(en, stopped));
  proven.price->to_spend = 2040;
  to.say(price_sentence(en, proven), money(en, 1799.5, std::nullopt), money(en, 1234567, Price{"kr"}));
  for (const double bound : {0.0, 900.0, 1000.0}) {
    CertifiedPlan plan{proven};
    plan.placement.price->to_spend = 1000;
    Certificate& certificate = plan.certificate.emplace();
    certificate.labels.resize(12);
    for (LabelVerdict& label : certificate.labels) label.verdict = Verdict::reached;
    certificate.cost_lower_bound = bound;
    to.say(certificate_sentence(en, plan));
    plan.placement.price.reset();
    if (bound == 0) to.say(certificate_sentence(en, plan));
  }
}

void say_what_is_out_of_reach(Sentences& to) {
  to.heading("unreachable");
  for (const bool redundant : {false, true}) {
    Placement placement;
    placement.unreachable.resize(1200);
    placement.problem.redundant = redundant;
    to.say(terminal_out_of_reach(en, placement, false), terminal_out_of_reach(en, placement, true));
    placement.problem.model = alone;
    to.say(terminal_out_of_reach(en, placement, false));
  }
  to.say(no_signal_reason(en, {}, false), no_signal_reason(en, {.redundant = true}, true),
         no_signal_reason(en, {}, true));
  to.say(dark_labels(en, 1), dark_labels(en, 1200));
  Placement placement;
  to.say(conflict_sentence(en, placement), not_all_together(en, conflict_reason(en, placement, true)));
  placement.forbidden_pairs = 1;
  to.say(conflict_sentence(en, placement), conflict_reason(en, placement, false));
  placement.forbidden_pairs = 1200;
  placement.min_spacing = 2.5;
  to.say(conflict_sentence(en, placement), conflict_reason(en, placement, true));
}

void say_certificates(Sentences& to) {
  to.heading("certificate");
  const auto say = [&](const Placement& placement, std::size_t bound, const std::vector<std::size_t>& counts,
                       const std::optional<EndReason>& open = {}) {
    CertifiedPlan plan{placement};
    double count_bound = 0;
    Certificate& certificate = plan.certificate.emplace();
    certificate.confidence = open ? 0.995 : 0.99;
    (has_known_prices(placement.problem) ? certificate.cost_lower_bound : count_bound) =
        static_cast<double>(bound);
    certificate.count_lower_bound = static_cast<std::size_t>(count_bound);
    certificate.open = open;
    for (std::size_t verdict = 0; verdict < counts.size(); ++verdict)
      certificate.labels.insert(certificate.labels.end(), counts[verdict], {static_cast<Verdict>(verdict)});
    to.say(certificate_sentence(en, plan));
  };
  const PlacementProblem redundant{.redundant = true};
  Placement nothing;
  nothing.objective_value = std::numeric_limits<double>::infinity();
  to.say(certificate_sentence(en, {nothing}));
  say(of_units(4, 4, Status::optimal), 0, {1200, 0, 0});
  say(of_units(4, 4, Status::optimal, redundant), 4, {1200, 0, 0});
  say(of_units(1, 1, Status::optimal, redundant), 4, {1, 0, 0});
  say(of_units(4, 4, Status::optimal), 3, {1, 1, 2}, EndReason{EndCause::interrupted});
  say(of_units(4, 4, Status::optimal), 0, {3, 0, 0, 1}, EndReason{EndCause::interrupted});
  say(of_units(4, 4, Status::optimal), 0, {0, 0, 0, 450}, EndReason{EndCause::interrupted});
  say(nothing, 0, {0, 0, 0, 450}, EndReason{EndCause::interrupted});
  const PlacementProblem cost{.combination = weighted};
  say(of_units(4, 1, Status::optimal, cost), 1000, {1200, 0, 0});
  say(of_units(4, 1, Status::optimal, cost), 900, {1200, 0, 0});
  say(of_units(4, 1, Status::optimal, cost), 0, {1, 1, 2}, EndReason{EndCause::interrupted});
  say(of_units(4, 4, Status::optimal, {.objective = Objective::signal}), 4, {1200, 0, 0});
  say(of_units(4, 1, Status::optimal, {.objective = Objective::signal, .combination = weighted}), 0,
      {1200, 0, 0});
  say(nothing, 0, {1, 1, 2}, EndReason{EndCause::interrupted});
  say(nothing, 0, {0, 0, 4});
  to.heading("sensitivity");
  CertifiedPlan plan;
  Sensitivity& sensitivity = plan.sensitivity.emplace();
  sensitivity.as_given = {1.25, 0.0125, 3};
  sensitivity.low.min_margin.ratio = 1.0625;
  sensitivity.high.min_margin.ratio = 1.75;
  to.say(sensitivity_sentence(en, plan, 1200));
  plan.values = {{ValueKind::threshold, "standard", ValueState::assumed}};
  to.say(sensitivity_sentence(en, plan, 1200));
  plan.values.clear();
  sensitivity.low.missed = {7, 8, 9};
  sensitivity.low.undecided = {21};
  sensitivity.materials = {{"tiles <grey>", 0.6, 0.45, 0.75, true, {}, {}}};
  for (const double ratio : {1.25, 1.2}) {  // the first as if it had no range
    sensitivity.materials[0].at_lower.min_margin.ratio = ratio;
    to.say(sensitivity_sentence(en, plan, 926));
  }
}

// The end of a plan whose bound is below its value, by count, by price and by a sum, and its remedy.
void say_open_bounds(Sentences& to) {
  to.heading("open bound");
  const auto say = [&](const Placement& placement, double bound, const std::optional<EndReason>& open,
                       Verdict last = Verdict::reached, std::size_t installed = 0) {
    CertifiedPlan plan{placement};
    Certificate& certificate = plan.certificate.emplace();
    certificate.labels.resize(1186, {Verdict::reached});
    certificate.labels.back().verdict = last;
    if (has_known_prices(placement.problem)) certificate.cost_lower_bound = bound;
    certificate.count_lower_bound = static_cast<std::size_t>(bound);
    certificate.open = open;
    const auto [advice, settings] = remedy_for(en, plan);
    to.say(fmt::format("'{}' '{}' {}", open_bound(en, plan, installed), advice, settings.size()));
  };
  const auto of_count = [](double bound, Status status) { return of_units(11, bound, status); };
  const Placement stopped = of_count(9, Status::stopped), proven = of_count(11, Status::optimal);
  for (const EndReason& open : {EndReason{EndCause::budget},
                                {EndCause::proof_cost, 0, 9},
                                {EndCause::weak_bound},
                                {EndCause::signals_near},
                                {EndCause::interrupted},
                                {.cause = EndCause::labels_near, .leaves_cheaper = true}})
    say(stopped, 8, open);
  say(proven, 8, EndReason{EndCause::budget});
  say(of_count(9, Status::feasible), 9, EndReason{EndCause::weak_bound});
  say(stopped, 8, EndReason{EndCause::budget}, Verdict::reached, 3);
  const PlacementProblem spend{.combination = Combination::spend}, sum{.combination = weighted};
  Placement priced = of_units(11, 0, Status::stopped, spend);
  say(priced, 850, EndReason{EndCause::budget});
  priced.price = Price{"EUR", 1500, 1000};
  say(priced, 850.5, EndReason{EndCause::budget});
  priced.problem = sum;
  say(priced, 850.5, EndReason{EndCause::budget});
  priced.status = Status::optimal;
  say(priced, 850.5, EndReason{EndCause::budget});
  priced.problem.objective = Objective::signal;  // bounded for the simulated signals only
  say(priced, 0, EndReason{EndCause::budget});
  priced.status = Status::stopped;
  say(priced, 0, {});
  // Controls: a certified minimum, labels that are not certified, and a plan without a certificate.
  say(proven, 11, {});
  for (const Verdict last : {Verdict::undecided, Verdict::missed, Verdict::unverified})
    say(stopped, 8, EndReason{EndCause::budget}, last);
  say(stopped, 8, EndReason{EndCause::labels_near}, Verdict::undecided);
  for (const Placement& placement : {stopped, proven, of_count(9, Status::feasible)})
    to.say(fmt::format("'{}' '{}'", open_bound(en, {placement}), remedy_for(en, {placement}).advice));
}

// The remarks of the first page where the certificate proves less than the search, as much, and more, by
// count and by price.
void say_proofs_of_the_first_page(Sentences& to) {
  to.heading("first page");
  const PlacementProblem spend{.combination = Combination::spend}, sum{.combination = weighted};
  const auto say = [&](const std::function<void(Shop&)>& change) {
    Shop s;
    certify(s);
    set_verdicts(s, Verdict::reached);
    change(s);
    const auto [bound, confirmation] = proof_remarks(ReportData(s.input));
    to.say(fmt::format("{}{}{}", bound, bound.empty() ? "" : " ", confirmation));
  };
  for (const double simulated : {8.0, 6.0})
    for (const std::size_t certified : {8U, 7U, 6U, 5U})
      say([=](Shop& s) {
        if (simulated < 8) s.placement.status = Status::stopped;
        s.placement.count_lower_bound = simulated;
        s.plan.certificate->count_lower_bound = certified;
      });
  for (const PlacementProblem& problem : {spend, sum})
    for (const auto& bounds :
         {std::pair(1100.0, 1020.0), {1070.0, 1020.0}, {1020.0, 1070.0}, {1070.0, 1100.0}})
      say([=](Shop& s) {
        s.placement.problem = problem;
        s.placement.status = Status::stopped;
        s.placement.objective_value = 1100;
        s.placement.lower_bound = bounds.first;
        s.placement.price = Price{"EUR", 1100, 1100};
        s.plan.certificate->cost_lower_bound = bounds.second;
        s.plan.certificate->count_lower_bound = 0;
      });
  say([](Shop& s) { s.placement.status = Status::feasible, s.placement.count_lower_bound = 3; });
  say([](Shop& s) { s.plan.certificate->labels[3].verdict = Verdict::undecided; });
  say([](Shop& s) { s.plan.certificate->labels[3].verdict = Verdict::missed; });
  say([](Shop& s) { s.matrix.transceivers[s.placement.selected[0]].installed = true; });
  say([](Shop& s) {
    s.plan.certificate.reset();
    s.placement.status = Status::stopped, s.placement.count_lower_bound = 6;
  });
}

void find_nothing(Shop& s, Status status, std::vector<Unreachable> unreachable = {}) {
  s.placement = {};
  s.placement.status = status;
  s.placement.unreachable = std::move(unreachable);
}

// The headline on the page.
void say_headlines(Sentences& to) {
  to.heading("headline");
  constexpr const char* tones[] = {"yes", "open", "no"};
  const Unreachable weak{0, 1, 0.5}, dark{3, 1, 0};
  std::vector<std::string> known;
  for (const auto& change :
       Changes{[](Shop&) {},
               [](Shop& s) { s.placement.status = Status::stopped, s.placement.count_lower_bound -= 1.6; },
               [](Shop& s) { s.placement.status = Status::feasible, s.placement.count_lower_bound -= 1; },
               [](Shop& s) { s.placement.problem.objective = Objective::links; },
               [](Shop& s) { s.placement.problem.redundant = true; },
               [](Shop& s) { s.placement.min_spacing = 2.5, s.placement.forbidden_pairs = 1200; },
               [](Shop& s) { s.matrix.transceivers[s.placement.selected[0]].installed = true; },
               [](Shop& s) { certify(s); },
               [](Shop& s) { find_nothing(s, Status::infeasible), put_at_one_point(s); },
               [=](Shop& s) { find_nothing(s, Status::infeasible, {weak}), put_at_one_point(s); },
               [=](Shop& s) { find_nothing(s, Status::infeasible, {weak}); },
               [=](Shop& s) {
                 find_nothing(s, Status::infeasible, {weak});
                 s.placement.problem = {.model = alone, .redundant = true};
               },
               // There is some light, but if one unit may fail, the light of a single unit counts as none.
               [=](Shop& s) { find_nothing(s, Status::infeasible, {weak, dark}); },
               [=](Shop& s) {
                 find_nothing(s, Status::infeasible, {weak, dark});
                 for (std::size_t j = 0; j < s.matrix.columns(); ++j)
                   s.matrix.mean[s.matrix.at(dark.label, j)] = 0;
               },
               [](Shop& s) {
                 find_nothing(s, Status::stopped);
                 s.placement.solver = {Method::greedy}, s.placement.count_lower_bound = 2;
               },
               [](Shop& s) { find_nothing(s, Status::stopped), s.placement.seconds = 60; }}) {
    Shop s;
    change(s);
    const Headline line = headline(ReportData(s.input));
    to.say_all(tones[static_cast<std::size_t>(line.tone)], line.answer, line.remarks, known);
  }
}

void install(Shop& s, std::size_t units) {
  for (std::size_t k = 0; k < units; ++k) s.matrix.transceivers[s.placement.selected[k]].installed = true;
}

// A plan for a shop that changes: nothing is missed, except label 3 in 40 of 100 states by eight units.
void change_shop(Shop& s, bool is_certified) {
  Availability& found = s.plan.availability.emplace();
  const auto missed = [&](std::uint32_t count) { return std::vector(s.matrix.rows(), count); };
  found.required.assign(s.matrix.rows(), 0.95);
  found.nominal = {8, 100, missed(1), 60};
  found.nominal.missed[3] = 40;
  found.sample = {9, 100, missed(0), 0};
  found.sample_selected = {0};
  found.sample_value = 9;
  found.sample_lower_bound = 7;
  found.lower_bound = 6;
  found.examined = {{8, 300, missed(0), 0}};
  found.assumed.stocking = {0.4, 1.0};
  found.certified = is_certified;
  if (!is_certified) found.responsible = {3};
}

// A sum of prices between 290.0099 and 400 EUR, of which 200 EUR are for new units.
void leave_the_price_open(Shop& s, Combination combination) {
  s.placement.status = Status::stopped;
  s.placement.lower_bound = 290.0099;  // is rounded down
  s.placement.objective_value = 400;
  s.placement.price = Price{"EUR", 400, 200};
  s.placement.problem.combination = combination;
}

// Page 1, for those who decide.
void say_summaries(Sentences& to) {
  to.heading("summary");
  const std::vector<Unreachable> two{{3, 1, 0.5}, {4, 1, 0.5}};
  std::vector<std::string> known;
  for (const auto& change :
       Changes{[](Shop&) {}, [](Shop& s) { certify(s); },
               [](Shop& s) { certify(s), set_verdicts(s, Verdict::reached); },
               [](Shop& s) {
                 certify(s), set_verdicts(s, Verdict::reached);
                 s.plan.certificate->count_lower_bound = s.placement.count();
               },
               [](Shop& s) { certify(s), set_verdicts(s, Verdict::unverified); },
               [](Shop& s) { s.placement.price = Price{"EUR", 2040, 1800.5}; },
               [](Shop& s) { s.placement.price = Price{"EUR", 2040, 1800.5}, install(s, 1); },
               [](Shop& s) { install(s, 2); }, [](Shop& s) { install(s, s.placement.count()); },
               [](Shop& s) { install(s, s.placement.count()), certify(s); },
               [](Shop& s) { leave_the_price_open(s, weighted); },
               [](Shop& s) { leave_the_price_open(s, Combination::spend); },
               [](Shop& s) {  // nothing is bought
                 leave_the_price_open(s, Combination::spend), install(s, s.placement.count());
               },
               [](Shop& s) { change_shop(s, true); }, [](Shop& s) { change_shop(s, false); },
               [](Shop& s) {
                 s.plan.sensitivity.emplace().low.missed = {3, 4};
                 s.plan.warnings = {{FindingCode::other, {}, {}, "x"}};
               },
               [=](Shop& s) { find_nothing(s, Status::infeasible, two); },
               [=](Shop& s) {
                 find_nothing(s, Status::infeasible, two), certify(s), set_verdicts(s, Verdict::unverified);
                 s.plan.certificate->labels[3].verdict = Verdict::missed;
               },
               [](Shop& s) { find_nothing(s, Status::stopped), s.placement.count_lower_bound = 5; }}) {
    Shop s;
    change(s);
    const ReportData data(s.input);
    const Summary summary = summary_of(data);
    std::vector<std::string> sentences{recommendation(data)};
    for (const auto& list : {summary.remarks, summary.achieves, summary.risks})
      sentences.insert(sentences.end(), list.begin(), list.end());
    to.say_all(summary.verdict, summary.answer, sentences, known);
  }
}

// The weakest label has `ratio` times its requirement, all others twice that; with one unit more, all have
// `one_more` times as much.
void say_recommendations(Sentences& to) {
  to.heading("recommendation");
  Shop s;
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  const auto say = [&](double ratio, double one_more) {
    for (std::size_t i = 0; i < s.matrix.rows(); ++i)
      s.matrix.labels[i].requirement = outcome.labels[i].signal / (i == 0 ? ratio : 2 * ratio);
    s.plan.alternatives = {};
    if (one_more > 0) {
      Alternative& more = s.plan.alternatives.one_more.emplace();
      more.selected.resize(s.placement.count() + 1);
      more.smallest_margin = one_more;
    }
    to.say(fmt::format("{} {}: {}", ratio, one_more, recommendation(ReportData(s.input))));
  };
  // 1.3: the weakest label cannot lose a quarter of its signal. 0.9: labels are missed.
  for (const auto& [ratio, one_more] :
       {std::pair(1.4, 2.0), {1.3, 2.0}, {1.05, 1.4}, {1.05, 1.1}, {1.05, 0.0}, {0.9, 1.4}})
    say(ratio, one_more);
  certify(s), set_verdicts(s, Verdict::reached);
  say(1.4, 2.0);
  s.plan.certificate->labels.back().verdict = Verdict::undecided;
  say(1.4, 2.0);
}

// Of four labels in a shop that changes. Four units are enough for the shop as given, and a plan with six is
// certified.
void say_reasons(Sentences& to) {
  to.heading("reasons");
  Placement placement;
  placement.selected = {0, 1, 2, 3, 4, 5};
  Availability found;
  found.required = {0.95, 0.95, 0.95, 0.95};
  found.nominal = {4, 100, {50, 100, 0, 0}, 100};
  found.nominal_bound = 4;
  found.sample = found.nominal;
  found.examined = {{6, 300, {0, 0, 0, 0}, 0}};
  found.certified = true;
  found.lower_bound = 5;
  found.alone = {
      {"reflectance", {1}, 1, 5, 5, {}}, {"people", {0, 1}, 100, 6, 4, {}}, {"mounting", {}, 100, 4, 0, {}}};
  const auto say_rows = [&] {
    for (const ReasonRow& row : reason_rows(en, found, placement))
      to.say(fmt::format("{}|{}|{}", row.change, row.taken, row.units));
  };
  const auto name = [](std::uint32_t label) { return fmt::format("L{}", label); };
  const auto say = [&] {
    to.say("'" + states_recommendation(en, found, placement) + "'" + lost_sentence(en, found, name));
  };
  say_rows();
  say();
  found.lost = {{1, {"reflectance", "stock"}}, {3, {}}};
  EXPECT_EQ(cause_of_loss(en, found, 0), "");
  found.nominal.missed = {50, 100, 6, 5};
  say();
  found.alone[0].unreachable = {1};
  found.alone[1].units = 0;
  found.alone[2].lower_bound = std::numeric_limits<double>::infinity();
  say_rows();
  for (CauseAlone& cause : found.alone) cause.taken.clear();
  say();
  found.certified = false;
  found.nominal.missed = {0, 0, 0, 0};
  say();
  found.unreachable = {1};
  say();
}

void say_signals(Sentences& to) {
  to.heading("signals");
  const auto say = [&](const GivenSignals& given) {
    const std::string text = signals_text(en, given, 1186, 90, "old.h5");
    to.say(text.substr(0, text.find_last_not_of(' ') + 1));
  };
  say(ReusedSignals{1186, 90, 1});
  say(ReusedSignals{2000, 90, 1});
  for (const auto& [name, code] : names_of<Misfit>) {
    if (code != Misfit::labels && code != Misfit::transceivers) {
      say(MisfitReason{code});
      continue;
    }
    for (const std::size_t count : {1, 2000}) say(MisfitReason{code, MisfitReason::Missing{count, "A1"}});
  }
}

TEST(Messages, EqualTheSnapshot) {
  Sentences said;
  for (const auto say : {say_selections, say_bounds, say_prices, say_what_is_out_of_reach, say_certificates,
                         say_open_bounds, say_proofs_of_the_first_page, say_headlines, say_signals,
                         say_summaries, say_recommendations, say_reasons})
    say(said);
  expect_snapshot(said.text(), "messages.txt");
  // A manager need not know these terms. The confidence is named as on the other pages.
  const auto part = [&](const char* begin, const char* end) {
    const std::size_t at = said.text().find(begin);
    return said.text().substr(at, said.text().find(end, at) - at);
  };
  const std::vector<std::string> terms{"sampling",    "standard error", "bound",   "gap",      "certificate",
                                       "median",      "quantile",       "decibel", " dB",      "matrix",
                                       "cooperative", "lexicographic",  "optimal", "feasible", "election"};
  // The name of the option in the planner.
  const std::string summaries =
      std::regex_replace(part("# summary", "# reasons"), std::regex("budget of the certificate"), "");
  EXPECT_EQ(missing_in(summaries, terms), terms);
  EXPECT_LT(missing_in(part("# headline", "# signals"), terms).size(), terms.size()) << "the control";
}

TEST(Headline, CountsLabelsWithinSamplingError) {
  Shop s;
  const auto is_close = [&] {
    return headline(ReportData(s.input)).remarks[0].starts_with("At least one label is so close");
  };
  std::fill(s.matrix.standard_error.begin(), s.matrix.standard_error.end(), 0.0F);
  EXPECT_FALSE(is_close());

  // The standard error of the label with the smallest margin: half of the label's distance from the
  // requirement is just certain (with 1 % for the rounding to 32 bits), a little more is not.
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  const std::uint32_t row = outcome.by_margin.front();
  const LabelOutcome& label = outcome.labels[row];
  float& error = s.matrix.standard_error[s.matrix.at(row, *label.strongest)];
  error = static_cast<float>(0.495 * (label.signal - label.requirement));
  ASSERT_GT(error, 0);
  EXPECT_EQ(uncertain_labels(s.matrix, outcome), 0U);
  error = static_cast<float>(0.505 * (label.signal - label.requirement));
  EXPECT_EQ(uncertain_labels(s.matrix, outcome), 1U);
  EXPECT_TRUE(is_close());
  EXPECT_TRUE(Page(s.input).cells.contains("Not certified, 1 label uncertain"));
}

}  // namespace
}  // namespace shelfbeam::test
