#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "shelfbeam/report/data/report.hpp"

namespace shelfbeam {

/// The chosen units of one type at one price.
struct BillLine {
  std::string type = {}, order_number = {};
  double price = 0;           ///< of one unit
  std::size_t fresh = 0;      ///< units to buy
  std::size_t pinned = 0;     ///< of these, chosen by the user
  std::size_t installed = 0;  ///< units that were mounted before

  double amount() const { return price * static_cast<double>(fresh); }
};

struct Bill {
  std::vector<BillLine> lines;  ///< by type, then price
  bool has_prices = false;      ///< the prices sum to that of the placement
  double amount = 0;            ///< of the units to buy
};

Bill bill_of(const ReportInput& input);

}  // namespace shelfbeam
