// Traces every sentence of a plan that names a bound, a count or a confidence to its value: on the terminal,
// on the page and in JSON, for certified bounds below, at and above those of the simulated signals. Page 1,
// terminal, batch and planner say the same of how well the values of a plan are known, and none of them
// claims a reserve on a threshold that is assumed.

#include "system/claims/claims.hpp"

#include <regex>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/report/batch/batch_report.hpp"
#include "shelfbeam/report/batch/store_result.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/recommendation.hpp"
#include "shelfbeam/report/messages/summary.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/terminal/plan_text.hpp"

#include "jobs/event.hpp"
#include "jobs/plan_summary.hpp"

namespace shelfbeam::test {
namespace {

using Json = nlohmann::json;
using testing::IsEmpty;

std::vector<std::string> faults_of(const std::vector<Text>& texts, const PlannedStore& store,
                                   ClaimReader& reader) {
  const Truth truth(store);
  std::vector<std::string> faults;
  for (const Text& one : texts)
    for (const std::string& fault : reader.faults(one.text, truth, one.subject))
      faults.push_back(fmt::format("{}: '{}' in '{}'", store.name, fault, one.text));
  return faults;
}

// The words of a text between its places.
std::string words_in(const Words& words, std::string_view key) {
  const std::string text(words(key));
  const std::regex place("[{][^}]*[}]");
  std::string longest;
  for (std::sregex_token_iterator part(text.begin(), text.end(), place, -1), end; part != end; ++part)
    if (static_cast<std::size_t>(part->length()) > longest.size()) longest = part->str();
  return longest;
}

// Sentences that put a reserve into words.
std::vector<std::string> reserves_in(const Words& words, const std::string& text) {
  std::vector<std::string> found;
  for (const char* key :
       {"recommendation.ample", "recommendation.only", "recommendation.this", "recommendation.more",
        "summary.achieves.title", "summary.achieves.weakest", "summary.achieves.weakest_short",
        "summary.risks.close.one", "summary.risks.close.many", "sensitivity.margin"})
    if (text.find(words_in(words, key)) != std::string::npos) found.emplace_back(key);
  // Of the terminal.
  for (const char* phrase : {"times its requirement", " ample ", "reserve for"})
    if (text.find(phrase) != std::string::npos) found.emplace_back(phrase);
  return found;
}

// What a result says in the places where it is shown.
struct Shown {
  std::string page, terminal, batch, planner;
  std::string badge;  // of page 1
};

Shown shown_of(PlannedStore& store, Language language) {
  store.scene.language = language;
  Shown shown;
  const ReportInput input{store.scene, store.matrix, store.plan};
  const ReportData data(input);
  const Summary summary = summary_of(data);
  shown.badge = summary.verdict;
  shown.page = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n", summary.verdict, summary.answer, summary.assumed, recommendation(data),
      data.words(store.plan.has_known_thresholds() ? "summary.achieves.title"
                                                   : "summary.achieves.title_without_reserve"));
  for (const auto& list : {summary.remarks, summary.achieves, summary.risks})
    for (const std::string& sentence : list) shown.page += sentence + "\n";
  const PlanText text = plan_text(store.plan, store.table);
  shown.terminal = fmt::format("{}\n{}\n{}\n{}{}", text.answer, text.basis, text.open, text.details,
                               describe(store.plan.alternatives, store.plan.placement, store.table,
                                        store.plan.has_known_thresholds()));
  jobs::PlanEnd end;
  static_cast<CertifiedPlan&>(end.plan) = store.plan;
  end.table = store.table;
  const jobs::PlanSummary result = jobs::summary_of(end);
  shown.planner = jobs::line_of(jobs::JobResult{result, true});
  StoreResult of_batch;
  static_cast<PlanNumbers&>(of_batch) = result;
  of_batch.status = StoreStatus::planned;
  shown.batch = batch_html(english(), std::vector{of_batch});
  return shown;
}

// What a result says of the values of a plan that are known in one of 8 ways.
struct SaidOfValues {
  std::set<std::string> badges, reserves;
  std::size_t assumed = 0;

