#include "shelfbeam/report/difference/difference_map.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/report/chart/palette.hpp"
#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double moved_radius = 13;

// Marks of labels of the second shop; later ones are drawn on top.
struct LabelMark {
  LabelChange change;
  std::string_view symbol, text;
};
constexpr std::array<LabelMark, 4> label_marks{{{LabelChange::stays_reached, "m3", "difference.map.reached"},
                                                {LabelChange::stays_missed, "m1", "difference.map.missed"},
                                                {LabelChange::gained, "gained", "difference.map.gained"},
                                                {LabelChange::lost, "m0", "difference.map.lost"}}};

// A new label looks like one that was always there.
LabelChange shown_change(const ComparedLabel& label) {
  if (label.before) return label.change();
  return label.after->reached ? LabelChange::stays_reached : LabelChange::stays_missed;
}

class DifferenceMap {
 public:
  DifferenceMap(const DifferenceInput& input, const Scene& after)
      : words_(words_of(after)),
        input_(input),
        scene_(after),
        view_(after),
        radius_(label_mark_radius(view_, positions_of(input.after.labels))) {}

  std::string figure() {
    SvgCanvas canvas;
    define_marks(canvas);
    view_.draw_floor(canvas, scene_.room);
    draw_fixtures(canvas, view_, scene_);
    view_.draw_axes(canvas);
    std::vector<Point> units;
    for (const ComparedPlan* plan : {&input_.before, &input_.after})
      for (const std::uint32_t column : plan->plan.placement.selected)
        units.push_back(at(plan->transceivers[column]));
    draw_fixture_ids(canvas, view_, scene_, units);
    draw_labels(canvas);
    draw_units(canvas);
    return fmt::format(
        "<figure class=\"overview\">\n<div class=\"map\">{}</div>\n<ul class=\"legend\">{}</ul>\n"
        "</figure>\n",
        inline_svg(view_.width(), view_.height(), "m", words_.say("difference.map.description"),
                   canvas.body()),
        legend_);
  }

 private:
  Point at(const TransceiverColumn& unit) const { return view_.at(unit.position.x, unit.position.y); }

  void define_marks(SvgCanvas& canvas) const {
    canvas.raw("<defs>\n");
    define_margin_marks(canvas, radius_);
    const std::string size = coordinate(std::max(1.7 * radius_, 8.0));
    canvas.raw(
        fmt::format("<g id=\"gained\"><path class=\"k m6\" d=\"M0 -{0}L{0} 0L0 {0}L-{0} 0Z\"/></g>\n", size));
    for (const auto& [name, css_class] : {std::pair("kept", "unit"),
                                          {"added", "unit-new"},
                                          {"changed", "unit-new"},
                                          {"removed", "unit-gone"}})
      canvas.raw(fmt::format("<g id=\"unit-{}\"><circle class=\"k {}\" r=\"{}\"/></g>\n", name, css_class,
                             moved_radius));
    canvas.raw("</defs>\n");
  }

  void draw_labels(SvgCanvas& canvas) {
    std::vector<Vec3> normals;
    normals.reserve(input_.after.labels.size());
    for (const LabelRow& label : input_.after.labels) normals.push_back(label.normal);
    const std::vector<Point> places =
        label_mark_positions(view_, positions_of(input_.after.labels), normals, radius_);
    for (const LabelMark& mark : label_marks) {
      bool is_used = false;
      for (const ComparedLabel& label : input_.difference.labels) {
        if (!label.after || shown_change(label) != mark.change) continue;
        canvas.use(mark.symbol, places[label.after->row], label_name(input_, label));
        is_used = true;
      }
      if (is_used) legend_ += legend_item(mark.symbol, words_(mark.text));
    }
  }

  // Numbers are those of `changed_units`.
  void draw_units(SvgCanvas& canvas) {
    std::size_t number = 0;
    for (const ComparedUnit& unit : input_.difference.units) {
      const std::string symbol = fmt::format("unit-{}", to_text(unit.change));
      const TransceiverColumn& shown =
          unit.after ? input_.after.transceivers[*unit.after] : input_.before.transceivers[*unit.before];
      if (unit.change == UnitChange::changed) {
        const Point from = at(input_.before.transceivers[*unit.before]);
        canvas.line(from, at(shown), "way");
        canvas.use("unit-removed", from, shown.id);
      }
      canvas.use(symbol, at(shown), shown.id);
      if (unit.change != UnitChange::kept)
        canvas.text(at(shown), fmt::format("{}", ++number), unit.after ? "num" : "num gone");
    }
    for (const auto& [name, change] : names_of<UnitChange>)
      if (input_.difference.count(change) > 0)
        legend_ += legend_item(fmt::format("unit-{}", name), words_(fmt::format("difference.map.{}", name)));
  }

  Words words_;
  const DifferenceInput& input_;
  const Scene& scene_;
  PlanView view_;
  double radius_;
  std::string legend_;
};

}  // namespace

std::string difference_map(const DifferenceInput& input, const Scene& after) {
  return DifferenceMap(input, after).figure();
}

}  // namespace shelfbeam
