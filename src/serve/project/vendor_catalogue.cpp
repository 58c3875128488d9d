#include "serve/project/vendor_catalogue.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

void add_catalogue(const fs::path& file, const fs::path& folder, Project& project) {
  const std::string name = file.filename().string(), text = read_file(file);
  expect_catalogue(JsonCursor::parse(text, file.string()));
  const fs::path copy = folder / name;
  if (!fs::exists(fs::symlink_status(copy)))
    write_file(copy, text);
  else if (!fs::is_regular_file(fs::symlink_status(copy)) || read_file(copy) != text)
    throw InputError(copy.string(), fmt::format("is another file than '{}'", file.string()),
                     "rename the catalogue to add it beside this file, or replace this file by it");
  const nlohmann::ordered_json store = parse_json(project.text(), "store.json");
  EditOp op{"/catalogues", {}, nlohmann::ordered_json::array({name})};
  if (const auto listed = store.find("catalogues"); listed != store.end()) {
    if (std::any_of(listed->begin(), listed->end(), [&](const auto& one) { return one == name; })) return;
    op = {fmt::format("/catalogues/{}", listed->size()), {}, name};
  }
  project.edit(fmt::format("Catalogue {}", name), {op});
}

}  // namespace shelfbeam::serve
