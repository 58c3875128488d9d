#include "shelfbeam/plan/store/given_units.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"

namespace shelfbeam {

bool is_placement_file(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (text[first] == '{' || text[first] == '/');  // '/': a comment
}

Store with_candidates_of(const std::filesystem::path& file, Store store) {
  return file.empty() || is_placement_file(file) ? std::move(store)
                                                 : store_with_units(std::move(store), file);
}

std::vector<ColumnId> chosen_units(const Scene& scene) {
  return numbers_where<ColumnId>(scene.transceivers.size(),
                                 [&](ColumnId j) { return scene.transceivers[j].is_chosen(); });
}

Placement given_units(const std::filesystem::path& file, const Scene& scene,
                      const std::filesystem::path& store) {
  if (file.empty()) {
    Placement chosen;
    chosen.selected = chosen_units(scene);
    if (chosen.selected.empty())
      throw InputError(store.string(), "selects no transceivers",
                       "list their ids in transceivers.selected, or name a placement");
    return chosen;
  }
  if (!is_placement_file(file)) {
    Placement all;
    all.selected = all_numbers<ColumnId>(scene.transceivers.size());
    return all;
  }
  Placement placement = read_placement(file, table_without_signals(scene));
  if (!placement.has_selection() || placement.selected.empty())
    throw InputError(file.string(), "selects no transceivers", "choose another placement");
  return placement;
}

}  // namespace shelfbeam
