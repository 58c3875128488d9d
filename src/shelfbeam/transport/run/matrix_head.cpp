#include "shelfbeam/transport/run/matrix_head.hpp"

#include <span>

namespace shelfbeam::detail {

namespace {

LabelRow describe(const Scene& scene, const Label& label) {
  const LabelType& type = scene.type_of(label);
  LabelRow row;
  row.id = label.id;
  row.type = type.name;
  row.position = label.position;
  row.normal = label.normal;
  row.requirement = type.requirement();
  row.link_cost = type.link_cost;
  row.signal_cost = type.signal_cost;
  return row;
}

TransceiverColumn describe(const Scene& scene, const Transceiver& unit) {
  const TransceiverType& type = scene.type_of(unit);
  return {unit.id, type.name, unit.position, unit.axis, type.cost, unit.installed};
}

}  // namespace

SignalMatrix matrix_head(const Scene& scene, const std::string& store_hash, std::uint64_t seed,
                         const std::string& estimator) {
  SignalMatrix matrix;
  for (const Label& label : scene.labels) matrix.labels.push_back(describe(scene, label));
  for (const Transceiver& unit : scene.transceivers) matrix.transceivers.push_back(describe(scene, unit));
  for (const EmittingSurface& surface : scene.emitting_surfaces) {
    matrix.transceivers.emplace_back();
    matrix.transceivers.back().id = surface.id;
  }
  matrix.wavelength_nm = scene.wavelength_nm;
  matrix.provenance = {std::string(program_version()), store_hash, seed, estimator};
  return matrix;
}

SignalMatrix filled(SignalMatrix head, const SignalRows& rows) {
  using Quantity = SignalRows::Quantity;
  const std::size_t entries = head.rows() * head.columns();
  const auto fill_all = [&](std::vector<float>& values, const auto& fill) {
    values.resize(entries);
    for (std::size_t i = 0; i < head.rows(); ++i)
      fill(i, std::span(values).subspan(i * head.columns(), head.columns()));
  };
  const auto of_all = [&](Quantity quantity) {
    return [&rows, quantity](std::size_t i, std::span<float> row) { rows.fill(quantity, i, row); };
  };
  fill_all(head.mean, of_all(Quantity::mean));
  fill_all(head.standard_error, of_all(Quantity::standard_error));
  fill_all(head.direct, of_all(Quantity::direct));
  head.flags.resize(entries);
  for (std::size_t i = 0; i < head.rows(); ++i)
    rows.fill_flags(i, std::span(head.flags).subspan(i * head.columns(), head.columns()));
  const auto of_layer = [&](std::size_t layer, Quantity quantity) {
    return [&rows, layer, quantity](std::size_t i, std::span<float> row) {
      rows.fill_layer(layer, quantity, i, row);
    };
  };
  const auto fill_layers = [&](std::vector<SignalLayer>& layers, std::size_t first, std::size_t count) {
    layers.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      fill_all(layers[k].mean, of_layer(first + k, Quantity::mean));
      fill_all(layers[k].standard_error, of_layer(first + k, Quantity::standard_error));
    }
  };
  fill_layers(head.by_bounce, 0, rows.bounce_layers());
  fill_layers(head.by_length, rows.bounce_layers(), rows.length_layers());
  return head;
}

}  // namespace shelfbeam::detail
