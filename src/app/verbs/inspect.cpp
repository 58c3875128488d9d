#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/scene/glb/scene_glb.hpp"

#include "app/files.hpp"
#include "app/options/arguments.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  std::filesystem::path store, drawing;
  bool allow_outside = false, strict = false;
};

/// A kind of drawing, its name in the output, and the function that makes the file.
struct DrawingFormat {
  std::string_view suffix, name;
  std::string (*draw)(const Scene&);
};
constexpr std::array<DrawingFormat, 2> formats{
    {{".svg", "floor plan", floor_plan_svg}, {".glb", "3-D model", scene_glb}}};

/// Throws InputError for an unknown suffix.
const DrawingFormat& format_of(const std::filesystem::path& drawing) {
  const std::string suffix = drawing.extension().string();
  for (const DrawingFormat& format : formats)
    if (lower_case(suffix) == format.suffix) return format;
  throw InputError(
      drawing.string(),
      suffix.empty() ? "has no extension" : fmt::format("has the unknown extension '{}'", suffix),
      "use .svg for the floor plan or .glb for the 3-D model");
}

int run_inspect(const Options& options) {
  const std::filesystem::path& drawing = options.drawing;
  protect_input(drawing, options.store);
  const DrawingFormat* const format = drawing.empty() ? nullptr : &format_of(drawing);
  const Scene scene = make_inspected_scene(load_store(options.store, options.allow_outside, 0, drawing));
  if (format != nullptr) write_file(drawing, format->draw(scene));
  if (options.common.json) {
    print_json(summary_json(scene));
  } else if (!options.common.quiet) {
    print_summary(scene, format == nullptr ? "" : fmt::format("{}: {}", format->name, drawing.string()));
  }
  expect_no_warnings(scene, options.strict);
  return done;
}

}  // namespace

void add_inspect(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("inspect", "Check a store file; print its dimensions, counts and materials");
  auto options = std::make_shared<Options>();
  add_path(*verb, "STORE", options->store, "Store file (JSON)")->required();
  add_path(*verb, "-o,--output", options->drawing,
           "File to write: .svg for the floor plan, .glb for a 3-D model");
  add_store_options(*verb, options->allow_outside);
  add_strict_option(*verb, options->strict);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam inspect store.json -o plan.svg\n"
      "  shelfbeam inspect store.json -o store.glb");
  verb->callback([options, &chosen] { chosen = [options] { return run_inspect(*options); }; });
}

}  // namespace shelfbeam::app
