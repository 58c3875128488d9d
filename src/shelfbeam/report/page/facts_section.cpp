#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/transport/world/coverage.hpp"

namespace shelfbeam {

namespace {

class Facts {
 public:
  explicit Facts(const std::string& heading)
      : html_(fmt::format("<div><h3>{}</h3>\n<dl>\n", escape(heading))) {}
  void add(const std::string& name, const std::string& value) {
    html_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(value.empty() ? "–" : value));
  }
  std::string html() const { return html_ + "</dl></div>\n"; }

 private:
  std::string html_;
};

std::string range(std::uint64_t smallest, std::uint64_t largest) {
  return smallest == largest ? grouped(smallest) : grouped(smallest) + " to " + grouped(largest);
}

double share_of(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

std::string placement_facts(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const PlacementProblem& problem = placement.problem;
  Facts facts("Placement");
  facts.add("Model", std::string(to_text(problem.model)));
  facts.add("Objective", objective_name(problem));
  if (words_of(problem.objective).has_share)
    facts.add("Effective link", "at least " + percent(problem.share, 0) + " of the requirement");
  if (problem.redundant) facts.add("If any one unit fails", "every label must still be reached");
  if (placement.min_spacing > 0)
    facts.add("Minimum distance between units", plain(placement.min_spacing) + "\u00A0m");
  if (placement.min_spacing > 0 || placement.forbidden_pairs > 0)
    facts.add("Excluded pairs of candidates", grouped(placement.forbidden_pairs));
  facts.add("Status", std::string(status_name(placement.status)));
  if (placement.status != Status::infeasible) {
    facts.add("Method of proof", std::string(bound_proof_text(placement.bound_proof)));
    facts.add("Equally good placements",
              placement.ties_settled ? "this one has the largest minimum margin" : "not all were compared");
  }
  facts.add("Solver", placement.solver);
  facts.add("Time", significant(placement.seconds, 3) + "\u00A0s");
  if (data.has_selection()) {
    facts.add("Transceivers", grouped(placement.count()));
    facts.add("Lower bound on the count", grouped(proven_count(placement)));
    facts.add("Gap of the count", percent(count_gap(placement)));
    // With the count as the only objective, these rows would repeat the rows above.
    if (problem.objective != Objective::count || problem.combination == Combination::weighted) {
      facts.add("Objective value", plain(placement.objective_value));
      facts.add("Lower bound on the objective", plain(placement.lower_bound));
      facts.add("Gap of the objective", percent(placement.gap()));
    }
    const std::size_t labels = data.outcome.labels.size();
    facts.add("Labels that at least two units each reach alone (redundant)",
              fmt::format("{} of {} ({})", grouped(data.outcome.redundant), grouped(labels),
                          percent(share_of(data.outcome.redundant, labels))));
  } else if (placement.status != Status::infeasible) {
    facts.add("Lower bound on the count", grouped(proven_count(placement)));
  }
  return facts.html();
}

// "none", or the number of labels and the first ranges of their ids.
std::string named_labels(const ReportData& data, Verdict verdict) {
  constexpr std::size_t max_ranges = 20;
  const auto& labels = data.input.plan.certificate->labels;
  std::vector<std::string> ids;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i].verdict == verdict) ids.push_back(data.label(i).id);
  if (ids.empty()) return "none";
  const auto ranges = id_ranges(ids);
  const std::size_t shown = std::min(ranges.size(), max_ranges);
  return fmt::format("{}: {}{}", grouped(ids.size()),
                     fmt::join(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < ranges.size() ? ", …" : "");
}

std::string certificate_facts(const ReportData& data) {
  if (!data.input.plan.certificate) return {};
  const Certificate& certificate = *data.input.plan.certificate;
  Facts facts("Certificate from independent samples");
  facts.add("Joint confidence", plain(100 * certificate.confidence) + "\u00A0%");
  if (certificate.none_verified())
    facts.add("Labels reached", "not verified yet");
  else
    facts.add("Labels reached", fmt::format("{} of {}", grouped(certificate.count(Verdict::reached)),
                                            grouped(certificate.labels.size())));
  facts.add("Missed", named_labels(data, Verdict::missed));
  facts.add("Undecided", named_labels(data, Verdict::undecided));
  if (certificate.count(Verdict::unverified) > 0)
    facts.add("Not verified yet", named_labels(data, Verdict::unverified));
  if (certificate.cost_lower_bound > 0)
    facts.add("Lower bound on the cost", plain(certificate.cost_lower_bound));
  if (certificate.count_lower_bound > 0)
    facts.add("Lower bound on the count", grouped(certificate.count_lower_bound));
  if (certificate.bound_labels > 0) facts.add("Proven from", counted(certificate.bound_labels, "label"));
  if (certificate.count_lower_bound == 0 && certificate.cost_lower_bound == 0)
    facts.add("Lower bound", "not examined");
  facts.add("Rounds", grouped(certificate.rounds));
  facts.add("Time", significant(certificate.seconds, 3) + "\u00A0s");
  if (!certificate.open.empty()) facts.add("Verification ended because", certificate.open);
  return facts.html();
}

std::string simulation_facts(const ReportData& data) {
  const SamplingSummary& s = data.sampling;
  const SignalMatrix& matrix = data.input.matrix;
  Facts facts("Simulation");
  facts.add("Labels × candidates", grouped(matrix.rows()) + " × " + grouped(matrix.columns()));
  if (data.has_options()) facts.add("Mounting points", grouped(data.mounting_points));
  const bool has_more = data.input.plan.certificate && s.min_samples < s.max_samples;
  facts.add("Samples per label", range(s.min_samples, s.max_samples) +
                                     (has_more ? ", more where they decide the certificate" : ""));
  facts.add("Batches per label", range(s.min_batches, s.max_batches));
  facts.add("Estimator", matrix.provenance.estimator);
  facts.add("Wavelength", plain(matrix.wavelength_nm) + "\u00A0nm");
  facts.add("Entries without signal", fmt::format("{} of {} ({})", grouped(s.zeros), grouped(s.entries),
                                                  percent(share_of(s.zeros, s.entries))));
  facts.add(fmt::format("Entries of at least {} of the requirement", percent(relevant_share, 0)),
            grouped(s.relevant));
  if (s.has_errors && s.relevant > 0) {
    facts.add("Relative standard error of these entries",
              fmt::format("mean {}, median {}", percent(s.mean), percent(s.median)));
    facts.add("90\u00A0% are below", percent(s.p90));
    facts.add("99\u00A0% are below", percent(s.p99));
    facts.add("Largest", percent(s.worst));
    if (s.has_flags)
      facts.add("Entries with an unreliable error",
                fmt::format("{} ({})", grouped(s.flagged), percent(share_of(s.flagged, s.relevant))));
    if (s.has_flags && data.has_selection())
      facts.add("Labels that depend on unreliable errors", grouped(data.outcome.flagged_labels));
  } else if (!s.has_errors) {
    facts.add("Standard errors", "not in the matrix");
  }
  return facts.html();
}

std::string origin_facts(const ReportData& data) {
  const Scene& scene = data.input.scene;
  const Provenance& provenance = data.input.matrix.provenance;
  Facts facts("Store and origin");
  if (scene.room)
    facts.add("Room", fmt::format("{} × {} × {} m", plain(scene.room->x), plain(scene.room->y),
                                  plain(scene.room->z)));
  facts.add("Fixtures", grouped(scene.fixtures.size()));
  for (const LabelType& type : scene.label_types)
    facts.add("Label type " + type.name, "requirement " + data.unit.text(type.requirement()));
  facts.add("Seed", fmt::format("{}", provenance.seed));
  facts.add("Program", provenance.program_version.empty() ? "" : "shelfbeam " + provenance.program_version);
  facts.add("Store hash", provenance.store_hash);
  return facts.html();
}

// Empty without items.
std::string list(const char* title, const char* remark, const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string html = fmt::format("<h3>{}</h3>\n", title);
  if (*remark != '\0') html += fmt::format("<p>{}</p>\n", remark);
  html += "<ul>\n";
  for (const std::string& item : items) html += fmt::format("<li>{}</li>\n", escape(item));
  return html + "</ul>\n";
}

}  // namespace

std::string facts_section(const ReportData& data) {
  std::string html = "<div class=\"facts\">\n" + placement_facts(data) + certificate_facts(data) +
                     simulation_facts(data) + origin_facts(data) + "</div>\n";
  html += list(
      "Light that is not simulated",
      "Real signals include this light and are larger. Give the transceiver type a radius to simulate it.",
      uncovered_light(data.input.scene));
  html += list("Light that is sampled only by chance", "Signals from this light have large errors.",
               chance_light(data.input.scene));
  return html_section("facts", "Facts", html);
}

}  // namespace shelfbeam
