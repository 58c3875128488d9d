#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

// Calls apply(row, field) for every line after the header, with the row of `rows` that its id names.
template <class Rows, class Apply>
void for_each_line(CsvReader& csv, Rows& rows, std::string_view kind, const Apply& apply) {
  const std::size_t width = csv.fields().size();
  std::unordered_map<std::string_view, std::size_t> row_of;
  for (std::size_t i = 0; i < rows.size(); ++i) row_of.emplace(rows[i].id, i);
  std::unordered_set<std::size_t> seen;
  while (csv.next()) {
    if (csv.fields().size() != width)
      csv.fail(fmt::format("has {} fields where {} are expected", csv.fields().size(), width),
               "correct the line");
    const auto found = row_of.find(csv.id(0));
    if (found == row_of.end()) {
      std::vector<std::string_view> known;
      known.reserve(rows.size());
      for (const auto& row : rows) known.push_back(row.id);
      const std::string near = nearest(csv.id(0), known);
      csv.fail(0, fmt::format("the matrix has no {} '{}'", kind, csv.id(0)),
               near.empty() ? "correct the id or remove the line" : fmt::format("did you mean '{}'?", near));
    }
    if (!seen.insert(found->second).second)
      csv.fail(0, fmt::format("names {} '{}' a second time", kind, csv.id(0)), "remove one of the lines");
    for (std::size_t field = 1; field < width; ++field) apply(rows[found->second], field);
  }
}

}  // namespace

void apply_costs(SignalTable& table, const std::filesystem::path& path) {
  const std::string text = detail::read_text_file(path);
  CsvReader csv(text, path.string());
  if (!csv.next()) csv.fail("is empty", "its first line is 'id,cost' or 'id,link_cost,signal_cost'");

  const std::vector<std::string> header(csv.fields().begin(), csv.fields().end());
  constexpr std::array<std::string_view, 3> costs = {"cost", "link_cost", "signal_cost"};
  for (std::size_t i = 0; i < header.size(); ++i) {
    const bool known =
        i == 0 ? header[i] == "id" : std::find(costs.begin(), costs.end(), header[i]) != costs.end();
    if (!known)
      csv.fail(i, fmt::format("'{}' is no column of a cost file", header[i]),
               "the first line is 'id,cost' or 'id,link_cost,signal_cost'");
    if (std::find(header.begin(), header.begin() + static_cast<std::ptrdiff_t>(i), header[i]) !=
        header.begin() + static_cast<std::ptrdiff_t>(i))
      csv.fail(i, fmt::format("has a second column '{}'", header[i]), "remove one of them");
  }
  const bool of_transceivers = std::find(header.begin(), header.end(), "cost") != header.end();
  if (header.size() < 2 || (of_transceivers && header.size() > 2))
    csv.fail("is neither a cost file of transceivers nor one of labels",
             "the first line is 'id,cost' or 'id,link_cost,signal_cost'");

  if (of_transceivers) {
    for_each_line(csv, table.transceivers, "transceiver",
                  [&](SignalTable::Transceiver& unit, std::size_t field) { unit.cost = csv.amount(field); });
  } else {
    for_each_line(csv, table.labels, "label", [&](SignalTable::Label& label, std::size_t field) {
      (header[field] == "link_cost" ? label.link_cost : label.signal_cost) = csv.amount(field);
    });
  }
}

}  // namespace shelfbeam
