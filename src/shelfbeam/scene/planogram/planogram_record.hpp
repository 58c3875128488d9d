#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/length_unit.hpp"
#include "shelfbeam/scene/planogram/label_sides.hpp"
#include "shelfbeam/scene/planogram/planogram_columns.hpp"
#include "shelfbeam/scene/planogram/planogram_place.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

/// The columns of a record that do not depend on the form of the planogram. All readers throw InputError with
/// line and field.
class PlanogramRecord {
 public:
  PlanogramRecord(CsvReader& csv, const PlanogramColumns& columns, const StoreNames& names, LengthUnit unit)
      : csv_(csv), columns_(columns), names_(names), unit_(unit) {}

  /// Article, location and description.
  PlanogramPlace begin() const;
  /// The label type, if the record has one.
  void read_type(OwnStyle& style) const;
  /// Reads hook and tilt. Labels on a top (`on_top`) have no edge and therefore no hook.
  void read_mounting(OwnStyle& style, bool on_top) const;
  /// `otherwise` continues the remedy for a value below the limits.
  int whole(std::size_t field, int least, int most, std::string_view otherwise) const;
  /// A distance from 0 to the length of a side or a top.
  double distance(std::size_t field, double longest, std::string_view what) const;

 private:
  CsvReader& csv_;
  const PlanogramColumns& columns_;
  const StoreNames& names_;
  LengthUnit unit_;
};

/// "front, back"
std::string known_faces(const LabelSides& sides);

}  // namespace shelfbeam
