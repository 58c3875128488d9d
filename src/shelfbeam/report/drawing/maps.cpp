#include "shelfbeam/report/drawing/maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/mounting/mounting_sheet.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double unit_radius = 13;
const std::string free_points = "<use href=\"#free-layer\"/>\n";

std::size_t find_fullest(const std::vector<ShelfLevel>& levels) {
  const auto fewer = [](const ShelfLevel& a, const ShelfLevel& b) {
    return a.labels.size() < b.labels.size();
  };
  return static_cast<std::size_t>(std::max_element(levels.begin(), levels.end(), fewer) - levels.begin());
}

std::vector<double> signals_of(const ReportData& data, std::size_t level) {
  std::vector<double> values;
  if (level < data.levels.size())
    for (const LabelId label : data.levels[level].labels) {
      values.push_back(data.outcome.labels[label].direct);
      values.push_back(data.outcome.labels[label].signal);
    }
  return values;
}

// A line from the disc of a tilted unit in the direction of its tilt.
std::string nose_of(const TransceiverColumn& unit) {
  const double lean = std::hypot(unit.axis.x, unit.axis.y);
  const std::string line =
      lean > 0 ? aim_line({unit_radius * unit.axis.x / lean, -unit_radius * unit.axis.y / lean}, unit.axis)
               : "";
  return line.empty() ? "" : fmt::format("<path class=\"k aim\" d=\"{}\"/>", line);
}

std::string unit_symbol(const TransceiverColumn& unit) {
  return unit.installed ? "unit-old" : "unit";
}

}  // namespace

Maps::Maps(const ReportData& data)
    : data_(data),
      sheet_(mounting_sheet(data.input)),
      view_(data.input.scene),
      fullest_(find_fullest(data.levels)),
      scale_(signals_of(data, fullest_)),
      radius_(label_mark_radius(view_, positions_of(data.input.matrix.labels))) {}

std::size_t Maps::class_of(LabelId label) const {
  const double signal = data_.shown_signal(label), requirement = data_.label(label).requirement;
  return margin_class(margin_db(signal, requirement), is_met(signal, requirement));
}

std::vector<Point> Maps::positions(const std::vector<LabelId>& labels) const {
  std::vector<Vec3> positions, normals;
  for (const LabelId label : labels) {
    positions.push_back(data_.label(label).position);
    normals.push_back(data_.label(label).normal);
  }
  return label_mark_positions(view_, positions, normals, radius_);
}

std::string Maps::definitions() const {
  SvgCanvas canvas;
  canvas.raw("<svg class=\"defs\" width=\"0\" height=\"0\" aria-hidden=\"true\"><defs>\n");
  define_margin_marks(canvas, radius_);
  define_hollow_mark(canvas, radius_);
  define_signal_marks(canvas, scale_, radius_);
  canvas.raw(fmt::format("<g id=\"unit\"><circle class=\"k unit\" r=\"{}\"/></g>\n", unit_radius));
  canvas.raw(fmt::format(
      "<g id=\"unit-old\"><rect class=\"k unit\" x=\"-{0}\" y=\"-{0}\" width=\"{1}\" height=\"{1}\" "
      "rx=\"3\"/></g>\n",
      unit_radius, 2 * unit_radius));
  canvas.raw("<g id=\"unit-aim\"><path class=\"k aim\" d=\"M-10 0h20\"/></g>\n");
  canvas.raw("<g id=\"cross\"><path class=\"cand\" d=\"M-7 0h14m-7 -7v14\"/></g>\n");
  canvas.raw("<g id=\"overhead\"><path class=\"fx-o\" d=\"M-11 -8h22v16h-22z\"/></g>\n");
  canvas.raw("<g id=\"worst\"><circle class=\"k worst\" r=\"12\"/></g>\n");

  canvas.raw("<g id=\"store-layer\">\n");
  view_.draw_floor(canvas, data_.input.scene.room);
  draw_fixtures(canvas, view_, data_.input.scene);
  view_.draw_axes(canvas);
  canvas.raw("</g>\n<g id=\"name-layer\">\n");
  draw_names(canvas);
  canvas.raw("</g>\n<g id=\"free-layer\">\n");
  std::vector<bool> chosen(data_.input.matrix.columns(), false);
  if (data_.has_selection())
    for (const std::uint32_t j : data_.input.plan.placement.selected) chosen[j] = true;
  draw_free_points(canvas, view_, positions_of(data_.input.matrix.transceivers), chosen);
  canvas.raw("</g>\n<g id=\"unit-layer\">\n");
  if (data_.has_selection())
    for (std::size_t k = 0; k < data_.outcome.units.size(); ++k) {
      const TransceiverColumn& unit = data_.transceiver(data_.outcome.units[k].column);
      const Point at = view_.at(unit.position.x, unit.position.y);
      if (const std::string nose = nose_of(unit); !nose.empty())
        canvas.raw(fmt::format("<g transform=\"translate({} {})\">{}</g>\n", coordinate(at.x),
                               coordinate(at.y), nose));
      canvas.use(unit_symbol(unit), at, data_.words.say("drawing.unit", k + 1, unit.id));
      canvas.text(at, fmt::format("{}", k + 1), "num");
    }
  canvas.raw("</g>\n</defs></svg>\n");
  return canvas.body();
}

