#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, Store& store) {
  for (const auto& [name, cursor] : section.members()) {
    cursor.expect_keys({"emission", "radius", "cost"});
    TransceiverType type;
    type.name = check_name(name, cursor.where());
    const JsonCursor emission = cursor["emission"];
    type.emission = read_emission(emission, folder);
    if (const auto file = emission.find("file"))
      type.file = std::filesystem::path(file->text()).filename().string();
    if (const auto radius = cursor.find("radius")) type.radius = read_extent(*radius, 1e-4);
    if (const auto cost = cursor.find("cost")) type.cost = read_amount(*cost);
    store.transceiver_types.push_back(std::move(type));
  }
}

}  // namespace shelfbeam
