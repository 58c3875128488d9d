#include "shelfbeam/report/terminal/preview_text.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"

namespace shelfbeam {

namespace {

std::string labels_text(std::size_t count) {
  return counted(count, "label");
}

std::vector<std::string> doubts_of(std::uint8_t doubts) {
  std::vector<std::string> names;
  for (const auto& [name, doubt] : names_of<Doubt>)
    if ((doubts & static_cast<std::uint8_t>(doubt)) != 0) names.emplace_back(name);
  return names;
}

std::string_view reason_of(Doubt doubt) {
  switch (doubt) {
    case Doubt::near_surface:
      return "a unit shines on a surface within 10 cm";
    case Doubt::mirrors:
      return "mirrors, clear glass or metal";
    case Doubt::unexplored:
      return "light from surfaces that were not explored";
    case Doubt::skewed:
      return "bright light on few paths; refine longer";
    case Doubt::narrow:
      return "in a gap of less than half a metre";
  }
  return {};
}

// Labels that a change gains or loses.
std::string listed(const WhatIf& what_if, const Scene& scene, bool gained) {
  constexpr std::size_t most = 8;
  std::string ids;
  std::size_t count = 0;
  for (std::size_t i = 0; i < what_if.labels.size(); ++i) {
    const LabelWhatIf& label = what_if.labels[i];
    if (label.is_reached() != gained || label.was_reached() == gained) continue;
    if (++count <= most) ids += (count == 1 ? "" : ", ") + scene.labels[i].id;
  }
  return count > most ? fmt::format("{} and {} more", ids, count - most) : ids;
}

}  // namespace

std::string preview_answer(const WhatIf& what_if) {
  std::string text = fmt::format("{}: {} of {} reached", what_if.is_simulated ? "simulated" : "preview",
                                 what_if.reached(), labels_text(what_if.labels.size()));
  if (!what_if.has_change()) return text;
  return fmt::format("{}; compared with the units before, {} gained and {} lost", text, what_if.gained(),
                     what_if.lost());
}

std::string preview_remarks(const WhatIf& what_if, const Scene& scene) {
  std::string text;
  if (what_if.has_change())
    for (const bool gained : {true, false})
      if (const std::string ids = listed(what_if, scene, gained); !ids.empty())
        text += fmt::format("  {}: {}\n", gained ? "gained" : "lost", ids);
  if (const std::size_t close = what_if.close(); close > 0)
    text += fmt::format("  {} undecided: the requirement lies within the error\n", labels_text(close));
  for (const auto& [name, doubt] : names_of<Doubt>) {
    const auto bit = static_cast<std::uint8_t>(doubt);
    const auto count = std::count_if(what_if.labels.begin(), what_if.labels.end(),
                                     [&](const LabelWhatIf& label) { return (label.doubts & bit) != 0; });
    if (count > 0)
      text +=
          fmt::format("  {} doubtful: {}\n", labels_text(static_cast<std::size_t>(count)), reason_of(doubt));
  }
  return text;
}

std::vector<std::vector<std::string>> preview_table(const WhatIf& what_if, const Scene& scene,
                                                    std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  if (what_if.labels.empty()) return rows;
  rows.push_back({"weakest label", "share of the requirement", "error"});
  if (what_if.has_change()) rows.back().emplace_back("before");
  const std::vector<LabelId> weakest = what_if.weakest();
  for (std::size_t k = 0; k < std::min(most, weakest.size()); ++k) {
    const LabelWhatIf& label = what_if.labels[weakest[k]];
    rows.push_back({scene.labels[weakest[k]].id, fmt::format("{:.3f}", label.margin()),
                    fmt::format("{:.3f}", label.error / label.requirement)});
    if (what_if.has_change()) rows.back().push_back(fmt::format("{:.3f}", label.before / label.requirement));
  }
  return rows;
}

nlohmann::ordered_json preview_json(const WhatIf& what_if, const Scene& scene) {
  nlohmann::ordered_json json;
  json["simulated"] = what_if.is_simulated;
  json["model"] = to_text(what_if.problem.model);
  json["survives_failure"] = what_if.problem.redundant;
  json["labels_reached"] = what_if.reached();
  if (what_if.has_before) {
    json["labels_gained"] = what_if.gained();
    json["labels_lost"] = what_if.lost();
  }
  json["labels_close"] = what_if.close();
  json["labels_doubtful"] = what_if.doubtful();
  auto& units = json["added"] = nlohmann::ordered_json::array();
  for (const Transceiver& unit : what_if.added)
    units.push_back({{"id", unit.id},
                     {"position", {unit.position.x, unit.position.y, unit.position.z}},
                     {"axis", {unit.axis.x, unit.axis.y, unit.axis.z}},
                     {"type", scene.type_of(unit).name}});
  json["removed"] = what_if.removed;
  auto& labels = json["labels"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < what_if.labels.size(); ++i) {
    const LabelWhatIf& label = what_if.labels[i];
    auto& row = labels.emplace_back();
    row["id"] = scene.labels[i].id;
    row["requirement"] = label.requirement;
    if (what_if.has_before) row["before"] = label.before;
    row["signal"] = label.after;
    row["error"] = label.error;
    row["reached"] = label.is_reached();
    if (label.doubts != 0) row["doubts"] = doubts_of(label.doubts);
  }
  return json;
}

}  // namespace shelfbeam
