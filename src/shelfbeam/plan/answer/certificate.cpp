#include "shelfbeam/plan/answer/certificate.hpp"

#include <algorithm>

namespace shelfbeam {

std::size_t Certificate::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::count_if(
      labels.begin(), labels.end(), [&](const LabelVerdict& label) { return label.verdict == verdict; }));
}

}  // namespace shelfbeam
