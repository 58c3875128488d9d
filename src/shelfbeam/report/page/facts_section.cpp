#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/headline.hpp"
#include "shelfbeam/report/messages/light.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/proof_remarks.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

namespace shelfbeam {

namespace {

// A list of facts. Its title and the names of the facts are keys of the text catalogue.
class Facts {
 public:
  Facts(const Words& words, std::string_view title)
      : words_(words), html_(fmt::format("<div><h3>{}</h3>\n<dl>\n", escape(words_(title)))) {}
  void add(std::string_view key, const std::string& value) { add_named(words_.say(key), value); }
  void add_named(const std::string& name, const std::string& value) {
    html_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(value.empty() ? "–" : value));
  }
  std::string html() const { return html_ + "</dl></div>\n"; }

 private:
  const Words& words_;
  std::string html_;
};

std::string range(const Words& words, std::uint64_t smallest, std::uint64_t largest) {
  return smallest == largest ? words.grouped(smallest)
                             : words.say("facts.range", words.grouped(smallest), words.grouped(largest));
}

double share_of(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

std::string part_and_share(const Words& words, std::size_t part, std::size_t all) {
  return words.say("facts.part_share", words.grouped(part), words.grouped(all),
                   words.percent(share_of(part, all)));
}

// Over states, the bounds hold with a confidence.
std::string bound_text(const ReportData& data, const std::string& bound) {
  const auto& availability = data.input.plan.availability;
  return availability ? data.words.say("facts.with_confidence", bound,
                                       confidence_percent(data.words, availability->confidence))
                      : bound;
}

void add_bounds(Facts& facts, const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  facts.add("facts.placement.units", data.words.grouped(placement.count()));
  if (placement.partial) return;
  facts.add("facts.count_bound", bound_text(data, data.words.grouped(proven_count(placement))));
  facts.add("facts.placement.count_gap", data.words.percent(count_gap(placement)));
  // With the count as the only objective, these rows would repeat the rows above.
  if (placement.problem.objective != Objective::count || minimises_cost(placement.problem)) {
    facts.add("facts.placement.value", data.words.plain(placement.objective_value));
    facts.add("facts.placement.bound", bound_text(data, data.words.plain_down(placement.lower_bound)));
    facts.add("facts.placement.gap", data.words.percent(placement.gap()));
  }
  facts.add("facts.placement.twice",
            part_and_share(data.words, data.outcome.redundant, data.outcome.labels.size()));
}

std::string placement_facts(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const PlacementProblem& problem = placement.problem;
  Facts facts(data.words, "facts.placement.title");
  facts.add("facts.placement.model",
            data.words.say(fmt::format("facts.placement.models.{}", to_text(problem.model))));
  facts.add("facts.placement.objective", objective_name(data.words, problem));
  if (words_of(problem.objective).has_share)
    facts.add("facts.placement.link",
              data.words.say("facts.placement.link_share", data.words.percent(problem.share, 0)));
  if (problem.redundant) facts.add("facts.placement.failure", data.words.say("facts.placement.redundant"));
  if (placement.min_spacing > 0)
    facts.add("facts.placement.spacing", data.words.plain(placement.min_spacing) + "\u00A0m");
  if (placement.min_spacing > 0 || placement.forbidden_pairs > 0)
    facts.add("facts.placement.pairs", data.words.grouped(placement.forbidden_pairs));
  if (!data.input.plan.certificate && !data.input.plan.availability)
    facts.add("facts.certificate.title", data.words.say("facts.certificate.none"));
  facts.add("facts.placement.status", std::string(status_name(data.words, placement.status)));
  if (placement.status != Status::infeasible) {
    facts.add("facts.placement.proof", std::string(bound_proof_text(data.words, placement.bound_proof)));
    facts.add("facts.placement.ties",
              data.words.say(placement.ties_settled ? "facts.placement.settled" : "facts.placement.open"));
  }
  facts.add("facts.placement.solver", solver_text(data.words, placement.solver));
  if (data.has_selection())
    add_bounds(facts, data);
  else if (placement.status != Status::infeasible)
    facts.add("facts.count_bound", data.words.grouped(proven_count(placement)));
  return facts.html();
}

// "none", or the number of labels with their names or places.
std::string named_labels(const ReportData& data, Verdict verdict) {
  const auto& labels = data.input.plan.certificate->labels;
  std::vector<LabelId> rows;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i].verdict == verdict) rows.push_back(i);
  if (rows.empty()) return data.words.say("facts.certificate.none");
  return fmt::format("{}: {}", data.words.grouped(rows.size()), data.names.list(rows));
}

std::string certificate_facts(const ReportData& data) {
  if (!data.input.plan.certificate) return {};
  const Certificate& certificate = *data.input.plan.certificate;
  Facts facts(data.words, "facts.certificate.title");
  facts.add("facts.certificate.confidence", confidence_percent(data.words, certificate.confidence));
  facts.add("facts.certificate.reached",
            certificate.none_verified()
                ? data.words.say("facts.certificate.not_yet")
                : data.words.say("facts.part", data.words.grouped(certificate.count(Verdict::reached)),
                                 data.words.grouped(certificate.labels.size())));
  facts.add("facts.certificate.missed", named_labels(data, Verdict::missed));
  facts.add("facts.certificate.undecided", named_labels(data, Verdict::undecided));
  if (certificate.count(Verdict::unverified) > 0)
    facts.add("facts.certificate.unverified", named_labels(data, Verdict::unverified));
  if (certificate.cost_lower_bound > 0)
    facts.add("facts.certificate.cost_bound", data.words.plain_down(certificate.cost_lower_bound));
  if (certificate.count_lower_bound > 0)
    facts.add("facts.count_bound", data.words.grouped(certificate.count_lower_bound));
  if (certificate.bound_labels > 0)
    facts.add("facts.certificate.from", data.words.say_count("noun.label", certificate.bound_labels));
  if (certificate.count_lower_bound == 0 && certificate.cost_lower_bound == 0)
    facts.add("facts.certificate.bound", data.words.say("facts.certificate.no_bound"));
  facts.add("facts.certificate.rounds", data.words.grouped(certificate.rounds));
  if (certificate.open) facts.add("facts.certificate.ended", end_text(data.words, *certificate.open));
  return facts.html();
}

