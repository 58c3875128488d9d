#include "shelfbeam/device/photometry/ies_data.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::string_view separators = " \t\f\v,";

std::string upper(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::string_view without_separators(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(separators), text.size()));
}

bool is_tilt(std::string_view line) {
  return upper(line.substr(0, 4)) == "TILT" && trim(line.substr(4)).starts_with('=');
}

/// Reads one file. After each step, `lines_` is just behind the line to which errors refer.
class IesReader {
 public:
  explicit IesReader(PhotometricLines& lines) : lines_(lines) {}

  IesData read() {
    try {
      return read_all();
    } catch (const InputError& error) {
      if (crowded_.empty()) throw;
      throw InputError(error, crowded_, error.setting());
    }
  }

 private:
  IesData read_all() {
    read_label();
    read_lamp();
    data_.vertical = read_angles("vertical angle", verticals_);
    data_.vertical_line = lines_.line();
    const std::vector<double> horizontal = read_angles("horizontal angle", horizontals_);
    data_.horizontal_line = lines_.line();
    for (const double angle : horizontal) data_.planes.push_back({angle, read_intensities(angle)});
    lines_.expect_end(rest_);
    return std::move(data_);
  }

  /// The numbers of a record, which are read word by word: a record may begin and end anywhere in a line.
  std::vector<double> record(std::size_t count, std::string_view what) {
    std::vector<double> values;
    values.reserve(count);
    while (values.size() < count) values.push_back(next_number(what));
    if (!rest_.empty() && crowded_.empty())
      crowded_ = fmt::format(
          "line {} has more than {} for {}: check the counts, and write decimals with a point, because "
          "commas separate numbers",
          lines_.line(), counted(count, "number"), what);
    return values;
  }

  double next_number(std::string_view what) {
    while (rest_.empty()) rest_ = without_separators(lines_.next(what));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(separators));
    const auto value = finite_number(word);
    if (!value)
      lines_.fail(fmt::format("{} is not a number; {} is expected", in_quotes(word), what),
                  "check that the line is complete and that no line is missing before it");
    rest_ = without_separators(rest_.substr(word.size()));
    return *value;
  }

  /// A count of numbers that follow. Each takes at least one character, which limits the count.
  std::size_t extent(double value, std::string_view what) const {
    const std::size_t count = lines_.whole(value, 1, std::numeric_limits<std::uint32_t>::max(), what);
    if (count > lines_.characters())
      lines_.fail(fmt::format("{} is {}, more than the file can contain", what, count),
                  "check the counts, or download the file again if it is truncated");
    return count;
  }

  void read_label() {
    std::string_view line = lines_.next("the first line");
    read_edition(line);
    while (!is_tilt(line)) {
      if (lines_.at_end())
        lines_.fail(0, "has no TILT= line, so it is truncated or not an IES (LM-63) file",
                    "for a EULUMDAT file, use the type 'eulumdat'");
      line = lines_.next("TILT=");
    }
    read_tilt(trim(line.substr(line.find('=') + 1)));
  }

  void read_edition(std::string_view line) {
    const std::string tag = upper(line);
    if (tag.starts_with("IESNA91")) year_ = 1991;
    for (const std::string_view prefix : {"IESNA:LM-63-", "IES:LM-63-"}) {
      if (!tag.starts_with(prefix)) continue;
      const std::string year = tag.substr(prefix.size());
      year_ = 0;
      for (const int known : {1986, 1991, 1995, 2002, 2019})
        if (year == fmt::format("{}", known) || year == fmt::format("{:02}", known % 100)) year_ = known;
      if (year_ == 0)
        lines_.fail(fmt::format("{} is not a known edition of LM-63", in_quotes(line)),
                    "known: 1986, 1991, 1995, 2002, 2019");
    }
  }

  void read_tilt(std::string_view value) {
    const std::string kind = upper(value);
    if (kind == "NONE") return;
    if (kind != "INCLUDE")
      lines_.fail(fmt::format("TILT is {}", in_quotes(value)),
                  "write TILT=NONE or TILT=INCLUDE; tilt factors only scale a profile, so NONE suffices");
    // Tilt factors depend on the mounting and scale all intensities equally, so they do not affect the shape.
    lines_.whole(record(1, "the lamp-to-luminaire geometry")[0], 1, 3, "the lamp-to-luminaire geometry");
    const std::size_t count = extent(record(1, "the number of tilt angles")[0], "the number of tilt angles");
    const std::vector<double> angles = record(count, "the tilt angles");
    if (angles.front() < 0 || angles.back() > 180 || !std::is_sorted(angles.begin(), angles.end()))
      lines_.fail("the tilt angles do not ascend within 0 to 180", "check that none is missing");
    for (const double factor : record(count, "the tilt factors"))
      if (factor < 0) lines_.fail(fmt::format("a tilt factor is {}", factor), "it must not be negative");
  }

  void read_lamp() {
    const std::vector<double> lamp = record(10, "the lamp data");
    verticals_ = extent(lamp[3], "the number of vertical angles");
    horizontals_ = extent(lamp[4], "the number of horizontal angles");
    if (verticals_ < 2) lines_.fail("has only one vertical angle", "at least two are required");
    if (horizontals_ > lines_.characters() / verticals_)
      lines_.fail(
          fmt::format("{} x {} intensities are more than the file can contain", verticals_, horizontals_),
          "check the counts, or download the file again if it is truncated");
    const std::size_t type = lines_.whole(lamp[5], 1, 3, "the photometric type");
    if (type == 3)
      lines_.fail("the photometric type is 3 (type A), which is not supported", "convert the file to type C");
    data_.type = static_cast<IesData::Type>(type);
    lines_.whole(lamp[6], 1, 2, "the type of units");

    const std::vector<double> ballast = record(3, "the ballast data");
    const double multiplier = lamp[2];
    // Later editions use the field of the ballast-lamp factor for another purpose.
    const double ballast_lamp = year_ <= 1991 ? ballast[1] : 1;
    factor_ = multiplier * ballast[0] * ballast_lamp;
    if (!(multiplier > 0 && ballast[0] > 0 && ballast_lamp > 0))
      lines_.fail(fmt::format("the multiplier {} or one of the ballast factors {} and {} is not positive",
                              multiplier, ballast[0], ballast_lamp),
                  "factors must be positive; 1 has no effect");
  }

  std::vector<double> read_angles(std::string_view what, std::size_t count) {
    std::vector<double> angles = record(count, fmt::format("the {}s", what));
    for (double& angle : angles) angle = snapped(angle);
    for (std::size_t k = 1; k < count; ++k)
      if (!(angles[k] > angles[k - 1]))
        lines_.fail(fmt::format("the {} {} follows {}", what, angles[k], angles[k - 1]), "they must ascend");
    return angles;
  }

  std::vector<double> read_intensities(double horizontal) {
    std::vector<double> values =
        record(verticals_, fmt::format("the intensities at horizontal angle {}", horizontal));
    for (double& value : values) value = lines_.intensity(value, factor_);
    return values;
  }

  PhotometricLines& lines_;
  std::string_view rest_;  ///< of the current line, from its next number
  /// The first line in which a record ended before the line did. Programs write such files, but in most files
  /// that cannot be read, there are too many or too few numbers before that place.
  std::string crowded_;
  IesData data_;
  int year_ = 1986;  ///< the first edition has no version tag
  std::size_t verticals_ = 0, horizontals_ = 0;
  double factor_ = 1;
};

}  // namespace

IesData read_ies_data(PhotometricLines& lines) {
  return IesReader(lines).read();
}

}  // namespace shelfbeam::detail
