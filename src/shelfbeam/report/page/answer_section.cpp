#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/report/messages/headline.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

namespace {

std::string card(const std::string& name, const std::string& value, const std::string& note,
                 const std::string& css_class = "card") {
  return fmt::format("<div class=\"{}\"><dt>{}</dt><dd>{}<small>{}</small></dd></div>\n", css_class,
                     escape(name), escape(value), escape(note));
}

std::string shortfall(const ReportData& data, const Unreachable& label) {
  if (label.max_signal <= 0)
    return std::string(no_signal_reason(data.input.plan.placement.problem, data.is_heard(label.label)));
  const double db = -margin_db(label.max_signal, label.requirement);
  return fixed(db, db < 0.095 ? 2 : 1) + "\u00A0dB";
}

std::string bound_note(const Placement& placement, bool has_selection) {
  if (!has_selection) return "proven";
  return count_gap(placement) == 0 ? "proven" : fmt::format("proven; gap {}", percent(count_gap(placement)));
}

// With a certificate, its bound; the bound of the simulated matrix is then among the remarks and the facts.
std::string min_card(const ReportData& data) {
  constexpr const char* name = "Lower bound";
  const Placement& placement = data.input.plan.placement;
  if (placement.status == Status::infeasible) return card(name, "–", "no number is enough");
  const auto& certificate = data.input.plan.certificate;
  if (certificate && certificate->cost_lower_bound > 0)
    return card("Lower bound on the cost",
                plain(std::min(certificate->cost_lower_bound, placement.objective_value)),
                "with independent samples");
  if (certificate && certificate->count_lower_bound > 0)
    return card(name, grouped(std::min(certificate->count_lower_bound, placement.count())),
                "with independent samples");
  return card(name, grouped(proven_count(placement)),
              certificate ? "proven for the simulated signals" : bound_note(placement, data.has_selection()));
}

std::string warning_list(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return {};
  std::string items;
  for (const std::string& warning : warnings) items += fmt::format("<li>{}</li>\n", escape(warning));
  return html_section(
      "warnings", "Warnings about the store",
      "<p>The plan may rest on mistakes in the store file. Check these places first.</p>\n<ul>\n" + items +
          "</ul>\n");
}

}  // namespace

std::string answer_section(const ReportData& data) {
  constexpr const char* tones[] = {"yes", "open", "no"};
  constexpr const char* verdicts[] = {"Solved", "Open", "Not possible"};
  constexpr const char* certified[] = {"Certified", "Open", "Labels missed"};
  const Headline line = headline(data);
  const auto tone = static_cast<std::size_t>(line.tone);
  const bool has_certificate = data.input.plan.certificate.has_value();
  std::string verdict = has_certificate ? certified[tone] : verdicts[tone];
  // Other samples could change the matrix, so that "Solved" alone would promise too much.
  if (line.tone == Headline::Tone::yes && !has_certificate)
    verdict += data.uncertain > 0 ? fmt::format(", {} uncertain", counted(data.uncertain, "label"))
                                  : ", not verified yet";
  const std::string& name = data.input.scene.name;
  std::string html = fmt::format(
      "<header class=\"{}\">\n<p class=\"kicker\">Transceiver placement <span "
      "class=\"verdict\">{}</span></p>\n"
      "<h1>{}</h1>\n<p class=\"answer\">{}</p>\n",
      tones[tone], verdict, escape(name.empty() ? "Store" : name), escape(line.answer));
  for (const std::string& remark : line.remarks) html += paragraph(remark, "remark");
  return html + "</header>\n" + warning_list(data.input.plan.warnings);
}

