#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/format_version.hpp"
#include "shelfbeam/base/memory.hpp"
#include "shelfbeam/base/number.hpp"
#include "shelfbeam/signal/hdf5/child_process.hpp"
#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/signal_reading.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

using Quantity = SignalRows::Quantity;

constexpr std::uint32_t format_version = 1;

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
    file_.attribute("format_version", format_version);
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

class MatrixReader {
 public:
  explicit MatrixReader(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  SignalMatrix read() {
    if (!file_.has_attribute("format_version"))
      throw InputError(name_, "is HDF5, but no signal file of this program", "name the output of 'simulate'");
    expect_format_version(name_, file_.attribute<std::uint32_t>("format_version"), format_version);
    SignalMatrix matrix;
    matrix.provenance = {file_.text_attribute("program_version"), file_.text_attribute("store_hash"),
                         file_.attribute<std::uint64_t>("seed"), file_.text_attribute("estimator")};
    matrix.wavelength_nm = file_.attribute<double>("wavelength_nm");

    const std::size_t m = file_.length("/labels/id"), n = file_.length("/transceivers/id");
    if (m == 0 || n == 0) throw InputError(name_, "has no labels or no transceivers", "simulate it again");
    // Before anything of size m or n is made, their ids prove that the file is as large as they say.
    const auto label_ids = file_.texts("/labels/id", m), unit_ids = file_.texts("/transceivers/id", n);
    matrix.labels.resize(m);
    matrix.transceivers.resize(n);
    set(matrix.labels, &LabelRow::id, label_ids);
    set(matrix.labels, &LabelRow::type, file_.texts("/labels/type", m));
    set(matrix.labels, &LabelRow::position, vectors("/labels/position", m));
    set(matrix.labels, &LabelRow::normal, vectors("/labels/normal", m));
    set(matrix.labels, &LabelRow::requirement, amounts("/labels/requirement", m));
    set(matrix.labels, &LabelRow::link_cost, amounts("/labels/link_cost", m));
    set(matrix.labels, &LabelRow::signal_cost, amounts("/labels/signal_cost", m));
    set(matrix.labels, &LabelRow::batches, file_.numbers<std::uint32_t>("/labels/batches", {m}));
    set(matrix.labels, &LabelRow::samples, file_.numbers<std::uint64_t>("/labels/samples", {m}));
    set(matrix.transceivers, &TransceiverColumn::id, unit_ids);
    set(matrix.transceivers, &TransceiverColumn::type, file_.texts("/transceivers/type", n));
    set(matrix.transceivers, &TransceiverColumn::position, vectors("/transceivers/position", n));
    set(matrix.transceivers, &TransceiverColumn::axis, vectors("/transceivers/axis", n));
    set(matrix.transceivers, &TransceiverColumn::cost, amounts("/transceivers/cost", n));
    set(matrix.transceivers, &TransceiverColumn::installed,
        file_.numbers<std::uint8_t>("/transceivers/installed", {n}));

    matrix.standard_error = entries("/standard_error", matrix);
    matrix.mean = means("/mean", matrix, matrix.standard_error);
    matrix.direct = entries("/direct", matrix);
    if (file_.has("/flags")) matrix.flags = flags("/flags", matrix);
    matrix.by_bounce = layers("bounce", "/bounces", matrix);
    matrix.by_length = layers("length", "/lengths", matrix);
    if (!matrix.by_length.empty()) {
      matrix.length_step = file_.attribute<double>("length_step");
      if (!(std::isfinite(matrix.length_step) && matrix.length_step > 0))
        fail("attribute length_step", "is no length");
    }
    return matrix;
  }

 private:
  [[noreturn]] void fail(const std::string& place, std::string_view problem) const {
    throw InputError(name_ + ": " + place, std::string(problem), "simulate or export it again");
  }

  template <class Row, class T, class Values>
  void set(std::vector<Row>& rows, T Row::*member, Values values) const {
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = static_cast<T>(std::move(values[i]));
  }

  std::vector<SignalLayer> layers(const std::string& kind, const std::string& path,
                                  const SignalMatrix& matrix) const {
    std::vector<SignalLayer> layers;
    if (!file_.has_attribute(kind + "_layers")) return layers;
    for (std::uint32_t k = 0; k < file_.attribute<std::uint32_t>(kind + "_layers"); ++k) {
      SignalLayer& layer = layers.emplace_back();
      layer.standard_error = entries(fmt::format("{}/{}/standard_error", path, k), matrix);
      layer.mean = means(fmt::format("{}/{}/mean", path, k), matrix, layer.standard_error);
    }
    return layers;
  }

  std::vector<Vec3> vectors(const std::string& path, std::size_t count) const {
    const auto values = file_.numbers<double>(path, {count, 3});
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i < count; ++i) {
      vectors.push_back({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
      if (!is_finite(vectors.back())) fail(fmt::format("{}, row {}", path, i + 1), "is not finite");
    }
    return vectors;
  }

  std::vector<double> amounts(const std::string& path, std::size_t count) const {
    auto values = file_.numbers<double>(path, {count});
    for (std::size_t i = 0; i < count; ++i)
      if (const auto problem = amount_problem(values[i]); !problem.empty())
        fail(fmt::format("{}, row {}", path, i + 1), problem);
    return values;
  }

  static std::string place(const std::string& path, const SignalMatrix& matrix, std::size_t entry) {
    return fmt::format("{}, label '{}', transceiver '{}'", path, matrix.labels[entry / matrix.columns()].id,
                       matrix.transceivers[entry % matrix.columns()].id);
  }

  std::vector<float> entries(const std::string& path, const SignalMatrix& matrix) const {
    auto values = file_.numbers<float>(path, {matrix.rows(), matrix.columns()});
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const auto problem = amount_problem(values[k]); !problem.empty())
        fail(place(path, matrix, k), problem);
    return values;
  }

  std::vector<std::uint8_t> flags(const std::string& path, const SignalMatrix& matrix) const {
    auto values = file_.numbers<std::uint8_t>(path, {matrix.rows(), matrix.columns()});
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k] > 1)
        fail(place(path, matrix, k), fmt::format("is {}, which is neither 0 nor 1", values[k]));
    return values;
  }

  // An estimate of next to nothing may come out below zero, but not by many errors.
  std::vector<float> means(const std::string& path, const SignalMatrix& matrix,
                           const std::vector<float>& error) const {
    constexpr float most_errors = 10;
    auto values = file_.numbers<float>(path, {matrix.rows(), matrix.columns()});
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const auto problem =
              amount_problem(-values[k] < most_errors * error[k] ? std::abs(values[k]) : values[k]);
          !problem.empty())
        fail(place(path, matrix, k), problem);
    return values;
  }

  std::string name_;
  detail::Hdf5Reader file_;
};

