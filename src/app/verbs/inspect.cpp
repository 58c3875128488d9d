#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/fields/finding_json.hpp"
#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/glb/scene_glb.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/scene/store/value_marks.hpp"

#include "app/options/arguments.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/text/variation_text.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_job.hpp"

namespace shelfbeam::app {

namespace {

struct InspectArguments {
  CommonOptions common;
  std::filesystem::path store, drawing;
  std::optional<std::uint64_t> state;
  bool allow_outside = false, no_links = false, strict = false, ids = false;
};

/// A kind of drawing, its name in the output, and the function that makes the file.
struct DrawingFormat {
  std::string_view suffix, name;
  std::string (*draw)(const Store&, const Scene&, bool with_ids);
};
const std::array<DrawingFormat, 3> formats{
    {{".svg", "floor plan",
      [](const Store&, const Scene& scene, bool ids) { return floor_plan_svg(scene, ids); }},
     {".glb", "3-D model", [](const Store&, const Scene& scene, bool) { return scene_glb(scene); }},
     {".json", "store",
      [](const Store& store, const Scene& scene, bool) { return resolved_store_json(store, scene); }}}};

/// Throws InputError for an unknown suffix.
const DrawingFormat& format_of(const std::filesystem::path& drawing) {
  const std::string suffix = drawing.extension().string();
  for (const DrawingFormat& format : formats)
    if (lower_case(suffix) == format.suffix) return format;
  throw InputError(
      drawing.string(),
      suffix.empty() ? "has no extension" : fmt::format("has the unknown extension '{}'", suffix),
      "use .svg for the floor plan, .glb for the 3-D model or .json for the store");
}

/// Prints all problems of a store; with `--json`, on standard output, too. Returns the exit code.
int print_problems(const Problems& problems, bool json) {
  constexpr std::size_t most = 100;
  if (json) print_json({{"problems", to_json(problems.all())}});
  for (const Finding& problem : std::span(problems.all()).first(std::min(most, problems.all().size())))
    print_message("{} {}\n", styled(Style::error, "error:", stderr), one_line(problem.sentence));
  if (problems.all().size() > most) print_message("and {} more errors\n", problems.all().size() - most);
  return wrong_input;
}

/// "threshold of standard (0.03 W/m²): given"
std::vector<std::string> value_lines(const Scene& scene) {
  std::vector<std::string> lines;
  for (const DecisiveValue& value : scene.values)
    lines.push_back(fmt::format("{}: {}", value_words(english(), value), to_text(value.state)));
  return lines;
}

int run_inspect(const InspectArguments& options) {
  const std::filesystem::path& drawing = options.drawing;
  protect_input(drawing, options.store);
  const DrawingFormat* const format = drawing.empty() ? nullptr : &format_of(drawing);
  if (options.ids && format != &formats.front())
    throw InputError("--ids", "has no effect without a floor plan", "add '-o plan.svg', or remove it");
  Problems problems(options.store.string());
  Store store = read_store(
      options.store,
      {.allow_outside = options.allow_outside, .output = drawing, .allow_links = !options.no_links},
      &problems);
  if (problems.all().size() > 1 || (options.common.json && !problems.all().empty()))
    return print_problems(problems, options.common.json);
  problems.throw_first();
  const Scene nominal = make_inspected_scene(store);
  if (options.state) store = StoreStates(store, nominal, options.common.seed).state(*options.state);
  const Scene scene = options.state ? make_scene(store) : nominal;
  if (format != nullptr) write_file(drawing, format->draw(store, scene, options.ids));
  if (options.common.json) {
    nlohmann::ordered_json json = summary_json(scene);
    for (const DecisiveValue& value : scene.values) json["values"].push_back(to_json(value, store.unit));
    if (store.variation) json["variation"] = variation_lines(store);
    print_json(json);
  } else if (!options.common.quiet) {
    print_summary(scene, format == nullptr ? "" : fmt::format("{}: {}", format->name, drawing.string()));
    print_list("known", value_lines(scene));
    print_list("varies", variation_lines(store));
  }
  jobs::expect_no_warnings(nominal, options.strict);
  return done;
}

}  // namespace

void add_inspect(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("inspect", "Check a store file; print its dimensions, counts and materials");
  auto options = std::make_shared<InspectArguments>();
  const OptionGroup first(*verb);
  first.require("STORE", options->store, a_path(), "Store file (JSON)");
  first.add("-o,--output", options->drawing, a_path(),
            "File to write: .svg for the floor plan, .glb for a 3-D model, .json for the store without "
            "references");
  first.add_flag("--ids", options->ids,
                 "Add the ids of candidates and the faces of columns to the floor plan");
  first.add("--state", options->state, whole_number("K", 0),
            "Inspect the shop in state K, counted from 0, of its 'variation' and --seed");
  add_store_options(*verb, options->allow_outside);
  // For the planner, which follows no links either.
  verb->add_flag("--no-links", options->no_links)->group("")->excludes("--allow-outside");
  add_strict_option(*verb, options->strict);
  finish_verb(*verb, chosen, options, run_inspect,
              "Examples:\n"
              "  shelfbeam inspect store.json -o plan.svg\n"
              "  shelfbeam inspect store.json -o plan.svg --ids\n"
              "  shelfbeam inspect store.json -o store.glb\n"
              "  shelfbeam inspect store.json --state 17 -o state17.json");
}

}  // namespace shelfbeam::app
