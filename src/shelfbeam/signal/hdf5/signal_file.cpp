#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/format_version.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/hdf5/file_checksum.hpp"
#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

using Quantity = SignalRows::Quantity;

// The type in which a member of labels or transceivers is stored.
template <class T>
using Stored = std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>;

// Calls use(path, member) for every member of labels, ids first.
template <class Use>
void each_label_member(const Use& use) {
  use("/labels/id", &LabelRow::id);
  use("/labels/type", &LabelRow::type);
  use("/labels/position", &LabelRow::position);
  use("/labels/normal", &LabelRow::normal);
  use("/labels/requirement", &LabelRow::requirement);
  use("/labels/link_cost", &LabelRow::link_cost);
  use("/labels/signal_cost", &LabelRow::signal_cost);
  use("/labels/batches", &LabelRow::batches);
  use("/labels/samples", &LabelRow::samples);
}
template <class Use>
void each_unit_member(const Use& use) {
  use("/transceivers/id", &TransceiverColumn::id);
  use("/transceivers/type", &TransceiverColumn::type);
  use("/transceivers/position", &TransceiverColumn::position);
  use("/transceivers/axis", &TransceiverColumn::axis);
  use("/transceivers/cost", &TransceiverColumn::cost);
  use("/transceivers/installed", &TransceiverColumn::installed);
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
    states();

    file_.group("/labels");
    each_label_member([&](const auto& path, auto member) { column(path, matrix_.labels, member); });
    file_.group("/transceivers");
    each_unit_member([&](const auto& path, auto member) { column(path, matrix_.transceivers, member); });
  }

 private:
  template <class Row, class T>
  void column(const std::string& path, const std::vector<Row>& rows, T Row::*member) {
    if constexpr (std::is_same_v<T, Vec3>) {
      std::vector<double> values;
      for (const Row& row : rows)
        values.insert(values.end(), {(row.*member).x, (row.*member).y, (row.*member).z});
      file_.numbers(path, std::span<const double>(values), {rows.size(), 3});
    } else {
      std::vector<Stored<T>> values;
      values.reserve(rows.size());
      for (const Row& row : rows) values.push_back(row.*member);
      if constexpr (std::is_same_v<T, std::string>)
        file_.texts(path, values);
      else
        file_.numbers(path, std::span<const Stored<T>>(values), {rows.size()});
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
  void states() {
    const StateTensor& states = matrix_.states;
    if (states.states == 0) return;
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

void write(const SignalMatrix& head, const SignalRows& rows, AtomicFile& target) {
  detail::Hdf5Writer file(target.temporary(), target.target().string());
  MatrixWriter(head, rows, file).write();
  file.close();
}

class MatrixReader {
 public:
  explicit MatrixReader(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  SignalMatrix read() {
    if (!file_.has_attribute("format_version"))
      throw InputError(name_, "is an HDF5 file but not a signal file", "use the output of 'simulate'");
    expect_format_version(name_, file_.attribute<std::uint32_t>("format_version"), signal_format_version);
    SignalMatrix matrix;
    matrix.provenance = {file_.text_attribute("program_version"), file_.text_attribute("store_hash"),
                         file_.attribute<std::uint64_t>("seed"), file_.text_attribute("estimator")};
    matrix.wavelength_nm = file_.attribute<double>("wavelength_nm");
    if (file_.has_attribute("currency")) matrix.currency = file_.text_attribute("currency");

    const std::size_t m = file_.length("/labels/id"), n = file_.length("/transceivers/id");
    if (m == 0 || n == 0) throw InputError(name_, "has no labels or no transceivers", "simulate it again");
    // Reading the ids first verifies m and n before arrays of these sizes are allocated.
    each_label_member([&](const auto& path, auto member) { column(path, m, matrix.labels, member); });
    each_unit_member([&](const auto& path, auto member) { column(path, n, matrix.transceivers, member); });

    matrix.standard_error = entries("/standard_error", matrix);
    matrix.mean = means("/mean", matrix, matrix.standard_error);
    matrix.direct = entries("/direct", matrix);
    if (file_.has("/flags")) matrix.flags = flags("/flags", matrix);
    matrix.by_bounce = layers("bounce", "/bounces", matrix);
    matrix.by_length = layers("length", "/lengths", matrix);
    if (file_.has_attribute("states")) matrix.states = states(matrix);
    if (!matrix.by_length.empty()) {
      matrix.length_step = file_.attribute<double>("length_step");
      if (!(std::isfinite(matrix.length_step) && matrix.length_step > 0))
        fail("attribute length_step", "is not a length");
    }
    return matrix;
  }

 private:
  [[noreturn]] void fail(const std::string& place, std::string_view problem) const {
    throw InputError(name_ + ": " + place, std::string(problem), "simulate or export it again");
  }

  template <class Row, class T>
  void column(const std::string& path, std::size_t count, std::vector<Row>& rows, T Row::*member) const {
    const auto set = [&](auto values) {
      rows.resize(count);
      for (std::size_t i = 0; i < count; ++i) rows[i].*member = static_cast<T>(std::move(values[i]));
    };
    if constexpr (std::is_same_v<T, std::string>)
      set(printable_texts(path, count));
    else if constexpr (std::is_same_v<T, Vec3>)
      set(vectors(path, count));
    else if constexpr (std::is_same_v<T, double>)
      set(amounts(path, count));
    else
      set(file_.numbers<Stored<T>>(path, {count}));
  }

  std::vector<std::string> printable_texts(const std::string& path, std::size_t count) const {
    auto texts = file_.texts(path, count);
    for (std::size_t i = 0; i < texts.size(); ++i)
      if (const std::string character = unprintable_character(texts[i]); !character.empty())
        fail(fmt::format("{}, row {}", path, i + 1),
             fmt::format("has the unprintable character '{}'", character));
    return texts;
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

  StateTensor states(const SignalMatrix& matrix) const {
    StateTensor tensor;
    tensor.states = file_.attribute<std::uint32_t>("states");
    tensor.deviation = entries("/states/deviation", matrix);
    const std::size_t h = file_.length("/states/hard");
    tensor.hard = file_.numbers<std::uint32_t>("/states/hard", {h});
    for (std::size_t k = 0; k < h; ++k)
      if (tensor.hard[k] >= matrix.rows() || (k > 0 && tensor.hard[k] <= tensor.hard[k - 1]))
        fail(fmt::format("/states/hard, row {}", k + 1), "is not a label in ascending order");
    tensor.signal = file_.numbers<float>("/states/signal", {tensor.states * h, matrix.columns()});
    // One state has few batches, so its errors are too uncertain for a judgement of negative signals.
    for (std::size_t k = 0; k < tensor.signal.size(); ++k)
      if (const auto problem = amount_problem(std::abs(tensor.signal[k])); !problem.empty())
        fail(fmt::format("/states/signal, row {}", k / matrix.columns() + 1), problem);
    return tensor;
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

  // Reads a matrix and throws if problem(index, value) reports a problem for any entry.
  template <class T, class Problem>
  std::vector<T> checked(const std::string& path, const SignalMatrix& matrix, const Problem& problem) const {
    auto values = file_.numbers<T>(path, {matrix.rows(), matrix.columns()});
    for (std::size_t k = 0; k < values.size(); ++k)
      if (const auto found = problem(k, values[k]); !found.empty())
        fail(fmt::format("{}, label {}, transceiver {}", path,
                         in_quotes(matrix.labels[k / matrix.columns()].id),
                         in_quotes(matrix.transceivers[k % matrix.columns()].id)),
             found);
    return values;
  }

  std::vector<float> entries(const std::string& path, const SignalMatrix& matrix) const {
    return checked<float>(path, matrix, [](std::size_t, float value) { return amount_problem(value); });
  }

  std::vector<std::uint8_t> flags(const std::string& path, const SignalMatrix& matrix) const {
    return checked<std::uint8_t>(path, matrix, [](std::size_t, std::uint8_t value) {
      return value > 1 ? fmt::format("is {}, which is neither 0 nor 1", value) : std::string();
    });
  }

  // An estimate near zero may be negative, but only by a few standard errors.
  std::vector<float> means(const std::string& path, const SignalMatrix& matrix,
                           const std::vector<float>& error) const {
    constexpr float max_errors = 10;
    return checked<float>(path, matrix, [&](std::size_t k, float value) {
      return amount_problem(-value < max_errors * error[k] ? std::abs(value) : value);
    });
  }

  std::string name_;
  detail::Hdf5Reader file_;
};

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

SignalMatrix read_signal_file(const std::filesystem::path& path) {
  if (!is_hdf5(path)) throw InputError(path.string(), "is not an HDF5 file", "use the output of 'simulate'");
  return MatrixReader(path).read();
}

bool is_hdf5(const std::filesystem::path& path) {
  return detail::read_first_bytes(path, 8) == "\x89HDF\r\n\x1a\n" || detail::has_file_checksum(path);
}

}  // namespace shelfbeam
