#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/base/names.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/room_shape.hpp"

namespace shelfbeam {

/// The causes of a shop's changes, and the unknown reflectances, which do not change with time.
enum class Cause {
  stock,
  people,
  objects,
  doors,
  mounting,  ///< position, tilt and power of units
  labels,    ///< their sensitivity
  reflectance
};

template <>
inline constexpr auto names_of<Cause> = std::to_array<Named<Cause>>({{"stock", Cause::stock},
                                                                     {"people", Cause::people},
                                                                     {"objects", Cause::objects},
                                                                     {"doors", Cause::doors},
                                                                     {"mounting", Cause::mounting},
                                                                     {"labels", Cause::labels},
                                                                     {"reflectance", Cause::reflectance}});

/// The key of the store file that describes a cause, by which users leave it out; "mounting" stands for
/// "unit_power_db", too.
inline constexpr std::array<std::string_view, names_of<Cause>.size()> cause_keys{
    "stocking", "people", "objects", "doors", "mounting", "label_sensitivity_db", "reflectances"};

constexpr std::string_view key_of(Cause cause) {
  return cause_keys[static_cast<std::size_t>(cause)];
}
/// Precondition: it is one of cause_keys.
constexpr Cause cause_of_key(std::string_view key) {
  std::size_t k = 0;
  while (cause_keys[k] != key) ++k;
  return static_cast<Cause>(k);
}

/// A number between two ends, uniformly distributed.
struct Range {
  double low = 0, high = 1;

  double at(double share) const { return low + share * (high - low); }
};

class Fields;
class JsonCursor;

/// A share from 0 to 1: a number, or { "uniform": [low, high] }. Throws InputError.
Range read_share_range(const JsonCursor& json);
nlohmann::ordered_json resolved(const Range& range);

/// Distributions of the number of boxes.
struct PoissonNumber {
  double mean = 0;
};
struct UniformNumber {
  std::int64_t low = 0, high = 0;  ///< both included
};
/// One or none.
struct Presence {
  double probability = 0;
};

/// Boxes that stand on the floor at random free places of an area, turned by random angles: people, pallets.
struct StandingBoxes {
  std::string id;  ///< the boxes are named after it
  PlanArea area;
  std::variant<PoissonNumber, UniformNumber, Presence> number;
  Vec3 size{};  ///< m
  MaterialId material;
  bool is_person = false;

  void fields(Fields& f);
};

/// Doors of the fixtures whose ids match a pattern ('*' and '?').
struct OpenDoors {
  std::string fixtures;
  double open = 0;  ///< share of the time

  void fields(Fields& f);
};

/// The changes of a shop (docs/formats/store/variation.md). A state is one draw of all of them.
struct StoreVariation {
  Range stocking{0.4, 1};    ///< level of every fixture
  double correlation = 1;    ///< between the levels of a fixture's rows
  bool is_assumed = true;    ///< the file does not give `stocking`
  double open_doors = 0.03;  ///< share of the time, of doors that no member of `doors` names
  std::vector<OpenDoors> doors;
  std::vector<StandingBoxes> boxes;  ///< people, then objects
  /// Standard deviations.
  double position = 0, tilt_deg = 0, unit_power_db = 0, label_sensitivity_db = 0;
  std::vector<Cause> without;  ///< these are as in the file in all states; ascending

  bool varies(Cause cause) const;
  /// Adds causes to `without`.
  void leave_out(const std::vector<Cause>& causes);

  void fields(Fields& f);
};

}  // namespace shelfbeam
