#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/encoding.hpp"
#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/base/ids.hpp"
#include "shelfbeam/scene/fixture/shelving.hpp"

namespace shelfbeam {

/// How labels are mounted.
struct LabelStyle {
  LabelTypeId type;
  double hook = FixtureLabels{}.hook;  ///< m in front of the edge
  double tilt_deg = 0;                 ///< upward
};

/// What a record or a member of `planogram.fixtures` gives instead of the planogram's style.
struct OwnStyle {
  std::optional<LabelTypeId> type;
  std::optional<double> hook, tilt_deg;

  void replace_by(const OwnStyle& other);
};

/// A member of `planogram.fixtures`.
struct StyledFixtures {
  std::string pattern;
  OwnStyle style;

  void fields(Fields& f);
};

/// A member of `planogram.segments`: where segments of a planogram stand.
struct SegmentPlace {
  std::string planogram;         ///< empty: of any name
  std::vector<double> segments;  ///< whole numbers, from the left; none: all of the file, ascending
  std::string fixture;
  std::optional<Face> face = Face::front;  ///< nothing for the top
  double from = 0;                         ///< m from the left end of the face, as a person sees it
  std::optional<double> to = {};
  std::int64_t first_shelf = 1;  ///< number of the lowest board, with `from_top` of the highest
  bool from_top = false, right_to_left = false;

  void fields(Fields& f);
};

/// The key `planogram`: the labels of all articles.
struct ArticleLabels {
  std::string file;
  std::optional<Encoding> encoding;
  LabelStyle style;
  std::int64_t first_level = 1;  ///< number of the lowest board, with `from_top` of the highest
  bool from_top = false;
  std::int64_t first_position = 1;
  bool fill_down = false;
  std::vector<StyledFixtures> fixtures;
  std::vector<SegmentPlace> segments;

  void fields(Fields& f);
};

/// The name of a top among those of faces.
inline constexpr std::string_view top_face = "top";

inline constexpr double least_label_tilt = -89, most_label_tilt = 89;  // degrees

}  // namespace shelfbeam
