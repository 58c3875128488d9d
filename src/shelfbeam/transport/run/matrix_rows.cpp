#include "shelfbeam/transport/run/matrix_rows.hpp"

#include <algorithm>
#include <limits>

namespace shelfbeam::detail {

MatrixRows::MatrixRows(const Estimator& estimator, const std::vector<ItemSums>& sums, const KnownLight& known,
                       std::size_t rows, std::size_t bounce_layers, std::size_t length_layers)
    : estimator_(estimator),
      sums_(sums),
      known_(known),
      bounce_layers_(bounce_layers),
      length_layers_(length_layers),
      starts_(rows + 1) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t item = 0; item < estimator.items(); ++item) {
    const bool is_tall = estimator.block(item).rows.size() == rows;
    (is_tall ? tall_ : others).push_back(item);
  }
  for (const std::uint32_t item : others)
    for (const std::uint32_t row : estimator.block(item).rows) ++starts_[row + 1];
  for (std::size_t row = 0; row < rows; ++row) starts_[row + 1] += starts_[row];
  parts_.resize(starts_.back());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (const std::uint32_t item : others) {
    const auto& of_item = estimator.block(item).rows;
    for (std::uint32_t r = 0; r < of_item.size(); ++r) parts_[next[of_item[r]]++] = {item, r};
  }
}

void MatrixRows::fill(Quantity quantity, std::size_t row, std::span<float> values) const {
  const auto known = [&](std::size_t j) {
    switch (quantity) {
      case Quantity::mean:
        return known_.straight(row, j) + known_.mirrored(row, j);
      case Quantity::direct:
        return known_.straight(row, j);
      case Quantity::standard_error:
        break;
    }
    return 0.0;
  };
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = static_cast<float>(known(j));
  each_item(row, [&](std::size_t item, std::size_t r) {
    const auto& columns = estimator_.block(item).columns;
    const ItemSums& sums = sums_[item];
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t entry = r * columns.size() + c, j = columns[c];
      const double sampled = quantity == Quantity::mean     ? sums.entry(entry).mean()
                             : quantity == Quantity::direct ? sums.direct(entry)
                                                            : sums.entry(entry).standard_error();
      values[j] = static_cast<float>(sampled + known(j));
    }
  });
}

void MatrixRows::fill_flags(std::size_t row, std::span<std::uint8_t> flags) const {
  std::fill(flags.begin(), flags.end(), std::uint8_t{0});
  each_item(row, [&](std::size_t item, std::size_t r) {
    const auto& columns = estimator_.block(item).columns;
    for (std::size_t c = 0; c < columns.size(); ++c)
      flags[columns[c]] = sums_[item].entry(r * columns.size() + c).is_skewed() ? 1 : 0;
  });
}

void MatrixRows::fill_layer(std::size_t layer, Quantity quantity, std::size_t row,
                            std::span<float> values) const {
  const bool is_mean = quantity == Quantity::mean;
  const auto known = [&](std::size_t j) {
    if (!is_mean || layer > 1 || layer >= bounce_layers_) return 0.0;
    return layer == 0 ? known_.straight(row, j) : known_.mirrored(row, j);
  };
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = static_cast<float>(known(j));
  each_item(row, [&](std::size_t item, std::size_t r) {
    const auto& columns = estimator_.block(item).columns;
    const ItemSums& sums = sums_[item];
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::size_t entry = r * columns.size() + c, j = columns[c];
      const PowerSums found = sums.layer_entry(layer, entry);
      values[j] = static_cast<float>(is_mean ? found.mean() + known(j) : found.standard_error());
    }
  });
}

std::uint32_t MatrixRows::batches(std::size_t row) const {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  each_item(row, [&](std::size_t item, std::size_t) { fewest = std::min(fewest, sums_[item].batches); });
  return fewest == std::numeric_limits<std::uint32_t>::max() ? 0 : fewest;
}

}  // namespace shelfbeam::detail
