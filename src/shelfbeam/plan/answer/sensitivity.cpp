#include "shelfbeam/plan/answer/sensitivity.hpp"

namespace shelfbeam {

Verdict Sensitivity::holds() const {
  if (!low.missed.empty()) return Verdict::missed;
  return low.undecided.empty() ? Verdict::reached : Verdict::undecided;
}

}  // namespace shelfbeam
