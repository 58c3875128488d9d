#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/id_layer.hpp"
#include "shelfbeam/report/drawing/part_drawing.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/drawing/wall_elevation.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

// Meshes are drawn as silhouettes, other fixtures as their upright prisms, a whole prism as its outline.
void draw_parts(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  const std::vector<Look> looks = looks_of(scene);
  const auto is_wall = [&](std::uint32_t f) { return scene.fixtures[f].is_wall(); };
  for (const std::uint32_t k : parts_seen_from_above(scene)) {
    const Part& part = scene.parts[k];
    if (part.fixture < looks.size() && (looks[part.fixture] != Look::solid || is_wall(part.fixture)))
      continue;
    if (part.fixture < looks.size() && scene.fixtures[part.fixture].form == FixtureForm::prism)
      canvas.polygon(view.outline(scene.fixtures[part.fixture].footprint), "solid");
    else if (const std::string silhouette = mesh_silhouette(view, scene, part); !silhouette.empty())
      canvas.path(silhouette, part_class(part));
    else
      canvas.polygon(view.outline(part.footprint), part_class(part));
  }
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f)
    if (has_plan(scene.fixtures[f]) && !is_wall(f)) {
      const std::string section = looks[f] == Look::overhead && scene.fixtures[f].form == FixtureForm::sheet
                                      ? ""
                                      : mesh_section(view, scene, f);
      if (!section.empty()) canvas.path(section, "outline");
      const bool is_drawn = looks[f] == Look::solid && scene.fixtures[f].form != FixtureForm::prism &&
                            !mesh_silhouette(view, scene, f).empty();
      if (looks[f] == Look::overhead || (section.empty() && !is_drawn))
        draw_outline(canvas, view, scene.fixtures[f],
                     looks[f] == Look::overhead ? "outline over" : "outline");
    }
  draw_inner_walls(canvas, view, scene);
}

// A dot at the label and a tick in its facing direction; labels above one another share one mark.
void draw_labels(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  const double tick = 6 * view.mark_share(), dot = 1.8 * view.mark_share();
  std::set<std::pair<std::string, std::string>> drawn;
  std::string ticks, dots;
  for (const Label& label : scene.labels) {
    const Point at = view.at(label.position.x, label.position.y);
    const std::string from = coordinate(at.x) + " " + coordinate(at.y);
    const std::string step = coordinate(tick * label.normal.x) + " " + coordinate(-tick * label.normal.y);
    if (!drawn.emplace(from, step).second) continue;
    ticks += fmt::format("M{}l{}", from, step);
    dots += fmt::format("M{0} {1}a{2} {2} 0 1 0 {3} 0a{2} {2} 0 1 0 -{3} 0", coordinate(at.x - dot),
                        coordinate(at.y), coordinate(dot), coordinate(2 * dot));
  }
  if (ticks.empty()) return;
  canvas.path(ticks, "label");
  canvas.path(dots, "dot");
}

void draw_transceivers(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  std::vector<bool> installed;
  for (const Transceiver& t : scene.transceivers) installed.push_back(t.installed);
  draw_free_points(canvas, view, positions_of(scene.transceivers), installed);
  std::string aims;
  for (const Transceiver& t : scene.transceivers)
    aims += aim_line(view.at(t.position.x, t.position.y), t.axis);
  if (!aims.empty()) canvas.path(aims, "aim");
  for (const Transceiver& t : scene.transceivers)
    if (t.installed) {
      const Point at = view.at(t.position.x, t.position.y);
      canvas.rect({at.x - 6, at.y - 6}, 12, 12, "old", t.id);
    }
}

std::string contents_of(const Scene& scene) {
  const Words words = words_of(scene);
  const std::size_t walls = scene.inner_walls(), zones = scene.room ? scene.room->zones.size() : 0;
  std::string text = words.say_count("noun.fixture", scene.fixtures.size() - walls);
  if (walls > 0) text += " · " + words.say_count("noun.inner_wall", walls);
  if (zones > 0) text += " · " + words.say_count("noun.zone", zones);
  return text;
}

