#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/device/photometry/ies_data.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"

namespace shelfbeam {

namespace {

using detail::IesData;
using detail::PhotometricLines;
using detail::Plane;

[[noreturn]] void bad_range(const PhotometricLines& lines, std::size_t line, const char* what, double first,
                            double last, const char* legal) {
  lines.fail(line, fmt::format("the {} angles range from {} to {}", what, first, last), legal);
}

DirectionTable type_c(IesData data, const PhotometricLines& lines) {
  const double low = data.vertical.front(), high = data.vertical.back();
  if (!((low == 0 || low == 90) && (high == 90 || high == 180)))
    bad_range(lines, data.vertical_line, "vertical", low, high,
              "type C allows 0 to 90, 90 to 180 or 0 to 180");
  std::vector<Plane>& planes = data.planes;
  const double first = planes.front().phi, last = planes.back().phi;
  if (first == 0 && last == 90) {
    detail::unfold(planes);
    detail::unfold(planes);
  } else if ((first == 0 && last == 180) || (first == 90 && last == 270)) {
    detail::unfold(planes);
  } else if (first == 0 && last > 180 && last <= 360 && detail::go_around(planes)) {
    detail::close(planes);
  } else if (!(first == 0 && last == 0)) {
    bad_range(lines, data.horizontal_line, "horizontal", first, last,
              "type C allows 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360");
  }
  return detail::table_of_planes(data.vertical, std::move(planes));
}

/// Prepends the mirror image of a row; its first value becomes the middle.
void mirror(std::vector<double>& row, double sign) {
  std::vector<double> image(row.rbegin(), row.rend() - 1);
  for (double& value : image) value *= sign;
  row.insert(row.begin(), image.begin(), image.end());
}

DirectionTable type_b(IesData data, const PhotometricLines& lines) {
  const auto legal = [](double first, double last) { return (first == 0 || first == -90) && last == 90; };
  const char* ranges = "type B allows -90 to 90, or 0 to 90 with a mirrored other half";
  std::vector<double>& vertical = data.vertical;
  std::vector<Plane>& planes = data.planes;
  if (!legal(vertical.front(), vertical.back()))
    bad_range(lines, data.vertical_line, "vertical", vertical.front(), vertical.back(), ranges);
  if (!legal(planes.front().phi, planes.back().phi))
    bad_range(lines, data.horizontal_line, "horizontal", planes.front().phi, planes.back().phi, ranges);
  if (planes.front().phi == 0) {
    std::vector<Plane> image(planes.rbegin(), planes.rend() - 1);
    for (Plane& plane : image) plane.phi = -plane.phi;
    planes.insert(planes.begin(), image.begin(), image.end());
  }
  if (vertical.front() == 0) {
    mirror(vertical, -1);
    for (Plane& plane : planes) mirror(plane.values, 1);
  }
  return detail::TypeB{std::move(vertical), std::move(planes)}.resampled();
}

}  // namespace

DirectionTable parse_ies(std::string_view text, const std::string& name) {
  PhotometricLines lines(text, name);
  IesData data = detail::read_ies_data(lines);
  return lines.checked(data.type == IesData::Type::b ? type_b(std::move(data), lines)
                                                     : type_c(std::move(data), lines));
}

DirectionTable read_ies(const std::filesystem::path& file) {
  return parse_ies(read_file(file, max_photometry_file), file.string());
}

}  // namespace shelfbeam
