#include "shelfbeam/signal/hdf5/write_signal_file.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/signal_members.hpp"

namespace shelfbeam {

namespace {

using Quantity = SignalRows::Quantity;

template <class T>
void copy_row(const std::vector<T>& from, std::size_t row, std::span<T> values) {
  const auto part = std::span(from).subspan(row * values.size(), values.size());
  std::copy(part.begin(), part.end(), values.begin());
}

class MatrixWriter {
 public:
  MatrixWriter(const SignalMatrix& head, const SignalRows& rows, detail::Hdf5Writer& file)
      : matrix_(head), rows_(rows), file_(file) {}

  void write(const std::optional<StateTensor>& of_states, const std::optional<MatrixPart>& of_part) {
    const Provenance& provenance = matrix_.provenance;
    file_.attribute("format_version", signal_format_version);
    file_.attribute("program_version", provenance.program_version);
    file_.attribute("store_hash", provenance.store_hash);
    file_.attribute("seed", provenance.seed);
    file_.attribute("estimator", provenance.estimator);
    if (provenance.light_hash) file_.attribute("light_hash", *provenance.light_hash);
    if (!provenance.complete) file_.attribute("complete", std::uint32_t{0});
    file_.attribute("wavelength_nm", matrix_.wavelength_nm);
    if (!matrix_.currency.empty()) file_.attribute("currency", matrix_.currency);

    entries("/mean", {Quantity::mean});
    entries("/standard_error", {Quantity::standard_error});
    if (rows_.fill_flags)
      file_.rows<std::uint8_t>("/flags", {matrix_.rows(), matrix_.columns()},
                               [&](std::size_t row, auto flags) { rows_.fill_flags(row, flags); });
    entries("/direct", {Quantity::direct});
    layers("bounce", "/bounces", 0, rows_.bounce_layers);
    if (rows_.length_layers > 0) file_.attribute("length_step", matrix_.length_step);
    layers("length", "/lengths", rows_.bounce_layers, rows_.length_layers);
    if (of_states) states(*of_states);
    if (of_part) part(*of_part);

    file_.group("/labels");
    detail::each_label_member([&](const auto& path, auto member) { column(path, matrix_.labels, member); });
    file_.group("/transceivers");
    detail::each_unit_member(
        [&](const auto& path, auto member) { column(path, matrix_.transceivers, member); });
    const auto& units = matrix_.transceivers;
    if (std::any_of(units.begin(), units.end(), [](const TransceiverColumn& unit) { return unit.pinned; }))
      column("/transceivers/pinned", units, &TransceiverColumn::pinned);
    if (!matrix_.excluded.empty()) file_.texts("/transceivers/excluded", matrix_.excluded);
    if (provenance.light_hash) {
      column("/labels/light", matrix_.labels, &LabelRow::light);
      column("/transceivers/light", matrix_.transceivers, &TransceiverColumn::light);
    }
  }

 private:
  template <class Row, class T>
  void column(const std::string& path, const std::vector<Row>& rows, T Row::* member) {
    if constexpr (std::is_same_v<T, Vec3>) {
      std::vector<double> values;
      for (const Row& row : rows)
        values.insert(values.end(), {(row.*member).x, (row.*member).y, (row.*member).z});
      file_.numbers(path, std::span<const double>(values), {rows.size(), 3});
    } else {
      std::vector<detail::Stored<T>> values;
      values.reserve(rows.size());
      for (const Row& row : rows) values.push_back(row.*member);
      if constexpr (std::is_same_v<T, std::string>)
        file_.texts(path, values);
      else
        file_.numbers(path, std::span<const detail::Stored<T>>(values), {rows.size()});
    }
  }
  void entries(const std::string& path, const SignalRows::Source& source) {
    file_.rows<float>(path, {matrix_.rows(), matrix_.columns()},
                      [&](std::size_t row, auto values) { rows_.fill(source, row, values); });
  }
  void layers(const std::string& kind, const std::string& path, std::size_t first, std::size_t count) {
    if (count == 0) return;
    file_.attribute(kind + "_layers", static_cast<std::uint32_t>(count));
    file_.group(path);
    for (std::size_t k = 0; k < count; ++k) {
      const std::string group = fmt::format("{}/{}", path, k);
      file_.group(group);
      entries(group + "/mean", {Quantity::mean, first + k});
      entries(group + "/standard_error", {Quantity::standard_error, first + k});
    }
  }
  void states(const StateTensor& states) {
    const auto matrix = [&](const char* path, const std::vector<float>& from, std::size_t rows) {
      file_.rows<float>(path, {rows, matrix_.columns()},
                        [&](std::size_t row, auto values) { copy_row(from, row, values); });
    };
    file_.attribute("states", states.states);
    file_.group("/states");
    matrix("/states/deviation", states.deviation, matrix_.rows());
    file_.numbers("/states/hard", std::span<const LabelId>(states.hard), {states.hard.size()});
    matrix("/states/signal", states.signal, states.states * states.hard.size());
    if (!states.error.empty())
      matrix("/states/standard_error", states.error, states.states * states.hard.size());
  }