void add_errors(Facts& facts, const ReportData& data) {
  const SamplingSummary& s = data.sampling;
  facts.add("facts.simulation.errors", data.words.say("facts.simulation.averages", data.words.percent(s.mean),
                                                      data.words.percent(s.median)));
  facts.add("facts.simulation.p90", data.words.percent(s.p90));
  facts.add("facts.simulation.p99", data.words.percent(s.p99));
  facts.add("facts.simulation.largest", data.words.percent(s.worst));
  if (s.has_flags)
    facts.add("facts.simulation.flagged",
              data.words.say("facts.share", data.words.grouped(s.flagged),
                             data.words.percent(share_of(s.flagged, s.relevant))));
  if (s.has_flags && data.has_selection())
    facts.add("facts.simulation.flagged_labels", data.words.grouped(data.outcome.flagged_labels));
}

std::string simulation_facts(const ReportData& data) {
  const SamplingSummary& s = data.sampling;
  const SignalMatrix& matrix = data.input.matrix;
  Facts facts(data.words, "facts.simulation.title");
  facts.add("facts.simulation.size",
            data.words.grouped(matrix.rows()) + " × " + data.words.grouped(matrix.columns()));
  if (data.has_options()) facts.add("facts.simulation.points", data.words.grouped(data.mounting_points));
  const bool has_more = data.input.plan.certificate && s.min_samples < s.max_samples;
  const std::string samples = range(data.words, s.min_samples, s.max_samples);
  facts.add("facts.simulation.samples",
            has_more ? data.words.say("facts.simulation.more", samples) : samples);
  facts.add("facts.simulation.batches", range(data.words, s.min_batches, s.max_batches));
  facts.add("facts.simulation.estimator", matrix.provenance.estimator);
  facts.add("facts.simulation.wavelength", data.words.plain(matrix.wavelength_nm) + "\u00A0nm");
  facts.add("facts.simulation.zeros", part_and_share(data.words, s.zeros, s.entries));
  facts.add_named(data.words.say("facts.simulation.relevant", data.words.percent(relevant_share, 0)),
                  data.words.grouped(s.relevant));
  if (!s.has_errors)
    facts.add("facts.simulation.no_errors", data.words.say("facts.simulation.missing"));
  else if (s.relevant > 0)
    add_errors(facts, data);
  return facts.html();
}

std::string origin_facts(const ReportData& data) {
  const Scene& scene = data.input.scene;
  const Provenance& provenance = data.input.matrix.provenance;
  Facts facts(data.words, "facts.origin.title");
  if (scene.room) {
    const Vec3 size = scene.room->upper() - scene.room->lower();
    facts.add("facts.origin.room", data.words.say("facts.origin.size", data.words.plain(size.x),
                                                  data.words.plain(size.y), data.words.plain(size.z)));
  }
  facts.add("facts.origin.fixtures", data.words.grouped(scene.fixtures.size() - scene.inner_walls()));
  if (scene.inner_walls() > 0) facts.add("facts.origin.inner_walls", data.words.grouped(scene.inner_walls()));
  if (scene.room && !scene.room->zones.empty())
    facts.add("facts.origin.zones", data.words.grouped(scene.room->zones.size()));
  for (const LabelType& type : scene.label_types)
    facts.add_named(data.words.say("facts.origin.type", type.name),
                    data.words.say("facts.origin.requirement", data.unit.text(type.requirement())));
  const std::uint64_t seed = data.input.plan.seed.value_or(provenance.seed);
  facts.add("facts.origin.seed", seed == provenance.seed
                                     ? fmt::format("{}", seed)
                                     : data.words.say("facts.origin.seeds", fmt::format("{}", seed),
                                                      fmt::format("{}", provenance.seed)));
  facts.add("facts.origin.program",
            provenance.program_version.empty() ? "" : "shelfbeam " + provenance.program_version);
  facts.add("facts.origin.hash", provenance.store_hash);
  return facts.html();
}

// Empty without items.
std::string list(const Words& words, std::string_view title, std::string_view note,
                 const std::vector<std::string>& items) {
  if (items.empty()) return "";
  return fmt::format("<h3>{}</h3>\n<p>{}</p>\n", escape(words(title)), escape(words(note))) +
         html_list(items);
}

}  // namespace

std::string facts_section(const ReportData& data) {
  const Headline line = headline(data);
  std::string html = paragraph(line.answer);
  for (const std::string& remark : line.remarks) html += paragraph(remark, "remark");
  html += "<div class=\"facts\">\n" + placement_facts(data) + certificate_facts(data) +
          simulation_facts(data) + origin_facts(data) + "</div>\n";
  const Scene& scene = data.input.scene;
  html += list(data.words, "facts.uncovered.title", "facts.uncovered.note",
               light_texts(data.words, uncovered_light(scene), scene));
  html += list(data.words, "facts.chance.title", "facts.chance.note",
               light_texts(data.words, chance_light(scene), scene));
  return html_section("facts", data.words.say("facts.title"), html);
}

}  // namespace shelfbeam
