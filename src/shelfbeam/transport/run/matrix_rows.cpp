#include "shelfbeam/transport/run/matrix_rows.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/transport/world/rough_coats.hpp"

namespace shelfbeam::detail {

using Quantity = SignalRows::Quantity;

MatrixRows::MatrixRows(const Estimator& estimator, const std::vector<ItemSums>& sums,
                       const AnalyticDirect& analytic_direct, std::size_t rows, std::size_t bounce_layers,
                       std::size_t length_layers)
    : estimator_(estimator),
      sums_(sums),
      analytic_direct_(analytic_direct),
      bounce_layers_(bounce_layers),
      length_layers_(length_layers),
      starts_(rows + 1) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t item = 0; item < estimator.items(); ++item) {
    const bool is_tall = estimator.block(item).rows.size() == rows;
    (is_tall ? tall_ : others).push_back(item);
  }
  for (const std::uint32_t item : others)
    for (const LabelId row : estimator.block(item).rows) ++starts_[row + 1];
  for (std::size_t row = 0; row < rows; ++row) starts_[row + 1] += starts_[row];
  parts_.resize(starts_.back());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (const std::uint32_t item : others) {
    const auto& of_item = estimator.block(item).rows;
    for (std::uint32_t r = 0; r < of_item.size(); ++r) parts_[next[of_item[r]]++] = {item, r};
  }
}

// Fills a row with known(j) for each column j, plus sampled(item's sums, entry) for the entries of items.
template <class Known, class Sampled>
void MatrixRows::fill_with(std::size_t row, std::span<float> values, const Known& known,
                           const Sampled& sampled) const {
  for (std::size_t j = 0; j < values.size(); ++j) values[j] = static_cast<float>(known(j));
  each_item(row, [&](std::size_t item, std::size_t r) {
    const auto& columns = estimator_.block(item).columns;
    for (std::size_t c = 0; c < columns.size(); ++c)
      values[columns[c]] =
          static_cast<float>(sampled(sums_[item], r * columns.size() + c) + known(columns[c]));
  });
}

void MatrixRows::fill(Quantity quantity, std::size_t row, std::span<float> values) const {
  const auto known = [&](std::size_t j) {
    const double mirrored = quantity == Quantity::mean ? analytic_direct_.mirrored(row, j) : 0;
    return quantity == Quantity::standard_error ? 0 : analytic_direct_.straight(row, j) + mirrored;
  };
  fill_with(row, values, known, [&](const ItemSums& sums, std::size_t entry) {
    return quantity == Quantity::mean     ? sums.entry(entry).mean()
           : quantity == Quantity::direct ? sums.direct(entry)
                                          : sums.entry(entry).standard_error();
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
    return layer == 0 ? analytic_direct_.straight(row, j) : analytic_direct_.mirrored(row, j);
  };
  fill_with(row, values, known, [&](const ItemSums& sums, std::size_t entry) {
    const PowerSums found = sums.layer_entry(layer, entry);
    return is_mean ? found.mean() : found.standard_error();
  });
}

SignalRows MatrixRows::of(std::span<const LabelId> labels) const {
  const auto fill_row = [this, labels](const SignalRows::Source& source, std::size_t k,
                                       std::span<float> values) {
    if (source.layer)
      fill_layer(*source.layer, source.quantity, labels[k], values);
    else
      fill(source.quantity, labels[k], values);
  };
  return {fill_row, [this, labels](std::size_t k, auto flags) { fill_flags(labels[k], flags); },
          bounce_layers_, length_layers_};
}

std::uint32_t MatrixRows::batches(std::size_t row) const {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  each_item(row, [&](std::size_t item, std::size_t) { fewest = std::min(fewest, sums_[item].batches); });
  return fewest == std::numeric_limits<std::uint32_t>::max() ? 0 : fewest;
}

namespace {

LabelRow describe(const Scene& scene, const Label& label) {
  const LabelType& type = scene.type_of(label);
  LabelRow row;
  row.id = label.id;
  row.type = type.name;
  row.position = label.position;
  row.normal = label.normal;
  row.requirement = scene.requirement_of(label);
  row.link_cost = type.link_cost;
  row.signal_cost = type.signal_cost;
  return row;
}

TransceiverColumn describe(const Scene& scene, const Transceiver& unit) {
  const TransceiverType& type = scene.type_of(unit);
  return {unit.id, type.name, unit.position, unit.axis, type.cost, unit.installed, unit.pinned};
}

}  // namespace

void set_light(SignalMatrix& matrix, const Scene& scene) {
  const std::optional<Scene> rough = with_rough_coats(scene);
  const LightKeys keys = light_keys(rough ? *rough : scene);
  matrix.provenance.light_hash = keys.light_hash;
  for (std::size_t i = 0; i < keys.labels.size(); ++i) matrix.labels[i].light = keys.labels[i];
  for (std::size_t j = 0; j < keys.transceivers.size(); ++j)
    matrix.transceivers[j].light = keys.transceivers[j];
}

SignalMatrix matrix_head(const Scene& scene, const std::string& hash, std::uint64_t seed,
                         const std::string& estimator) {
  SignalMatrix matrix;
  for (const Label& label : scene.labels) matrix.labels.push_back(describe(scene, label));
  for (const Transceiver& unit : scene.transceivers) matrix.transceivers.push_back(describe(scene, unit));
  for (const EmittingSurface& surface : scene.emitting_surfaces) {
    matrix.transceivers.emplace_back();
    matrix.transceivers.back().id = surface.id;
  }
  for (const Transceiver& unit : scene.excluded) matrix.excluded.push_back(unit.id);
  matrix.wavelength_nm = scene.wavelength_nm;
  matrix.currency = scene.currency;
  matrix.provenance = {std::string(program_version()), hash, seed, estimator};
  set_light(matrix, scene);
  return matrix;
}

SignalMatrix filled(SignalMatrix head, const SignalRows& rows) {
  const auto fill_all = [&](auto& values, const auto& fill) {
    values.resize(head.rows() * head.columns());
    for (std::size_t i = 0; i < head.rows(); ++i)
      fill(i, std::span(values).subspan(i * head.columns(), head.columns()));
  };
  const auto fill = [&](std::vector<float>& values, const SignalRows::Source& source) {
    fill_all(values, [&](std::size_t i, std::span<float> row) { rows.fill(source, i, row); });
  };
  fill(head.mean, {Quantity::mean});
  fill(head.standard_error, {Quantity::standard_error});
  fill(head.direct, {Quantity::direct});
  fill_all(head.flags, rows.fill_flags);
  const auto fill_layers = [&](std::vector<SignalLayer>& layers, std::size_t first, std::size_t count) {
    layers.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      fill(layers[k].mean, {Quantity::mean, first + k});
      fill(layers[k].standard_error, {Quantity::standard_error, first + k});
    }
  };
  fill_layers(head.by_bounce, 0, rows.bounce_layers);
  fill_layers(head.by_length, rows.bounce_layers, rows.length_layers);
  return head;
}

}  // namespace shelfbeam::detail