  void part(const MatrixPart& part) {
    file_.attribute("part", part.number);
    file_.attribute("parts", part.count);
    if (part.hard_labels) file_.attribute("hard_labels", *part.hard_labels);
    file_.group("/part");
    file_.numbers("/part/members", std::span<const std::uint32_t>(part.members), {part.members.size()});
  }

  const SignalMatrix& matrix_;
  const SignalRows& rows_;
  detail::Hdf5Writer& file_;
};

// The rows of a SignalMatrix with all entries.
SignalRows rows_of(const SignalMatrix& matrix) {
  SignalRows rows;
  rows.fill = [&matrix](const SignalRows::Source& source, std::size_t row, std::span<float> values) {
    const bool is_mean = source.quantity == Quantity::mean;
    if (!source.layer) {
      copy_row(is_mean                               ? matrix.mean
               : source.quantity == Quantity::direct ? matrix.direct
                                                     : matrix.standard_error,
               row, values);
      return;
    }
    const std::size_t bounces = matrix.by_bounce.size();
    const SignalLayer& layer =
        *source.layer < bounces ? matrix.by_bounce[*source.layer] : matrix.by_length[*source.layer - bounces];
    copy_row(is_mean ? layer.mean : layer.standard_error, row, values);
  };
  if (!matrix.flags.empty())
    rows.fill_flags = [&matrix](std::size_t row, std::span<std::uint8_t> flags) {
      copy_row(matrix.flags, row, flags);
    };
  rows.bounce_layers = matrix.by_bounce.size();
  rows.length_layers = matrix.by_length.size();
  return rows;
}

void write(const SignalMatrix& head, const SignalRows& rows, AtomicFile& target,
           const std::optional<StateTensor>& states = {}, const std::optional<MatrixPart>& part = {}) {
  detail::Hdf5Writer file(target.temporary(), target.target().string());
  MatrixWriter(head, rows, file).write(states, part);
  file.close();
}

void expect_entries(const SignalMatrix& matrix) {
  const std::size_t size = matrix.rows() * matrix.columns();
  if (size == 0 || matrix.mean.size() != size || matrix.standard_error.size() != size ||
      matrix.direct.size() != size || (!matrix.flags.empty() && matrix.flags.size() != size))
    throw std::invalid_argument(
        "write_signal_file: a matrix without entries or with arrays of different sizes");
}

}  // namespace

void write_signal_file(const SignalMatrix& matrix, AtomicFile& target) {
  expect_entries(matrix);
  write(matrix, rows_of(matrix), target);
}

void write_signal_file(const SignalMatrix& matrix, const std::filesystem::path& path) {
  AtomicFile target(path);
  write_signal_file(matrix, target);
  target.commit();
}

void write_signal_file(const StoredSignals& signals, const std::filesystem::path& path) {
  expect_entries(signals);
  write_signal_file(signals, rows_of(signals), path);
}

void write_signal_file(const StoredSignals& head, const SignalRows& rows, const std::filesystem::path& path) {
  AtomicFile target(path);
  write(head, rows, target, head.states, head.part);
  target.commit();
}

}  // namespace shelfbeam
