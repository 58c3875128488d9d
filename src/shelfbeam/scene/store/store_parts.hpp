#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/read_values.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"
#include "shelfbeam/scene/store/presets.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/store/table_file.hpp"
#include "shelfbeam/scene/store_folder.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

// Readers of the sections of a store file. They collect the problems of all members, and throw InputError
// with the JSON path for a section as a whole.

/// The types of catalogues from which those of a store can be made.
class Products {
 public:
  /// `list`: the section of a file that has them.
  explicit Products(std::string_view list) : list_(list) {}

  void add(const JsonCursor& catalogue);

  /// The keys of a type with those of its product that it lacks; `origin` notes to which values the source
  /// applies. Errors in a key of a product name the product. Throws InputError for an unknown product.
  JsonCursor complete(const JsonCursor& type, TypeOrigin& origin) const;

 private:
  std::string_view list_;
  std::map<std::string, JsonCursor, std::less<>> products_;
};

void read_transceiver_types(const JsonCursor& section, const StoreFolder& folder, const Products& products,
                            Store& store, Problems& problems);
/// Requires the transceiver types to be read already, because a threshold may name them.
void read_label_types(const JsonCursor& section, const StoreFolder& folder, const Products& products,
                      Store& store, Problems& problems);
/// Completes presets, expands repeats, and places fixtures against walls and others. Requires the room.
void read_fixtures(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                   Presets& presets, Store& store, Problems& problems);
/// Adds a label per record of a CSV file with the places of articles (scene/planogram). Requires the
/// fixtures.
void read_planogram(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                    Store& store, Problems& problems);
void read_labels(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder, Store& store,
                 Problems& problems);
void read_measuring_planes(const JsonCursor& section, const StoreNames& names, Store& store,
                           Problems& problems);
/// Checks the picture beneath the planner's drawing, which the store does not keep.
void expect_drawing(const JsonCursor& section, const StoreNames& names, Problems& problems);
/// The areas, rails and faces of the section "transceivers". Requires the room and the fixtures.
void read_mounts(const JsonCursor& section, const StoreNames& names, Store& store, Problems& problems);
/// Reads the members of an object by name. A name stays known if its member has problems.
template <class Named, class Read>
void read_named(const JsonCursor& section, std::vector<Named>& list, Problems& problems, const Read& read) {
  for (const auto& member : section.members()) {
    problems.collect([&] { new_name(member.first, list, member.second); });
    Named one;
    one.name = member.first;
    read(member.second, one);
    list.push_back(std::move(one));
  }
}
/// Reads the members of a list, and keeps those without problems. `to` has values with their locations, or
/// values alone; `complete` checks the rules that tie their keys together.
template <class To, class Complete>
void read_list(const JsonCursor& list, const StoreNames& names, Problems& problems, To& to,
               const Complete& complete) {
  for (const JsonCursor& json : list.elements()) {
    typename To::value_type member{};
    const auto read = [&](auto& value) {
      return read_object(
          json, names, problems, [&](Fields& f) { describe(value, f); },
          [&](FieldReader& reader) { complete(reader, value); });
    };
    if constexpr (requires { member.where; }) {
      member.where = json.where();
      if (read(member.value)) to.push_back(std::move(member));
    } else if (read(member)) {
      to.push_back(std::move(member));
    }
  }
}
/// Each pattern is compared with each id, in a time of up to the product of their lengths. Throws InputError
/// at the list of the patterns if that takes long.
void expect_few_comparisons(const JsonCursor& list, const std::vector<std::string_view>& ids,
                            const std::vector<std::string_view>& patterns);
/// Throws Consequence if the fixture with this id may be one that has problems.
inline void expect_fixtures(const Problems& problems, std::string_view id) {
  problems.expect_complete("fixture");
  problems.expect_complete("fixture " + std::string(id));
}
/// Throws InputError unless an area is the room, one of its zones, or a polygon.
void complete_plan_area(const JsonCursor& json, const PlanArea& area, const Store& store,
                        const Problems& problems);
void read_transceivers(const JsonCursor& section, const StoreNames& names, const StoreFolder& folder,
                       Store& store, Problems& problems);

/// The section "variation". Requires the room and the fixtures.
StoreVariation read_variation(const JsonCursor& json, const StoreNames& names, const Store& store,
                              Problems& problems);

/// Reads labels from a CSV with the header `id,x,y,z,nx,ny,nz,type`. Throws InputError with file and line.
/// With `problems`, collects those of all records.
void read_labels_csv(const TableFile& file, const StoreNames& names, Store& store,
                     Problems* problems = nullptr);

/// Reads transceivers from a CSV with the header `id,x,y,z,ax,ay,az,roll_deg,type`. Further columns are
/// ignored, so that placement.csv can be read back.
void read_transceivers_csv(const TableFile& file, const StoreNames& names, Store& store,
                           Problems* problems = nullptr);

}  // namespace shelfbeam
