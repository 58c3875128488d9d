#include "shelfbeam/signal/measured/measurements.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

constexpr std::array<std::string_view, 4> columns = {"label", "transceiver", "signal", "error"};
constexpr auto expected =
    "the first line must be 'label,transceiver,signal' or 'label,signal', optionally with 'error'";

using Fields = std::array<std::optional<std::size_t>, columns.size()>;

/// The position of each column.
Fields read_header(CsvReader& csv) {
  if (!csv.next()) csv.fail("is empty", expected);
  Fields fields;
  const std::vector<std::string> names = csv.column_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string& name = names[k];
    const auto* known = std::find(columns.begin(), columns.end(), name);
    if (known == columns.end()) {
      const std::string near = nearest(name, columns);
      csv.fail(k, fmt::format("is the unknown column {}", in_quotes(csv.fields()[k])),
               near.empty() ? expected : fmt::format("did you mean '{}'?", near));
    }
    auto& field = fields[static_cast<std::size_t>(known - columns.begin())];
    if (field) csv.fail(k, fmt::format("is the duplicate column {}", in_quotes(name)), "remove one of them");
    field = k;
  }
  if (!fields[0] || !fields[2]) csv.fail("is missing the column 'label' or 'signal'", expected);
  return fields;
}

/// Throws for values whose squares and ratios would leave the range of a double.
void expect_unit(const CsvReader& csv, std::size_t field, double value) {
  if (value != 0 && std::abs(value) < 1 / max_amount)
    csv.fail(field, fmt::format("is {:g}, which is nearer to 0 than 1e-18", value),
             "use 0, or a smaller unit of measure");
}

}  // namespace

Measurements read_measurements(const std::filesystem::path& path, const SignalMatrix& matrix) {
  const std::string text = detail::read_text_file(path);
  CsvReader csv(text, path.string());
  const auto [label, transceiver, signal, error] = read_header(csv);
  const std::size_t width = csv.fields().size();
  const CsvIdLookup labels(matrix.labels, "label"), transceivers(matrix.transceivers, "transceiver");

  Measurements result;
  result.of_pairs = transceiver.has_value();
  result.has_errors = error.has_value();
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  while (csv.next()) {
    csv.expect_fields(width, width);
    Measurement one;
    one.label = labels.read(csv, *label);
    if (transceiver) one.transceiver = transceivers.read(csv, *transceiver);
    one.signal = csv.number(*signal);
    expect_unit(csv, *signal, one.signal);
    if (error) {
      one.error = csv.number(*error);
      if (*one.error <= 0)
        csv.fail(*error, "is not greater than 0",
                 "an error is the standard deviation of its signal; remove the column if it is unknown");
      expect_unit(csv, *error, *one.error);
    }
    const bool is_new = seen.emplace(one.label, one.transceiver.value_or(0)).second;
    if (!is_new) {
      const std::string pair = transceiver
                                   ? fmt::format("label {} and transceiver {}", in_quotes(csv.id(*label)),
                                                 in_quotes(csv.id(*transceiver)))
                                   : fmt::format("label {}", in_quotes(csv.id(*label)));
      csv.fail(fmt::format("is a duplicate of {}", pair), "average repeated measurements");
    }
    result.values.push_back(one);
  }
  if (result.values.empty()) csv.fail("has only a header", "add a line for every measured signal");
  return result;
}

}  // namespace shelfbeam