std::string key_figures(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const auto& certificate = data.input.plan.certificate;
  const std::size_t candidates = data.input.matrix.columns(), labels = data.outcome.labels.size();
  const auto installed = std::count_if(placement.selected.begin(), placement.selected.end(),
                                       [&](auto column) { return data.transceiver(column).installed; });
  std::string html = "<dl class=\"cards\">\n";
  html += card(
      "Transceivers", data.has_selection() ? grouped(placement.count()) : "–",
      fmt::format("of {}{}{}", counted(candidates, "candidate"),
                  data.has_options() ? " at " + counted(data.mounting_points, "mounting point") : "",
                  data.has_selection() && installed > 0 ? fmt::format("; {} installed", installed) : ""));
  html += min_card(data);
  if (data.has_selection()) {
    html += certificate && certificate->none_verified()
                ? card("Labels reached", "–", "not verified yet", "card word")
            : certificate ? card("Labels reached", grouped(certificate->count(Verdict::reached)),
                                 fmt::format("of {}, with independent samples", grouped(labels)))
                          : card("Labels reached", grouped(data.outcome.met), "of " + grouped(labels));
    const std::uint32_t weakest = data.outcome.by_margin.front();
    html += card("Smallest margin", decibels(data.outcome.labels[weakest].margin()),
                 fmt::format("label {}{}", data.label(weakest).id, certificate ? ", simulated" : ""));
  } else if (placement.status == Status::infeasible && placement.unreachable.empty()) {
    html += card("Labels", grouped(labels), "each can be reached, but not all together");
  } else if (placement.status == Status::infeasible) {
    html += card("Labels out of reach", grouped(placement.unreachable.size()), "of " + grouped(labels));
  } else {
    html += card("Labels", grouped(labels), "");
  }
  const bool adds_up = placement.problem.model == CommunicationModel::cooperative;
  html += card("Model", std::string(to_text(placement.problem.model)),
               adds_up ? "signals of all units add up" : "one unit alone must reach a label", "card word");
  const std::string objective = objective_name(placement.problem);
  const std::size_t comma = objective.find(", ");
  html += card("Objective", objective.substr(0, comma),
               comma == std::string::npos ? "" : objective.substr(comma + 2), "card word");
  return html + "</dl>\n";
}

std::string unreachable_section(const ReportData& data) {
  const auto& unreachable = data.input.plan.placement.unreachable;
  if (unreachable.empty()) return {};
  constexpr std::size_t max_rows = 100;
  std::vector<Unreachable> worst = unreachable;
  std::stable_sort(worst.begin(), worst.end(), [](const Unreachable& a, const Unreachable& b) {
    return margin_db(a.max_signal, a.requirement) < margin_db(b.max_signal, b.requirement);
  });
  HtmlTable table({{"Label", false},
                   {"x (m)"},
                   {"y (m)"},
                   {"Height (m)"},
                   {fmt::format("Requirement ({})", data.unit.name)},
                   {fmt::format("Maximum signal ({})", data.unit.name)},
                   {"Shortfall", true, true}});
  for (std::size_t k = 0; k < std::min(worst.size(), max_rows); ++k) {
    const LabelRow& label = data.label(worst[k].label);
    table.add_row({label.id, fixed(label.position.x, 2), fixed(label.position.y, 2),
                   fixed(label.position.z, 2), data.unit.number(worst[k].requirement),
                   data.unit.number(worst[k].max_signal), shortfall(data, worst[k])});
  }
  std::string html = paragraph(
      data.input.plan.placement.problem.model == CommunicationModel::cooperative
          ? fmt::format("The maximum signal is the signal that the label would receive {}.",
                        maximum_signal_condition(data))
          : fmt::format(
                "The maximum signal is the signal that the label would receive from the best single "
                "candidate{}.",
                data.input.plan.placement.problem.redundant ? " that remains if the strongest fails" : ""));
  html += table.html();
  if (worst.size() > max_rows)
    html += paragraph(
        fmt::format("The table shows the {} labels with the largest shortfall; placement.json lists all {}.",
                    max_rows, grouped(worst.size())),
        "note");
  return html_section("unreachable", "Labels out of reach", html);
}

}  // namespace shelfbeam
