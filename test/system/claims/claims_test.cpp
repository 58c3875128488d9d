// Traces every sentence of a plan that names a bound, a count or a confidence to its value: on the terminal,
// on the page and in JSON, for certified bounds below, at and above those of the simulated signals.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "system/claims/planned_stores.hpp"
#include "system/claims/sentences.hpp"
#include "system/claims/texts.hpp"

namespace shelfbeam {
namespace {

using Json = nlohmann::json;
using test::ClaimReader;
using test::PlannedStore;
using test::Subject;
using test::Text;
using test::texts_of;
using test::Truth;

std::vector<std::string> faults_of(const std::vector<Text>& texts, const PlannedStore& store,
                                   ClaimReader& reader) {
  const Truth truth(store);
  std::vector<std::string> faults;
  for (const Text& one : texts)
    for (const std::string& fault : reader.faults(one.text, truth, one.subject))
      faults.push_back(fmt::format("{}: '{}' in '{}'", store.name, fault, one.text));
  return faults;
}

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
  for (const test::Claim& claim : test::claims()) listed.insert(claim.key);
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
    PlannedStore store = test::planned_store(number);
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

// The control: wrong numbers, exchanged bounds, and a sentence that claimed too much are noticed.
TEST(Claims, NoticeWrongNumbers) {
  ClaimReader reader;
  for (const std::uint32_t number : stores_of_all_kinds) {
    const PlannedStore store = test::planned_store(number);
    const Truth truth(store);
    std::size_t changed = 0;
    for (const Text& one : texts_of(store)) {
      std::vector<std::size_t> numbers;
      ASSERT_TRUE(reader.faults(one.text, truth, one.subject, &numbers).empty()) << one.text;
      for (const std::size_t at : numbers) {
        std::string wrong = test::with_plain_blanks(one.text);
        wrong[at] = wrong[at] == '9' ? '8' : static_cast<char>(wrong[at] + 1);
        EXPECT_FALSE(reader.faults(wrong, truth, one.subject).empty()) << wrong;
        ++changed;
      }
    }
    EXPECT_GT(changed, 20U) << store.name;
  }
}

TEST(Claims, NoticeExchangedBounds) {
  ClaimReader reader;
  PlannedStore store = test::planned_store(49);
  Placement& placement = store.plan.placement;
  Certificate& certificate = *store.plan.certificate;
  ASSERT_EQ(placement.problem.combination, Combination::spend);
  for (LabelVerdict& label : certificate.labels) label.verdict = Verdict::reached;
  placement.status = Status::stopped;
  placement.lower_bound = placement.objective_value - 10;
  certificate.cost_lower_bound = placement.objective_value - 60;
  certificate.bound_labels = 7;
  certificate.open = {EndCause::budget};
  EXPECT_EQ(faults_of(texts_of(store), store, reader), std::vector<std::string>());
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
  EXPECT_EQ(faults(english().say("summary.confirms.part", confidence, all)), std::vector<std::string>());
  EXPECT_EQ(faults(english().say("summary.confirms.part", confidence,
                                 english().say("summary.bound.confirmed_some.cheaper", least, all)))
                .size(),
            1U);
  EXPECT_EQ(reader.faults("At most 3 are needed.", truth, Subject::signals).size(), 1U) << "not in the table";
}

TEST(ClaimsSlow, OfSixtyStores) {
  ClaimReader reader;
  std::map<std::string, int> relations;
  for (std::uint32_t number = 0; number < 60; ++number) {
    const PlannedStore store = test::planned_store(number);
    SCOPED_TRACE(store.name);
    ++relations[relation_of(store)];
    for (const std::string& fault : faults_of(texts_of(store), store, reader)) ADD_FAILURE() << fault;
    expect_json(store);
    expect_possible(store.plan);
  }
  for (const char* relation : {"below", "at", "above"}) {
    EXPECT_GE(relations[relation], 5) << relation;
    RecordProperty(relation, relations[relation]);
  }
  EXPECT_GE(relations["no selection"], 2);
  EXPECT_GE(relations["not verified"], 2);
}

// A plan over states, by count and by spend, with every pairing of a certified plan, its bound, and the bound
// on the sampled states.
TEST(ClaimsSlow, HoldForAllPairingsOverStates) {
  ClaimReader reader;
  PlannedStore store = test::planned_for_states();
  Placement& placement = store.plan.placement;
  Availability& found = *store.plan.availability;
  const auto examine = [&] {
    for (const std::string& fault : faults_of(texts_of(store), store, reader)) ADD_FAILURE() << fault;
  };
  examine();
  expect_possible(store.plan);
  ASSERT_TRUE(found.has_answer() && !found.is_impossible());
  for (const bool by_spend : {false, true}) {
    if (by_spend) test::put_prices(store);
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
}  // namespace shelfbeam