  void expect_true(PlannedStore& store, Language language) {
    const CertifiedPlan& plan = store.plan;
    const Words words(language);
    const Shown shown = shown_of(store, language);
    const bool all = plan.availability ? plan.availability->certified
                                       : plan.certificate && plan.placement.has_selection() &&
                                             plan.certificate->all_reached();
    EXPECT_EQ(shown.badge == verified_words(words, plan), all) << shown.badge;
    if (all) badges.insert(shown.badge);
    const std::string english_badge = verified_words(english(), plan) + ".";
    const std::string sentence = assumed_sentence(english(), plan);
    for (const std::string* text : {&shown.terminal, &shown.planner, &shown.batch}) {
      EXPECT_EQ(text->find(english_badge) != std::string::npos, all);
      if (!sentence.empty()) {
        EXPECT_THAT(*text, testing::HasSubstr(text == &shown.batch ? escape(sentence) : sentence));
      }
    }
    EXPECT_THAT(shown.page, testing::HasSubstr(assumed_sentence(words, plan)));
    EXPECT_EQ(sentence.empty(), plan.weakest_state() != ValueState::assumed);
    if (plan.weakest_state() == ValueState::assumed) {
      EXPECT_NE(shown.badge, words("verdict.certified.yes.confirmed"));
    }
    assumed += plan.has_known_thresholds() ? 0 : 1;
    for (const std::string* text : {&shown.page, &shown.terminal, &shown.batch, &shown.planner})
      for (const std::string& claim : reserves_in(words, *text)) {
        reserves.insert(claim);
        EXPECT_TRUE(plan.has_known_thresholds()) << claim << " in " << *text;
      }
  }
};

// placement.json has the bounds of the matrix, and the certificate its own.
void expect_json(const PlannedStore& store) {
  const Json json = Json::parse(plan_json(store.plan, store.table));
  const Truth truth(store);
  const bool has_selection = store.plan.placement.has_selection();
  EXPECT_EQ(json["count"], truth("units"));
  EXPECT_EQ(json["labels"], truth("labels"));
  if (has_selection) {
    EXPECT_EQ(json["count_lower_bound"], truth("simulated units"));
    EXPECT_EQ(json["lower_bound"], truth("bound of objective"));
    EXPECT_NEAR(json["gap"], truth("gap"), 1e-12);
  }
  if (truth("certificate") == 0) return;
  const Json& certificate = json["certificate"];
  EXPECT_NEAR(certificate["confidence"], truth("confidence") / 100, 1e-12);
  EXPECT_EQ(certificate["count_lower_bound"], truth("count bound"));
  EXPECT_EQ(certificate["cost_lower_bound"], truth("cost bound"));
  EXPECT_EQ(certificate["missed"].size(), truth("missed"));
  EXPECT_EQ(certificate["undecided"].size(), truth("undecided"));
  EXPECT_EQ(certificate["not_verified_yet"].size(), truth("unverified"));
  if (truth("verified") != 0 && has_selection) {
    EXPECT_EQ(certificate["reached"], truth("confirmed"));
  }
}

// Pairings that no sentence provides for, because `certify` makes none of them.
void expect_possible(const CertifiedPlan& plan) {
  const Placement& placement = plan.placement;
  EXPECT_FALSE(plan.certificate && plan.availability);
  if (!plan.certificate) return;
  const Certificate& certificate = *plan.certificate;
  std::size_t verdicts = 0;
  for (const Verdict verdict : {Verdict::reached, Verdict::missed, Verdict::undecided, Verdict::unverified})
    verdicts += certificate.count(verdict);
  EXPECT_EQ(verdicts, certificate.labels.size());
  EXPECT_TRUE(placement.has_selection() || placement.status == Status::infeasible);
  if (!placement.has_selection()) {
    EXPECT_EQ(certificate.count(Verdict::reached), 0U);
    EXPECT_EQ(certificate.count_lower_bound + certificate.bound_labels, 0U);
    EXPECT_EQ(certificate.cost_lower_bound, 0);
    EXPECT_EQ(!certificate.open, certificate.count(Verdict::missed) > 0);
    return;
  }
  EXPECT_TRUE(has_known_prices(placement.problem) || certificate.cost_lower_bound == 0);
  EXPECT_TRUE(placement.problem.combination == Combination::lexicographic ||
              certificate.count_lower_bound == 0 || has_known_prices(placement.problem));
  if (!certificate.all_reached()) {
    EXPECT_TRUE(certificate.open);
    return;
  }
  EXPECT_LE(certificate.count_lower_bound, placement.count());
  EXPECT_LE(certificate.cost_lower_bound, placement.objective_value * (1 + 1e-9));
  const ValueBounds bounds = value_bounds(plan);
  if (!certificate.open && !depends_on_signals(placement.problem)) {
    EXPECT_TRUE(bounds.is_minimum(bounds.certified)) << bounds.certified;
  }
}

// Where a plan's certified bound is, compared with that of its matrix.
std::string relation_of(const PlannedStore& store) {
  const Truth truth(store);
  if (!store.plan.placement.has_selection()) return "no selection";
  if (truth("verified") == 0) return "not verified";
  const double certified = truth("certified"), simulated = truth("simulated");
  return certified < simulated * (1 - 1e-9) ? "below" : certified > simulated * (1 + 1e-9) ? "above" : "at";
}

// Texts of the catalogue that name a bound, a count or a confidence are in the table, or they are words,
// titles and columns without a claim.
TEST(Claims, ListAllTextsOfResults) {
  const std::set<std::string> groups{"verdict",     "summary", "headline",    "reach",
                                     "objective",   "proof",   "certificate", "availability",
                                     "sensitivity", "open",    "values",      "recommendation"};
  // Beginnings of keys without a claim. The table of alternatives is read cell by cell.
  const std::vector<std::string> without_claim{
      "summary.store", "summary.kicker", "summary.and_others", "summary.buy.", "summary.alternatives.",
      "summary.achieves.title", "summary.risks.title", "summary.drawing", "reach.conflict.", "reach.if.",
      "reach.no_signal.", "reach.search", "objective.sum.", "objective.name.", "proof.status.",
      "proof.method.", "proof.solver.", "availability.title", "availability.column.", "availability.plan.",
      "availability.causes.", "availability.cause", "availability.no_cause", "availability.note",
      "availability.at_risk", "availability.label", "availability.assumes.", "sensitivity.title",
      "sensitivity.range", "sensitivity.figure", "sensitivity.description", "sensitivity.bar",
      "sensitivity.together", "sensitivity.one", "sensitivity.as_given", "sensitivity.limit", "sensitivity.x",
      "sensitivity.key", "sensitivity.shown", "sensitivity.column.", "sensitivity.note",
      "sensitivity.watched", "sensitivity.assumed", "sensitivity.kept", "sensitivity.missed",
      "sensitivity.undecided",
      // With other numbers than {0}: in the table in their own words.
      "values.value", "values.kind.", "values.amount.", "recommendation.price", "recommendation.states.",
      "availability.addition", "certificate.fewer", "certificate.none", "proof.fewer"};
  std::set<std::string> listed;
  for (const Claim& claim : claims()) listed.insert(claim.key);
  const std::function<void(const Json&, const std::string&)> visit = [&](const Json& node,
                                                                         const std::string& key) {
    for (const auto& [name, value] : node.items()) {
      const std::string path = key.empty() ? name : fmt::format("{}.{}", key, name);
      if (key.empty() && !groups.contains(name)) continue;
      if (value.is_object() && !value.contains("many")) {
        visit(value, path);
        continue;
      }
      const auto begins = [&](const std::string& begin) { return path.starts_with(begin); };
      const std::string text = value.is_string() ? value.get<std::string>() : "";
      // "{0} {1}{2}, {3}." only joins other texts.
      const bool is_joint = !text.empty() && text.find_first_not_of("{0123456789} ,;.") == std::string::npos;
      EXPECT_TRUE(is_joint || listed.contains(path) ||
                  std::any_of(without_claim.begin(), without_claim.end(), begins))
          << path;
    }
  };
  visit(Json::parse(read_file(SHELFBEAM_SOURCE_DIR "/src/shelfbeam/report/text/english.json")), "");
}

// Runs `examine` for a plan with every pairing of bounds and verdicts that may occur.
void for_each_pairing(PlannedStore& store, const std::function<void()>& examine) {
  Placement& placement = store.plan.placement;
  Certificate& certificate = *store.plan.certificate;
  const bool by_cost = minimises_cost(placement.problem),
             is_certified = !by_cost || has_known_prices(placement.problem);
  const double value = by_cost ? placement.objective_value : static_cast<double>(placement.count());
  const double low = by_cost ? 0.613 * value : 1, middle = by_cost ? 0.8137 * value : value - 1;
  const std::vector<Verdict> others{Verdict::reached, Verdict::undecided, Verdict::missed,
                                    Verdict::unverified};
  const std::string name = store.name;
  for (const double simulated : {low, middle, value})
    for (const double certified : {0.0, low, middle, value})
      for (const Verdict other : others)
        for (const bool is_greedy : {false, true}) {
          placement.lower_bound = simulated;
          if (!by_cost) placement.count_lower_bound = simulated;
          placement.status = is_greedy            ? Status::feasible
                             : simulated == value ? Status::optimal
                                                  : Status::stopped;
          if (by_cost && is_greedy && simulated == value) continue;
          if (!by_cost) certificate.count_lower_bound = static_cast<std::size_t>(certified);
          if (by_cost && is_certified) certificate.cost_lower_bound = certified;
          certificate.bound_labels = certified > low ? 5 : 0;
          for (LabelVerdict& label : certificate.labels) label.verdict = Verdict::reached;
          certificate.labels[2].verdict = certificate.labels[3].verdict = other;
          const bool is_done = other == Verdict::reached && (certified == value || !is_certified);
          certificate.open = is_done ? std::nullopt : std::optional(EndReason{EndCause::budget});
          store.name = fmt::format("{}, value {}, simulated {}, certified {}, two labels {}", name, value,
                                   simulated, certified, to_text(other));
          examine();
        }
  store.name = name;
}

// Stores with at least three units: by count, with an installed unit, by spend, and by a sum of prices.
constexpr std::uint32_t stores_of_all_kinds[] = {24, 9, 49, 29};

TEST(ClaimsSlow, HoldForAllPairings) {
  ClaimReader reader;
  int pairings = 0;
  for (const std::uint32_t number : stores_of_all_kinds) {
    PlannedStore store = planned_store(number);
    PlacementProblem& problem = store.plan.placement.problem;
    ASSERT_TRUE(store.plan.certificate && store.plan.placement.count() >= 3) << store.name;
    const auto examine = [&] {
      ++pairings;
      for (const std::string& fault : faults_of(texts_of(store), store, reader)) ADD_FAILURE() << fault;
    };
    for_each_pairing(store, examine);
    if (number == 9) {
      for (SignalTable::Transceiver& unit : store.table.transceivers) unit.installed = false;
      for (TransceiverColumn& unit : store.matrix.transceivers) unit.installed = false;
      for_each_pairing(store, examine);
    }
    if (problem.combination != Combination::weighted) continue;
    problem.objective = Objective::signal;
    for_each_pairing(store, examine);
  }
  EXPECT_GT(pairings, 400);
}

void notice_wrong_numbers(const PlannedStore& store, ClaimReader& reader) {
  const Truth truth(store);
  std::size_t changed = 0;
  for (const Text& one : texts_of(store)) {
    std::vector<std::size_t> numbers;
    ASSERT_TRUE(reader.faults(one.text, truth, one.subject, &numbers).empty()) << one.text;
    for (const std::size_t at : numbers) {
      std::string wrong = with_plain_blanks(one.text);
      wrong[at] = wrong[at] == '9' ? '8' : static_cast<char>(wrong[at] + 1);
      EXPECT_FALSE(reader.faults(wrong, truth, one.subject).empty()) << wrong;
      ++changed;
    }
  }
  EXPECT_GT(changed, 20U) << store.name;
}

void notice_exchanged_bounds(PlannedStore store, ClaimReader& reader) {
  Placement& placement = store.plan.placement;
  Certificate& certificate = *store.plan.certificate;
  ASSERT_EQ(placement.problem.combination, Combination::spend);
  for (LabelVerdict& label : certificate.labels) label.verdict = Verdict::reached;
  placement.status = Status::stopped;
  placement.lower_bound = placement.objective_value - 10;
  certificate.cost_lower_bound = placement.objective_value - 60;
  certificate.bound_labels = 7;
  certificate.open = {EndCause::budget};
  EXPECT_THAT(faults_of(texts_of(store), store, reader), IsEmpty());
  const std::vector<Text> right = texts_of(store);
  std::swap(placement.lower_bound, certificate.cost_lower_bound);
  EXPECT_GE(faults_of(right, store, reader).size(), 4U) << "certificate, matrix, both remarks of page 1";
  std::swap(placement.lower_bound, certificate.cost_lower_bound);

  const Truth truth(store);
  const std::string least = money(english(), placement.lower_bound, placement.price);
  const std::string some = fmt::format(fmt::runtime(english()("summary.bound.some.cheaper")), least);
  const std::string confidence = fmt::format("{} %", truth("confidence"));
  const auto faults = [&](const std::string& confirmed) {
    return reader.faults(some + " " + english().say("summary.checked", confirmed), truth, Subject::signals);
  };
  EXPECT_EQ(faults(english().say("summary.confirms.this", confidence)).size(), 1U);
  const std::string all = fmt::format("all {} labels receive enough signal", truth("labels"));
  EXPECT_THAT(faults(english().say("summary.confirms.part", confidence, all)), IsEmpty());
  EXPECT_EQ(faults(english().say("summary.confirms.part", confidence,
                                 english().say("summary.bound.confirmed_some.cheaper", least, all)))
                .size(),
            1U);
  EXPECT_EQ(reader.faults("At most 3 are needed.", truth, Subject::signals).size(), 1U) << "not in the table";
}

// Of a plan with known thresholds, each sentence that claims a reserve is wrong if the threshold is assumed,
// and so is a plain badge. Adds the numbers of both.
void notice_reserves(PlannedStore store, ClaimReader& reader, std::size_t& reserves, std::size_t& badges) {
  know_values(3, store.plan);
  const std::vector<Text> texts = texts_of(store);
  const Truth confirmed(store);
  know_values(2, store.plan);
  const Truth assumed(store);
  for (const Text& one : texts) {
    EXPECT_TRUE(reader.faults(one.text, confirmed, one.subject).empty()) << one.text;
    const bool is_badge = one.text.starts_with("Verified");
    const bool is_reserve = !reserves_in(english(), one.text).empty();
    EXPECT_EQ(!reader.faults(one.text, assumed, one.subject).empty(), is_badge || is_reserve) << one.text;
    reserves += is_reserve ? 1 : 0;
    badges += is_badge ? 1 : 0;
  }
}

// The control: wrong numbers, exchanged bounds, and sentences that claim too much are noticed.
TEST(Claims, AreNoticedIfTheyAreWrong) {
  ClaimReader reader;
  std::size_t reserves = 0, badges = 0;
  for (const std::uint32_t number : stores_of_all_kinds) {
    const PlannedStore store = planned_store(number);
    notice_wrong_numbers(store, reader);
    notice_reserves(store, reader, reserves, badges);
    if (number == 49) notice_exchanged_bounds(store, reader);
  }
  EXPECT_GE(reserves, 5U);
  EXPECT_GE(badges, 3U);
}

TEST(ClaimsSlow, OfSixtyStores) {
  ClaimReader reader;
  std::map<std::string, int> relations;
  SaidOfValues of_values;
  constexpr std::uint32_t stores_of_values = 30, ways = 8;
  for (std::uint32_t number = 0; number < 60; ++number) {
    PlannedStore store = planned_store(number);
    SCOPED_TRACE(store.name);
    ++relations[relation_of(store)];
    for (const std::string& fault : faults_of(texts_of(store), store, reader)) ADD_FAILURE() << fault;
    expect_json(store);
    expect_possible(store.plan);
    for (std::uint32_t way = 0; way < ways && number < stores_of_values; ++way)
      for (const Language language : {Language::english, Language::german}) {
        SCOPED_TRACE(fmt::format("way {}, {}", way, to_text(language)));
        know_values(way, store.plan);
        of_values.expect_true(store, language);
      }
  }
  for (const char* relation : {"below", "at", "above"}) {
    EXPECT_GE(relations[relation], 5) << relation;
    RecordProperty(relation, relations[relation]);
  }
  EXPECT_GE(relations["no selection"], 2);
  EXPECT_GE(relations["not verified"], 2);
  EXPECT_EQ(of_values.badges.size(), 6U) << "three states in two languages";
  EXPECT_EQ(of_values.assumed, stores_of_values * 2 * 2U);
  EXPECT_GE(of_values.reserves.size(), 6U)
      << "the control: where a threshold is known, reserves are put into words";
}

// A plan over states, by count and by spend, with every pairing of a certified plan, its bound, and the bound
// on the sampled states.
TEST(ClaimsSlow, HoldForAllPairingsOverStates) {
  ClaimReader reader;
  PlannedStore store = planned_for_states();
  Placement& placement = store.plan.placement;
  Availability& found = *store.plan.availability;
  const auto examine = [&] {
    for (const std::string& fault : faults_of(texts_of(store), store, reader)) ADD_FAILURE() << fault;
  };
  examine();
  expect_possible(store.plan);
  ASSERT_TRUE(found.has_answer() && !found.is_impossible());
  for (const bool by_spend : {false, true}) {
    if (by_spend) put_prices(store);
    const auto part_of = [&](double whole) { return by_spend ? 0.7 * whole : std::floor(0.7 * whole); };
    const double value = placement.objective_value, sample = found.sample_value;
    for (const double bound : {0.0, part_of(value), value})
      for (const double of_sample : {0.0, part_of(sample), sample})
        for (const bool is_certified : {true, false}) {
          store.name = fmt::format("shop, value {}, bound {}, of the sample {}, certified {}", value, bound,
                                   of_sample, is_certified);
          found.certified = is_certified;
          found.lower_bound = placement.lower_bound = bound;
          placement.count_lower_bound = by_spend ? 0 : bound;
          found.sample_lower_bound = of_sample;
          examine();
        }
  }
  store.name = "shop without a possible placement";
  found.certified = false;
  found.examined.clear();
  found.sample = {};
  found.sample_selected.clear();
  found.unreachable = {1};
  found.sample_lower_bound = std::numeric_limits<double>::infinity();
  found.lower_bound = placement.lower_bound = placement.count_lower_bound = 0;
  examine();
}

}  // namespace
}  // namespace shelfbeam::test
