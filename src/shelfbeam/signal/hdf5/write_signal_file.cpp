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
    file_.attribute("wavelength_nm", matrix_.wavelength_nm);
    if (!matrix_.currency.empty()) file_.attribute("currency", matrix_.currency);

    entries("/mean", Quantity::mean);
    entries("/standard_error", Quantity::standard_error);
    if (rows_.has_flags())
      file_.rows<std::uint8_t>("/flags", {matrix_.rows(), matrix_.columns()},
                               [&](std::size_t row, auto flags) { rows_.fill_flags(row, flags); });
    entries("/direct", Quantity::direct);
    layers("bounce", "/bounces", 0, rows_.bounce_layers());
    if (rows_.length_layers() > 0) file_.attribute("length_step", matrix_.length_step);
    layers("length", "/lengths", rows_.bounce_layers(), rows_.length_layers());
    if (of_states) states(*of_states);
    if (of_part) part(*of_part);

    file_.group("/labels");
    detail::each_label_member([&](const auto& path, auto member) { column(path, matrix_.labels, member); });
    file_.group("/transceivers");
    detail::each_unit_member(
        [&](const auto& path, auto member) { column(path, matrix_.transceivers, member); });
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
  void entries(const std::string& path, Quantity quantity) {
    file_.rows<float>(path, {matrix_.rows(), matrix_.columns()},
                      [&](std::size_t row, auto values) { rows_.fill(quantity, row, values); });
  }
  void layer(const std::string& path, std::size_t k, Quantity quantity) {
    file_.rows<float>(path, {matrix_.rows(), matrix_.columns()},
                      [&](std::size_t row, auto values) { rows_.fill_layer(k, quantity, row, values); });
  }
  void layers(const std::string& kind, const std::string& path, std::size_t first, std::size_t count) {
    if (count == 0) return;
    file_.attribute(kind + "_layers", static_cast<std::uint32_t>(count));
    file_.group(path);
    for (std::size_t k = 0; k < count; ++k) {
      const std::string group = fmt::format("{}/{}", path, k);
      file_.group(group);
      layer(group + "/mean", first + k, Quantity::mean);
      layer(group + "/standard_error", first + k, Quantity::standard_error);
    }
  }
  void states(const StateTensor& states) {
    const std::size_t n = matrix_.columns();
    const auto matrix = [&](const char* path, const std::vector<float>& from, std::size_t rows) {
      file_.rows<float>(path, {rows, n}, [&](std::size_t row, auto values) {
        const auto part = std::span(from).subspan(row * n, n);
        std::copy(part.begin(), part.end(), values.begin());
      });
    };
    file_.attribute("states", states.states);
    file_.group("/states");
    matrix("/states/deviation", states.deviation, matrix_.rows());
    file_.numbers("/states/hard", std::span<const std::uint32_t>(states.hard), {states.hard.size()});
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
class OwnRows : public SignalRows {
 public:
  explicit OwnRows(const SignalMatrix& matrix) : matrix_(matrix) {}

  void fill(Quantity quantity, std::size_t row, std::span<float> values) const override {
    copy(quantity == Quantity::mean     ? matrix_.mean
         : quantity == Quantity::direct ? matrix_.direct
                                        : matrix_.standard_error,
         row, values);
  }
  bool has_flags() const override { return !matrix_.flags.empty(); }
  void fill_flags(std::size_t row, std::span<std::uint8_t> flags) const override {
    copy(matrix_.flags, row, flags);
  }
  void fill_layer(std::size_t layer, Quantity quantity, std::size_t row,
                  std::span<float> values) const override {
    const SignalLayer& part = layer_of(layer);
    copy(quantity == Quantity::mean ? part.mean : part.standard_error, row, values);
  }
  std::size_t bounce_layers() const override { return matrix_.by_bounce.size(); }
  std::size_t length_layers() const override { return matrix_.by_length.size(); }

 private:
  const SignalLayer& layer_of(std::size_t layer) const {
    const std::size_t bounces = matrix_.by_bounce.size();
    return layer < bounces ? matrix_.by_bounce[layer] : matrix_.by_length[layer - bounces];
  }
  template <class T>
  static void copy(const std::vector<T>& from, std::size_t row, std::span<T> values) {
    const auto part = std::span(from).subspan(row * values.size(), values.size());
    std::copy(part.begin(), part.end(), values.begin());
  }

  const SignalMatrix& matrix_;
};

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
  write(matrix, OwnRows(matrix), target);
}

void write_signal_file(const SignalMatrix& matrix, const std::filesystem::path& path) {
  AtomicFile target(path);
  write_signal_file(matrix, target);
  target.commit();
}

void write_signal_file(const StoredSignals& signals, const std::filesystem::path& path) {
  expect_entries(signals);
  write_signal_file(signals, OwnRows(signals), path);
}

void write_signal_file(const StoredSignals& head, const SignalRows& rows, const std::filesystem::path& path) {
  AtomicFile target(path);
  write(head, rows, target, head.states, head.part);
  target.commit();
}

}  // namespace shelfbeam