std::string counts(const Scene& scene) {
  const Words words = words_of(scene);
  const auto installed = std::count_if(scene.transceivers.begin(), scene.transceivers.end(),
                                       [](const Transceiver& t) { return t.installed; });
  const std::size_t points = distinct_positions(positions_of(scene.transceivers)).count;
  const Vec3 size = scene.room ? scene.room->upper() - scene.room->lower() : scene.upper - scene.lower;
  std::string text =
      words.say("drawing.counts", words.plain(size.x), words.plain(size.y), words.plain(size.z),
                contents_of(scene), words.say_count("noun.label", scene.labels.size()),
                words.say_count("noun.candidate", scene.transceivers.size()));
  if (points < scene.transceivers.size()) text = words.say_count("drawing.at_points", points, text);
  if (installed > 0) text = words.say("drawing.of_which_installed", text, installed);
  return text;
}

void draw_key(SvgCanvas& canvas, const Scene& scene, double y) {
  const Words words = words_of(scene);
  const bool installed = std::any_of(scene.transceivers.begin(), scene.transceivers.end(),
                                     [](const Transceiver& t) { return t.installed; });
  double x = 360;
  canvas.path(fmt::format("M{} {}v-8", x, y), "label");
  canvas.raw(
      fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.2\" class=\"dot\"/>\n", coordinate(x), coordinate(y)));
  canvas.text({x + 9, y + 1}, words("drawing.key.label"), "t");
  x += 180;
  canvas.path(fmt::format("M{} {}h8m-4 -4v8", x - 4, y - 4), "cand");
  const bool leans = std::any_of(scene.transceivers.begin(), scene.transceivers.end(),
                                 [](const Transceiver& t) { return !aim_line({}, t.axis).empty(); });
  if (leans) canvas.path(aim_line({x, y - 4}, {1, 0, 0}), "aim");
  canvas.text({x + (leans ? 24 : 10), y + 1},
              words(leans ? "drawing.key.tilted_candidate" : "drawing.key.candidate"), "t");
  if (!installed) return;
  x += leans ? 312 : 180;
  canvas.rect({x - 6, y - 10}, 12, 12, "old");
  canvas.text({x + 12, y + 1}, words("drawing.key.installed"), "t");
}

}  // namespace

std::string floor_plan_svg(const Scene& scene, bool with_ids) {
  const Words words = words_of(scene);
  constexpr double heading = 84, margin = 24;
  const std::string title = scene.name.empty() ? words.say("summary.store") : scene.name;
  const PlanView view(scene, heading);
  SvgCanvas canvas;
  view.draw_floor(canvas, scene.room);
  draw_parts(canvas, view, scene);
  draw_labels(canvas, view, scene);
  draw_transceivers(canvas, view, scene);
  std::vector<Obstacle> texts;
  draw_fixture_ids(canvas, view, scene, {}, {}, &texts);
  if (with_ids) draw_id_layer(canvas, view, scene, texts);
  view.draw_axes(canvas);
  canvas.text({margin, 34}, title, "title");
  canvas.text({margin, 60}, counts(scene), "sub");
  draw_key(canvas, scene, view.height() - 17);

  double height = view.height();
  if (const auto fixture = fixture_with_max_labels(scene))
    height += margin + draw_elevation(canvas, scene, *fixture, height + margin, view.width());
  height += draw_wall_elevations(canvas, scene, height, view.width()) + margin;
  const std::string w = coordinate(view.width()), h = coordinate(height);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n"
      "<title>{2}</title>\n<style>{3}</style>\n<rect class=\"paper\" width=\"{0}\" "
      "height=\"{1}\"/>\n{4}</svg>\n",
      w, h, escape(title), drawing_style(scene) + std::string(with_ids ? id_layer_style : ""), canvas.body());
}

}  // namespace shelfbeam