void Maps::draw_names(SvgCanvas& canvas) const {
  std::vector<Point> marks;
  std::set<std::string> referenced;
  for (const MountedUnit& unit : sheet_) {
    marks.push_back(view_.at(unit.position.x, unit.position.y));
    for (const Reference& reference : unit.references) referenced.insert(reference.fixture);
    referenced.insert({unit.place.fixture, unit.place.other});
  }
  draw_fixture_ids(canvas, view_, data_.input.scene, marks, referenced);
}

std::string Maps::picture(const std::string& marks, const std::string& css_class,
                          const std::string& description) const {
  return "<div class=\"map\">" +
         inline_svg(view_.width(), view_.height(), css_class, description,
                    "<use href=\"#store-layer\"/>\n<use class=\"names\" href=\"#name-layer\"/>\n" + marks +
                        "<use href=\"#unit-layer\"/>\n") +
         "</div>\n";
}

std::string Maps::overview(const std::string& description) const {
  std::vector<LabelId> lost;
  for (const Unreachable& label : data_.input.plan.placement.unreachable) lost.push_back(label.label);
  const std::vector<Point> at = positions(lost);
  SvgCanvas canvas;
  for (std::size_t k = 0; k < lost.size(); ++k) canvas.use("m0", at[k], data_.names.name(lost[k]));
  const std::string lost_key = lost.empty()
                                   ? ""
                                   : legend_item("m0", data_.words.say("drawing.legend.out_of_reach",
                                                                       data_.words.grouped(lost.size())));
  return fmt::format("<figure class=\"overview\">\n{}<ul class=\"legend\">{}{}</ul>\n</figure>\n",
                     picture(canvas.body(), "m", description), lost_key, unit_legend(false));
}

std::string Maps::margin_map(std::size_t level_index) const {
  const ShelfLevel& level = data_.levels[level_index];
  const std::vector<Point> at = positions(level.labels);
  // The smallest margin is drawn last, so that it lies on top.
  std::vector<std::size_t> order(level.labels.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    return data_.shown_signal(level.labels[a]) * data_.label(level.labels[b]).requirement >
           data_.shown_signal(level.labels[b]) * data_.label(level.labels[a]).requirement;
  });
  SvgCanvas canvas;
  for (const std::size_t k : order) {
    const LabelId label = level.labels[k];
    const double signal = data_.shown_signal(label);
    canvas.use(fmt::format("m{}", class_of(label)), at[k],
               fmt::format("{}: {}, {}", data_.names.name(label), data_.unit.text(signal),
                           data_.words.decibels(margin_db(signal, data_.label(label).requirement))));
    if (data_.outcome.labels[label].depends_on_flagged) canvas.use("hollow", at[k]);
    if (data_.has_selection() && label == data_.outcome.by_margin.front()) canvas.use("worst", at[k]);
  }
  const std::string title = data_.words.say("drawing.level", level_index + 1, level.heights(data_.words),
                                            data_.words.grouped(level.labels.size()));
  return fmt::format("<figure class=\"plan\"><figcaption>{}</figcaption>\n{}{}</figure>\n", escape(title),
                     picture(free_points + canvas.body(), "m", data_.words.say("drawing.by_margin", title)),
                     margin_legend(level));
}

