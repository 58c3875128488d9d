#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shelfbeam/plan/answer/certificate.hpp"

namespace shelfbeam {

struct SensitivityOptions {
  double assumed_error = 0.1;  ///< relative, of reflectances whose range nobody told; 0 to 1
  double confidence = 0.99;    ///< of the verdicts at both ends together
};

/// How near a selection comes to missing a label, as samples have it.
struct LeastMargin {
  double ratio =
      std::numeric_limits<double>::infinity();  ///< least signal / (gamma tau); infinite without labels
  double standard_error = 0;                    ///< of this label's ratio
  std::uint32_t label = 0;                      ///< where it is, the first of several
};

/// All reflectances at the same end of their ranges at once. Verdicts are those of fresh samples, with a
/// joint confidence (Sensitivity::confidence); labels in neither list are reached.
struct ReflectanceEnd {
  LeastMargin least;
  std::vector<std::uint32_t> missed, undecided;
};

/// One material at one end of its range, all others as given. Estimates at the watched labels: nothing is
/// certified of them.
struct ReflectanceStep {
  LeastMargin least;
  /// By how much the margin of that label differs from what it is as given, on the same random numbers.
  double change = 0, change_error = 0;
  double mean_change = 0;  ///< of the labels' signals, relative to those as given; labels in the dark count 0
  std::size_t labels_short = 0;  ///< labels whose estimate is below their requirement
};

struct MaterialSensitivity {
  std::string material;
  double reflectance = 0, lower = 0, upper = 0;
  bool is_assumed = false;  ///< nobody told the range: it is Sensitivity::assumed_error to both sides
  ReflectanceStep at_lower, at_upper;
};

/// What becomes of a placement where surfaces reflect less or more than the store file says
/// (docs/methods/certified_plan.md).
struct Sensitivity {
  double confidence = 0.99;    ///< of the verdicts at both ends together
  double assumed_error = 0.1;  ///< relative
  LeastMargin as_given;
  ReflectanceEnd low, high;
  std::vector<MaterialSensitivity> materials;  ///< the one first whose lower end leaves the least margin
  std::vector<std::string> kept;               ///< materials in the scene without a reflectance of their own
  std::size_t watched =
      0;  ///< labels with the least margins at the low end, to which `as_given` and `materials` refer
  std::uint32_t batches = 0;  ///< of each simulation
  double seconds = 0;

  /// Whether all labels are reached wherever in their ranges the reflectances are. No signal falls where a
  /// surface reflects more, so this is decided at the low end.
  Verdict holds() const {
    if (!low.missed.empty()) return Verdict::missed;
    return low.undecided.empty() ? Verdict::reached : Verdict::undecided;
  }
};

}  // namespace shelfbeam