// Every part of a matrix, in the order in which PipeWriter sends and PipeReader takes them.
template <class Pipe>
void pass(Pipe& pipe, LabelRow& row) {
  pipe(row.id), pipe(row.type), pipe(row.position), pipe(row.normal), pipe(row.requirement);
  pipe(row.link_cost), pipe(row.signal_cost), pipe(row.batches), pipe(row.samples);
}

template <class Pipe>
void pass(Pipe& pipe, TransceiverColumn& column) {
  pipe(column.id), pipe(column.type), pipe(column.position), pipe(column.axis), pipe(column.cost);
  pipe(column.installed);
}

template <class Pipe>
void pass(Pipe& pipe, SignalLayer& layer) {
  pipe(layer.mean), pipe(layer.standard_error);
}

template <class Pipe>
void pass(Pipe& pipe, Provenance& provenance) {
  pipe(provenance.program_version), pipe(provenance.store_hash);
  pipe(provenance.seed), pipe(provenance.estimator);
}

template <class Pipe, class Part>
void pass(Pipe& pipe, std::vector<Part>& parts) {
  std::vector<char> places(parts.size());  // a byte for each, so that no number is believed by itself
  pipe(places);
  if constexpr (std::is_same_v<Pipe, detail::PipeReader>) parts.resize(places.size());
  for (Part& part : parts) pass(pipe, part);
}

template <class Pipe>
void pass(Pipe& pipe, SignalMatrix& matrix) {
  pass(pipe, matrix.provenance);
  pipe(matrix.wavelength_nm), pipe(matrix.length_step);
  pass(pipe, matrix.labels);
  pass(pipe, matrix.transceivers);
  pipe(matrix.mean), pipe(matrix.standard_error), pipe(matrix.direct), pipe(matrix.flags);
  pass(pipe, matrix.by_bounce);
  pass(pipe, matrix.by_length);
}

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

SignalMatrix detail::read_signal_file_here(const std::filesystem::path& path) {
  return MatrixReader(path).read();
}

SignalMatrix read_signal_file(const std::filesystem::path& path) {
  if (!is_hdf5(path)) throw InputError(path.string(), "is no HDF5 file", "name the output of 'simulate'");
  // The HDF5 library trusts metadata whose checksums are right, and anyone can make them right. So it works
  // in a process of its own, which may crash or spoil its memory.
  constexpr std::uintmax_t bytes_a_second = 10'000'000;
  const std::chrono::seconds longest(60 + std::filesystem::file_size(path) / bytes_a_second);
  SignalMatrix matrix;
  std::string where, problem;
  const auto give = [&](detail::PipeWriter& pipe) {
    try {
      matrix = detail::read_signal_file_here(path);
    } catch (const InputError& error) {
      where = error.where();
      problem = error.what() + (where.empty() ? 0 : where.size() + 2);
    }
    pipe(where), pipe(problem);
    if (problem.empty()) pass(pipe, matrix);
  };
  const auto take = [&](detail::PipeReader& pipe) {
    pipe(where), pipe(problem);
    if (problem.empty()) pass(pipe, matrix);
  };
  if (!detail::through_child(give, take, longest, most_of_the_memory()))
    throw InputError(path.string(), "is damaged: the HDF5 library cannot read it to its end",
                     "simulate or export it again");
  if (!problem.empty()) throw InputError(where, problem);
  return matrix;
}

bool is_hdf5(const std::filesystem::path& path) {
  return detail::read_first_bytes(path, 8) == "\x89HDF\r\n\x1a\n";
}

}  // namespace shelfbeam