std::string Maps::signal_maps(std::size_t level_index) const {
  const ShelfLevel& level = data_.levels[level_index];
  const std::vector<Point> at = positions(level.labels);
  const auto marks = [&](double LabelOutcome::* signal) {
    SvgCanvas canvas;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const LabelId label = level.labels[k];
      const double value = data_.outcome.labels[label].*signal;
      canvas.use(value > 0 ? fmt::format("g{}", scale_.class_of(value)) : "gz", at[k],
                 fmt::format("{}: {}", data_.names.name(label), data_.unit.text(value)));
    }
    return canvas.body();
  };
  std::string html = "<div class=\"pair\">\n";
  const std::array<std::pair<const char*, double LabelOutcome::*>, 2> parts{
      {{"direct", &LabelOutcome::direct}, {"all", &LabelOutcome::signal}}};
  for (const auto& [key, part] : parts) {
    const std::string title = data_.words.say(fmt::format("drawing.light.{}", key));
    html += fmt::format("<figure><figcaption>{}</figcaption>\n{}</figure>\n", title,
                        picture(free_points + marks(part), "m half",
                                data_.words.say("drawing.by_signal", title, level.heights(data_.words))));
  }
  return html + "</div>\n" + signal_legend();
}

std::string Maps::margin_legend(const ShelfLevel& level) const {
  std::array<std::size_t, margin_classes.size()> counts{};
  for (const LabelId label : level.labels) ++counts[class_of(label)];
  std::string html = "<ul class=\"legend\">";
  for (std::size_t k = 0; k < margin_classes.size(); ++k)
    if (k > 1 || counts[k] > 0)
      html += legend_item(fmt::format("m{}", k), fmt::format("{}: {}", margin_classes[k].name(data_.words),
                                                             data_.words.grouped(counts[k])));
  const auto hollow =
      static_cast<std::size_t>(std::count_if(level.labels.begin(), level.labels.end(), [&](LabelId label) {
        return data_.outcome.labels[label].depends_on_flagged;
      }));
  if (hollow > 0)
    html +=
        legend_item("hollow-key", data_.words.say("drawing.legend.unreliable", data_.words.grouped(hollow)));
  if (data_.has_selection() &&
      std::binary_search(level.labels.begin(), level.labels.end(), data_.outcome.by_margin.front()))
    html += legend_item("worst", data_.words.say("drawing.legend.worst"));
  return html + unit_legend(true) + "</ul>\n";
}

std::string Maps::unit_legend(bool has_candidates) const {
  std::string html;
  bool fresh = false, old = false, leans = false;
  if (data_.has_selection())
    for (const UnitOutcome& unit : data_.outcome.units) {
      (data_.transceiver(unit.column).installed ? old : fresh) = true;
      leans |= !nose_of(data_.transceiver(unit.column)).empty();
    }
  if (fresh) html += legend_item("unit", data_.words.say("drawing.legend.unit"));
  if (old) html += legend_item("unit-old", data_.words.say("drawing.legend.installed"));
  if (leans) html += legend_item("unit-aim", data_.words.say("drawing.legend.aim"));
  const std::vector<Look> looks = looks_of(data_.input.scene);
  if (std::find(looks.begin(), looks.end(), Look::overhead) != looks.end())
    html += legend_item("overhead", data_.words.say("drawing.legend.overhead"));
  if (has_candidates)
    html += legend_item("cross", data_.words.say(data_.has_selection() ? "drawing.legend.not_chosen"
                                                                       : "drawing.legend.candidate"));
  if (data_.input.plan.placement.problem.redundant)
    html += fmt::format("<li>{}</li>", escape(data_.words("drawing.legend.without_strongest")));
  return html;
}

std::string Maps::signal_legend() const {
  std::string html = "<ul class=\"legend\">" + legend_item("gz", data_.words.say("drawing.legend.none"));
  for (std::size_t k = 0; k < scale_.classes(); ++k) {
    const std::string upper = data_.unit.round_number(scale_.edges[k + 1]) + "\u00A0" + data_.unit.name;
    html += legend_item(
        fmt::format("g{}", k),
        k == 0 ? data_.words.say("drawing.legend.below", upper)
               : data_.words.say("drawing.legend.range", data_.unit.round_number(scale_.edges[k]), upper));
  }
  return html + unit_legend(true) + "</ul>\n";
}

}  // namespace shelfbeam
