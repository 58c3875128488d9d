#include "shelfbeam/scene/planogram/planogram_record.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/label/description_column.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

PlanogramPlace PlanogramRecord::begin() const {
  PlanogramPlace place;
  place.article = csv_.id(columns_.article);
  place.where = csv_.where();
  if (has_value(csv_, columns_.description))
    place.description = description_of(csv_.text(*columns_.description));
  return place;
}

void PlanogramRecord::read_type(OwnStyle& style) const {
  if (has_value(csv_, columns_.type)) style.type = names_.label_type(csv_.text(*columns_.type), csv_.where());
}

void PlanogramRecord::read_mounting(OwnStyle& style, bool on_top) const {
  if (has_value(csv_, columns_.hook)) {
    const std::size_t field = *columns_.hook;
    if (on_top) csv_.fail(field, "does not apply to labels on the top", "leave it empty");
    constexpr double least = 1e-3, most = 1e3;  // m, as for lengths in the store file
    const auto [length, unit] = csv_.length(field, unit_);
    const double hook = to_metres(length, unit);
    if (!(hook >= least && hook <= most))
      csv_.fail(field, fmt::format("is {}", length_text(hook, unit_)),
                fmt::format("use {} to {}", length_text(least, unit_), length_text(most, unit_)));
    style.hook = hook;
  }
  if (has_value(csv_, columns_.tilt_deg)) {
    const std::size_t field = *columns_.tilt_deg;
    const double tilt = csv_.number(field);
    if (!(tilt >= least_label_tilt && tilt <= most_label_tilt))
      csv_.fail(field, fmt::format("is {:g}", tilt),
                fmt::format("use a value from {:g} to {:g}", least_label_tilt, most_label_tilt));
    style.tilt_deg = tilt;
  }
}

int PlanogramRecord::whole(std::size_t field, int least, int most, std::string_view otherwise) const {
  const double value = csv_.number(field);
  if (value != std::floor(value) || value < least || value > most)
    csv_.fail(field, fmt::format("is {:g}", value),
              fmt::format("use a whole number from {} to {}{}", least, most, value < least ? otherwise : ""));
  return static_cast<int>(value);
}

double PlanogramRecord::distance(std::size_t field, double longest, std::string_view what) const {
  const auto [length, unit] = csv_.length(field, unit_);
  const double value = read_coordinate(length, unit, csv_.where());
  if (!(value >= 0 && value <= longest))
    csv_.fail(field, fmt::format("is {}", length_text(value, unit_)),
              fmt::format("the {} extends from 0 to {}", what, length_text(longest, unit_)));
  return value;
}

std::string known_faces(const LabelSides& sides) {
  std::vector<std::string_view> known;
  for (const Face one : sides.faces) known.push_back(to_text(one));
  if (sides.top) known.push_back(top_face);
  return join(known, ", ");
}

}  // namespace shelfbeam
