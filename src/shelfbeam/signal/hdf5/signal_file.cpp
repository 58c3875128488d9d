#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"

namespace shelfbeam {

namespace {

using Quantity = SignalRows::Quantity;

// One member of every row as a data set.
template <class Row, class T>
auto gather(const std::vector<Row>& rows, T Row::*member) {
  std::vector<std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(row.*member);
  return values;
}

template <class Row>
std::vector<double> gather(const std::vector<Row>& rows, Vec3 Row::*member) {
  std::vector<double> values;
  values.reserve(3 * rows.size());
  for (const Row& row : rows)
    values.insert(values.end(), {(row.*member).x, (row.*member).y, (row.*member).z});
  return values;
}

class MatrixWriter {
 public:
  MatrixWriter(const SignalMatrix& head, const SignalRows& rows, detail::Hdf5Writer& file)
      : matrix_(head), rows_(rows), file_(file) {}

  void write() {
    const Provenance& provenance = matrix_.provenance;
    file_.attribute("format_version", signal_format_version);
    file_.attribute("program_version", provenance.program_version);
    file_.attribute("store_hash", provenance.store_hash);
    file_.attribute("seed", provenance.seed);
    file_.attribute("estimator", provenance.estimator);
    file_.attribute("wavelength_nm", matrix_.wavelength_nm);

    entries("/mean", Quantity::mean);
    entries("/standard_error", Quantity::standard_error);
    if (rows_.has_flags())
      file_.rows<std::uint8_t>("/flags", {matrix_.rows(), matrix_.columns()},
                               [&](std::size_t row, auto flags) { rows_.fill_flags(row, flags); });
    entries("/direct", Quantity::direct);
    layers("bounce", "/bounces", 0, rows_.bounce_layers());
    if (rows_.length_layers() > 0) file_.attribute("length_step", matrix_.length_step);
    layers("length", "/lengths", rows_.bounce_layers(), rows_.length_layers());

    const auto& labels = matrix_.labels;
    file_.group("/labels");
    file_.texts("/labels/id", gather(labels, &LabelRow::id));
    file_.texts("/labels/type", gather(labels, &LabelRow::type));
    vectors("/labels/position", gather(labels, &LabelRow::position));
    vectors("/labels/normal", gather(labels, &LabelRow::normal));
    numbers("/labels/requirement", gather(labels, &LabelRow::requirement));
    numbers("/labels/link_cost", gather(labels, &LabelRow::link_cost));
    numbers("/labels/signal_cost", gather(labels, &LabelRow::signal_cost));
    numbers("/labels/batches", gather(labels, &LabelRow::batches));
    numbers("/labels/samples", gather(labels, &LabelRow::samples));

    const auto& units = matrix_.transceivers;
    file_.group("/transceivers");
    file_.texts("/transceivers/id", gather(units, &TransceiverColumn::id));
    file_.texts("/transceivers/type", gather(units, &TransceiverColumn::type));
    vectors("/transceivers/position", gather(units, &TransceiverColumn::position));
    vectors("/transceivers/axis", gather(units, &TransceiverColumn::axis));
    numbers("/transceivers/cost", gather(units, &TransceiverColumn::cost));
    numbers("/transceivers/installed", gather(units, &TransceiverColumn::installed));
  }

 private:
  template <class T>
  void numbers(const std::string& path, const std::vector<T>& values) {
    file_.numbers(path, std::span(values), {values.size()});
  }
  void vectors(const std::string& path, const std::vector<double>& values) {
    file_.numbers(path, std::span(values), {values.size() / 3, 3});
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

  const SignalMatrix& matrix_;
  const SignalRows& rows_;
  detail::Hdf5Writer& file_;
};

// The rows of a matrix that has them.
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
    const SignalLayer& asked =
        layer < bounce_layers() ? matrix_.by_bounce[layer] : matrix_.by_length[layer - bounce_layers()];
    copy(quantity == Quantity::mean ? asked.mean : asked.standard_error, row, values);
  }
  std::size_t bounce_layers() const override { return matrix_.by_bounce.size(); }
  std::size_t length_layers() const override { return matrix_.by_length.size(); }

 private:
  template <class T>
  static void copy(const std::vector<T>& from, std::size_t row, std::span<T> values) {
    const auto part = std::span(from).subspan(row * values.size(), values.size());
    std::copy(part.begin(), part.end(), values.begin());
  }

  const SignalMatrix& matrix_;
};

void write(const SignalMatrix& head, const SignalRows& rows, AtomicFile& target) {
  detail::Hdf5Writer file(target.temporary(), target.target().string());
  MatrixWriter(head, rows, file).write();
  file.close();
}

}  // namespace

void write_signal_file(const SignalMatrix& matrix, const std::filesystem::path& path) {
  AtomicFile target(path);
  write_signal_file(matrix, target);
  target.commit();
}

void write_signal_file(const SignalMatrix& matrix, AtomicFile& target) {
  const std::size_t size = matrix.rows() * matrix.columns();
  if (size == 0 || matrix.mean.size() != size || matrix.standard_error.size() != size ||
      matrix.direct.size() != size || (!matrix.flags.empty() && matrix.flags.size() != size))
    throw std::invalid_argument(
        "write_signal_file: a matrix without entries or with arrays of different sizes");
  write(matrix, OwnRows(matrix), target);
}

void write_signal_file(const SignalMatrix& head, const SignalRows& rows, const std::filesystem::path& path) {
  AtomicFile target(path);
  write(head, rows, target);
  target.commit();
}

}  // namespace shelfbeam
