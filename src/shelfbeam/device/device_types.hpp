#pragma once

#include <string>

#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/device/responsivity.hpp"

namespace shelfbeam {

/// A kind of electronic shelf label.
struct LabelType {
  std::string name;
  Responsivity responsivity;
  double threshold = 0;      ///< tau, in the unit of the signal (W/m^2 for the cosine response)
  double safety_factor = 1;  ///< gamma
  double link_cost = 0;      ///< c^E (3.3)
  double signal_cost = 0;    ///< delta (3.14)

  double requirement() const { return safety_factor * threshold; }
};

/// A kind of transceiver: a point that emits without a body of its own.
struct TransceiverType {
  std::string name;
  Emission emission;
  double cost = 1;  ///< c^T (3.3)
};

}  // namespace shelfbeam
