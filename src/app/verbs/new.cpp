#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "app/options/arguments.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam {

// Made by cmake/embed.cmake from the files in examples/.
namespace embedded {
extern const std::string_view thesis_store;
extern const std::string_view grocery_store;
extern const std::string_view grocery_checkout;
extern const std::string_view chiller_store;
extern const std::string_view chiller_till;
extern const std::string_view chiller_mirror;
extern const std::string_view chiller_ring;
extern const std::string_view chiller_spot;
extern const std::string_view market_hall_store;
extern const std::string_view market_hall_chain;
extern const std::string_view market_hall_planogram;
extern const std::string_view supermarket_store;
extern const std::string_view hypermarket_store;
}  // namespace embedded

}  // namespace shelfbeam

namespace shelfbeam::app {

namespace {

struct TemplateFile {
  std::string_view name;
  std::string_view content;
};

/// An example store; its files are those of the folder of the same name in examples/.
struct Template {
  std::string_view name;
  std::string_view description;
  std::vector<TemplateFile> files;
};

const std::vector<Template>& store_templates() {
  static const std::vector<Template> templates{
      {"thesis",
       "the test environment of the paper: 390 labels, 320 candidates",
       {{"store.json", embedded::thesis_store}}},
      {"grocery",
       "a small grocery with gondolas, freezers and checkouts",
       {{"store.json", embedded::grocery_store}, {"checkout.glb", embedded::grocery_checkout}}},
      {"chiller",
       "a petrol station shop with glass doors and aimed units",
       {{"store.json", embedded::chiller_store},
        {"till.glb", embedded::chiller_till},
        {"security-mirror.obj", embedded::chiller_mirror},
        {"batwing.ies", embedded::chiller_ring},
        {"narrow-aisle.ldt", embedded::chiller_spot}}},
      {"market-hall",
       "an L-shaped hall: zones, inner walls, presets, a planogram",
       {{"store.json", embedded::market_hall_store},
        {"chain.json", embedded::market_hall_chain},
        {"planogram.csv", embedded::market_hall_planogram}}},
      {"supermarket",
       "50 x 40 m: 5,000 labels, 600 candidates",
       {{"store.json", embedded::supermarket_store}}},
      {"hypermarket",
       "110 x 85 m: 40,000 labels, 2,000 candidates",
       {{"store.json", embedded::hypermarket_store}}}};
  return templates;
}

const Template& find_template(const std::string& name) {
  std::vector<std::string_view> known;
  for (const Template& t : store_templates()) {
    if (t.name == name) return t;
    known.push_back(t.name);
  }
  throw InputError("TEMPLATE", fmt::format("unknown template '{}'", name), suggest(name, known));
}

struct NewArguments {
  CommonOptions common;
  std::string name;
  std::filesystem::path folder;
};

int run_new(const NewArguments& options) {
  const Template& chosen = find_template(options.name);
  for (const TemplateFile& file : chosen.files)
    if (const auto path = options.folder / file.name; std::filesystem::exists(path))
      throw InputError(path.string(), "already exists", "choose another folder, or remove the file");
  make_output_folder(options.folder);
  for (const TemplateFile& file : chosen.files) write_file(options.folder / file.name, file.content);
  const std::string store = (options.folder / "store.json").string();
  if (options.common.json) {
    print_json({{"store", store}});
  } else if (!options.common.quiet) {
    fmt::print("{}: {}\nnext: shelfbeam plan {} -o {}\n", store, chosen.description, store,
               (options.folder / "plan").string());
  }
  return done;
}

}  // namespace

void add_new(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("new", "Write an example store to start from");
  auto options = std::make_shared<NewArguments>();
  std::string descriptions;
  std::vector<std::string> names;
  for (const Template& t : store_templates()) {
    descriptions += fmt::format("\n  {:<11}  {}", t.name, t.description);
    names.emplace_back(t.name);
  }
  const OptionGroup first(*verb);
  first.require("TEMPLATE", options->name, CLI::Validator(choices(names)), "Example to copy; see below");
  first.require("DIR", options->folder, a_path(), "Folder for the store file and the files that it names");
  finish_verb(*verb, chosen, options, run_new,
              "Templates:" + descriptions + "\n\nExample:\n  shelfbeam new grocery my-store");
}

}  // namespace shelfbeam::app
