#pragma once

#include <array>
#include <optional>
#include <string>

#include "shelfbeam/base/decisive_value.hpp"
#include "shelfbeam/device/emission.hpp"
#include "shelfbeam/device/responsivity.hpp"

namespace shelfbeam {

/// A kind of electronic shelf label.
struct LabelType {
  std::string name;
  Responsivity responsivity;
  std::array<double, 2> size{};  ///< width (horizontal), height, m; signal averaged over the area; 0: a point
  double threshold = 0;          ///< tau, in the signal's unit of measure (W/m^2 for the cosine response)
  double safety_factor = 1;      ///< gamma
  double link_cost = 0;          ///< c^E (3.3)
  double signal_cost = 0;        ///< delta (3.14)
  double availability = 0.95;    ///< least share of the states of a shop in which a label is reached
  /// Distance at which the unit that gives the threshold is just heard ("hears ... at_m"), m; 0 for a number.
  double range_m = 0;
  std::string range_of{};  ///< name of the type of this unit
  // For people and for choosing a product; no result depends on them, and they are not part of store_hash.
  TypeOrigin origin{};
  std::string order_number{};
  std::string picture{};          ///< a data URI (device/picture.hpp)
  std::optional<double> price{};  ///< of one label

  double requirement() const { return safety_factor * threshold; }
};

/// A kind of transceiver: a point or a flat disc that emits but blocks no light. Every element of a disc of
/// area A emits I(omega) / A.
struct TransceiverType {
  std::string name;
  Emission emission;
  double radius = 0;      ///< radius of the disc about the axis, m; 0: a point
  double cost = 1;        ///< c^T (3.3)
  bool has_cost = false;  ///< `cost` is not the default
  std::string file{};     ///< name of the photometric file of the emission; empty without such a file
  // For people; no result depends on them, and they are not part of store_hash. Empty if not given.
  TypeOrigin origin{};
  std::string order_number{};
  std::string fixing{};   ///< "magnet on the T-bar"
  std::string picture{};  ///< a data URI (device/picture.hpp)
};

}  // namespace shelfbeam
