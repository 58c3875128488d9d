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

std::string range(std::uint64_t least, std::uint64_t most) {
  return least == most ? grouped(least) : grouped(least) + " to " + grouped(most);
}

double share_of(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

std::string placement_facts(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const Question& question = placement.question;
  Facts facts("Placement");
  facts.add("Model", std::string(to_text(question.model)));
  facts.add("Objective", objective_name(question));
  if (words_of(question.objective).has_share)
    facts.add("A link counts from", percent(question.share, 0) + " of the requirement");
  if (question.redundant) facts.add("When any one unit fails", "every label must still be reached");
  if (placement.min_spacing > 0)
    facts.add("Least distance between two units", plain(placement.min_spacing) + "\u00A0m");
  if (placement.min_spacing > 0 || placement.forbidden_pairs > 0)
    facts.add("Pairs of candidates kept apart", grouped(placement.forbidden_pairs));
  facts.add("Status", std::string(status_name(placement.status)));
  if (placement.status != Status::infeasible) {
    facts.add("The bound rests on", std::string(behind_bound(placement.bound_proof)));
    facts.add("Of equal placements",
              placement.ties_settled ? "the one with the largest smallest margin" : "not all were compared");
  }
  facts.add("Solver", placement.solver);
  facts.add("Time", significant(placement.seconds, 3) + "\u00A0s");
  if (data.has_selection()) {
    facts.add("Transceivers", grouped(placement.count()));
    facts.add("At least needed", grouped(least_count(placement)));
    facts.add("Gap of the number", percent(count_gap(placement)));
    // For the number alone these would say the same again.
    if (question.objective != Objective::count || question.combination == Combination::weighted) {
      facts.add("Objective value", plain(placement.objective_value));
      facts.add("Bound of the objective", plain(placement.lower_bound));
      facts.add("Gap of the objective", percent(placement.gap()));
    }
    const std::size_t labels = data.outcome.labels.size();
    facts.add("Labels reached by two or more units, each alone (redundant)",
              fmt::format("{} of {} ({})", grouped(data.outcome.redundant), grouped(labels),
                          percent(share_of(data.outcome.redundant, labels))));
  } else if (placement.status != Status::infeasible) {
    facts.add("At least needed", grouped(least_count(placement)));
  }
  return facts.html();
}

// "none", or how many and which: ranges of ids, the first of them.
std::string named_labels(const ReportData& data, Verdict verdict) {
  constexpr std::size_t most_ranges = 20;
  const auto& labels = data.input.plan.certificate->labels;
  std::vector<std::string> ids;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels[i].verdict == verdict) ids.push_back(data.label(i).id);
  if (ids.empty()) return "none";
  const auto ranges = id_ranges(ids);
  const std::size_t shown = std::min(ranges.size(), most_ranges);
  return fmt::format("{}: {}{}", grouped(ids.size()),
                     fmt::join(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < ranges.size() ? ", …" : "");
}

std::string certificate_facts(const ReportData& data) {
  if (!data.input.plan.certificate) return {};
  const Certificate& certificate = *data.input.plan.certificate;
  Facts facts("Certificate on fresh samples");
  facts.add("Joint confidence", plain(100 * certificate.confidence) + "\u00A0%");
  facts.add("Labels reached", fmt::format("{} of {}", grouped(certificate.count(Verdict::reached)),
                                          grouped(certificate.labels.size())));
  facts.add("Missed", named_labels(data, Verdict::missed));
  facts.add("Undecided", named_labels(data, Verdict::undecided));
  if (certificate.count_lower_bound > 0) {
    facts.add("At least needed", grouped(certificate.count_lower_bound));
    facts.add("That rests on", counted(certificate.bound_labels, "label"));
  } else {
    facts.add("At least needed", "not examined");
  }
  facts.add("Rounds", grouped(certificate.rounds));
  facts.add("Time", significant(certificate.seconds, 3) + "\u00A0s");
  if (!certificate.open.empty()) facts.add("It ended because", certificate.open);
  return facts.html();
}

std::string simulation_facts(const ReportData& data) {
  const SamplingSummary& s = data.sampling;
  const SignalMatrix& matrix = data.input.matrix;
  Facts facts("Simulation");
  facts.add("Labels × candidates", grouped(matrix.rows()) + " × " + grouped(matrix.columns()));
  if (data.has_options()) facts.add("Mounting points", grouped(data.mounting_points));
  facts.add("Samples a label", range(s.least_samples, s.most_samples));
  facts.add("Batches a label", range(s.least_batches, s.most_batches));
  facts.add("Estimator", matrix.provenance.estimator);
  facts.add("Wavelength", plain(matrix.wavelength_nm) + "\u00A0nm");
  facts.add("Entries without signal", fmt::format("{} of {} ({})", grouped(s.zeros), grouped(s.entries),
                                                  percent(share_of(s.zeros, s.entries))));
  facts.add(fmt::format("Entries from {} of the requirement", percent(relevant_share, 0)),
            grouped(s.relevant));
  if (s.has_errors && s.relevant > 0) {
    facts.add("Their relative standard error",
              fmt::format("mean {}, median {}", percent(s.mean), percent(s.median)));
    facts.add("9 in 10 of them below", percent(s.p90));
    facts.add("99 in 100 below", percent(s.p99));
    facts.add("Worst", percent(s.worst));
    if (s.has_flags)
      facts.add("Signals whose error is not to be trusted",
                fmt::format("{} of them ({})", grouped(s.flagged), percent(share_of(s.flagged, s.relevant))));
    if (s.has_flags && data.has_selection())
      facts.add("Labels that depend on them", grouped(data.outcome.on_flagged));
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
    facts.add("Label type " + type.name, "needs " + data.unit.text(type.requirement()));
  facts.add("Seed", fmt::format("{}", provenance.seed));
  facts.add("Program", provenance.program_version.empty() ? "" : "shelfbeam " + provenance.program_version);
  facts.add("Store hash", provenance.store_hash);
  return facts.html();
}

// Nothing where there is nothing to list.
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
  html += list("Light that the signals do not have",
               "It would come on top; a transceiver type with a radius has it.",
               uncovered_light(data.input.scene));
  html += list("Light that is found by chance only", "Signals that rest on it have large errors.",
               chance_light(data.input.scene));
  html += list("Warnings about the store", "", data.input.scene.warnings);
  return html_section("facts", "Facts", html);
}

}  // namespace shelfbeam
