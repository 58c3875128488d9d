#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// The key `planogram`: the labels of all articles.
struct ArticleLabels {
  std::string file;
  LabelStyle style;
  std::vector<StyledFixtures> fixtures;

  void fields(Fields& f);
};

inline constexpr double least_label_tilt = -89, most_label_tilt = 89;  // degrees

}  // namespace shelfbeam
