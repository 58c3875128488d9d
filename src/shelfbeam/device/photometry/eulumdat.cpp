#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/device/photometry/photometric_lines.hpp"
#include "shelfbeam/device/photometry/photometry.hpp"
#include "shelfbeam/device/photometry/planes.hpp"

namespace shelfbeam {

namespace {

using detail::PhotometricLines;
using detail::Plane;

constexpr std::size_t symmetry_line = 3;

class EulumdatReader {
 public:
  explicit EulumdatReader(PhotometricLines& lines) : lines_(lines) {}

  DirectionTable read() {
    skip(2, "the header");
    const std::size_t symmetry = lines_.whole(number("the symmetry"), 0, 4, "the symmetry");
    const std::size_t c_count = extent("the number of C-planes");
    skip(1, "the distance of the C-planes");
    const std::size_t gamma_count = extent("the number of intensities in a C-plane");
    skip(17, "the description");  // the distance of gammas, names, sizes, flux fractions
    const double factor = number("the conversion factor");
    if (!(factor > 0)) lines_.fail(fmt::format("the conversion factor is {}", factor), "it must be positive");
    skip(1, "the tilt during measurement");
    const std::size_t lamp_sets = extent("the number of sets of lamps", 0);
    skip(6 * lamp_sets, "the sets of lamps");
    skip(10, "the direct ratios");

    const std::vector<double> c = angles(c_count, {0}, 360, "the C-angle");
    const std::size_t c_line = lines_.line();
    const std::vector<double> gamma = angles(gamma_count, {0, 90}, 180, "the gamma angle");
    if (gamma_count < 2) lines_.fail("has only one gamma angle", "at least two are required");
    const std::vector<double> measured = stored(symmetry, c, c_line);
    expect_planes(symmetry, measured.size(), c_count, gamma_count);
    std::vector<Plane> planes;
    for (const double angle : measured) planes.push_back({angle, intensities(angle, gamma_count, factor)});
    lines_.expect_end();

    if (symmetry == 0) {
      if (!detail::go_around(planes))
        lines_.fail(c_line, fmt::format("the C-angles end at {}", c.back()),
                    "without symmetry they must cover the full circle");
      detail::close(planes);
    }
    if (symmetry >= 2) detail::unfold(planes);
    if (symmetry == 4) detail::unfold(planes);
    return detail::table_of_planes(gamma, std::move(planes));
  }

 private:
  void skip(std::size_t count, std::string_view what) {
    for (std::size_t k = 0; k < count; ++k) lines_.next(what);
  }

  /// The number on the next line, with a decimal point or comma.
  double number(std::string_view what) {
    std::string word(lines_.next(what));
    std::replace(word.begin(), word.end(), ',', '.');
    const auto value = detail::finite_number(word);
    if (!value)
      lines_.fail(fmt::format("{} is not a number; {} is expected", in_quotes(word), what),
                  "check that no line is missing before it");
    return *value;
  }

  /// A count of values that follow, one per line.
  std::size_t extent(std::string_view what, std::size_t min = 1) {
    const std::size_t count =
        lines_.whole(number(what), min, std::numeric_limits<std::uint32_t>::max(), what);
    if (count > lines_.remaining())
      lines_.fail(fmt::format("{} is {}, but only {} lines follow", what, count, lines_.remaining()),
                  "check the counts, or download the file again if it is truncated");
    return count;
  }

  std::vector<double> angles(std::size_t count, std::initializer_list<double> first, double last,
                             std::string_view what) {
    std::vector<double> result;
    result.reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double angle = detail::snapped(number(what));
      if (k == 0 && std::find(first.begin(), first.end(), angle) == first.end())
        lines_.fail(fmt::format("{} is {}", what, angle),
                    fmt::format("angles must begin at {}", fmt::join(first, " or ")));
      if (k > 0 && !(angle > result.back()))
        lines_.fail(fmt::format("{} {} follows {}", what, angle, result.back()), "angles must ascend");
      if (angle > last)
        lines_.fail(fmt::format("{} is {}", what, angle), fmt::format("the maximum is {}", last));
      result.push_back(angle);
    }
    return result;
  }

  /// The angles of the C-planes whose intensities are in the file.
  std::vector<double> stored(std::size_t symmetry, const std::vector<double>& c, std::size_t line) const {
    const auto index_of = [&](double angle) {
      const auto found = std::find(c.begin(), c.end(), angle);
      if (found == c.end())
        lines_.fail(line, fmt::format("symmetry {} requires a C-plane at {}", symmetry, angle),
                    "check the C-angles and the symmetry");
      return found - c.begin();
    };
    switch (symmetry) {
      case 1:
        return {0};
      case 2:
        return {c.begin(), c.begin() + index_of(180) + 1};
      case 3: {
        std::vector<double> result(c.begin() + index_of(270), c.end());
        if (result.back() == 360) result.pop_back();
        for (auto a = c.begin(); a != c.begin() + index_of(90) + 1; ++a) result.push_back(*a + 360);
        return result;
      }
      case 4:
        return {c.begin(), c.begin() + index_of(90) + 1};
      default:
        return c;
    }
  }

  /// Throws if the rest of the file consists of whole planes, but not of as many as the symmetry requires.
  void expect_planes(std::size_t symmetry, std::size_t required, std::size_t listed,
                     std::size_t gammas) const {
    const std::size_t values = lines_.remaining_values(), planes = values / gammas;
    if (values % gammas != 0 || planes == required || planes == 0) return;
    const std::string all = required == listed ? fmt::format("all {} C-planes", listed)
                                               : fmt::format("{} of the {} C-planes", required, listed);
    lines_.fail(symmetry_line,
                fmt::format("symmetry {} requires the intensities of {}, but the file has those of {}",
                            symmetry, all, planes),
                "correct the symmetry, or download the file again if it is truncated");
  }

  std::vector<double> intensities(double c, std::size_t count, double factor) {
    std::vector<double> values;
    values.reserve(std::min(count, lines_.remaining()));
    for (std::size_t k = 0; k < count; ++k)
      values.push_back(
          lines_.intensity(number(fmt::format("an intensity of the C-plane {}", std::fmod(c, 360))), factor));
    return values;
  }

  PhotometricLines& lines_;
};

}  // namespace

DirectionTable parse_eulumdat(std::string_view text, const std::string& name) {
  PhotometricLines lines(text, name);
  return lines.checked(EulumdatReader(lines).read());
}

DirectionTable read_eulumdat(const std::filesystem::path& file) {
  return parse_eulumdat(read_file(file, max_photometry_file), file.string());
}

}  // namespace shelfbeam
