#include "shelfbeam/report/data/bill.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/report/data/report_data.hpp"

namespace shelfbeam {

Bill bill_of(const ReportInput& input) {
  std::map<std::pair<std::string, double>, BillLine> lines;
  for (const std::uint32_t column : input.plan.placement.selected) {
    const TransceiverColumn& unit = input.matrix.transceivers[column];
    BillLine& line = lines[{unit.type, unit.cost}];
    (unit.installed ? line.installed : line.fresh) += 1;
    line.pinned += unit.pinned ? 1 : 0;
  }
  Bill bill;
  for (auto& [key, line] : lines) {
    line.type = key.first;
    line.price = key.second;
    if (const TransceiverType* const type = unit_type(input.scene, line.type))
      line.order_number = type->order_number;
    bill.amount += line.amount();
    bill.lines.push_back(std::move(line));
  }
  // Prices may come from another file than the types.
  const auto& price = input.plan.placement.price;
  bill.has_prices = price && std::abs(bill.amount - price->to_spend) < 0.005;
  return bill;
}

std::string bill_csv(const ReportInput& input) {
  const Bill bill = bill_of(input);
  const auto text = [&](std::string_view field) { return csv_field(field, input.safe_csv); };
  const std::string currency = bill.has_prices ? text(input.plan.placement.price->currency) : "";
  std::string csv = "type,order_number,to_buy,installed,price_each,price,currency\n";
  for (const BillLine& line : bill.lines)
    csv += fmt::format("{},{},{},{},{},{},{}\n", text(line.type), text(line.order_number), line.fresh,
                       line.installed, bill.has_prices ? csv_number(line.price) : "",
                       bill.has_prices ? csv_number(line.amount()) : "", currency);
  return csv;
}

}  // namespace shelfbeam
