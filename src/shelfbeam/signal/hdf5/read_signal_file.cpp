#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/format_version.hpp"
#include "shelfbeam/base/number.hpp"
#include "shelfbeam/signal/hdf5/file_checksum.hpp"
#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

class MatrixReader {
 public:
  explicit MatrixReader(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  SignalMatrix read() {
    if (!file_.has_attribute("format_version"))
      throw InputError(name_, "is HDF5, but no signal file of this program", "name the output of 'simulate'");
    expect_format_version(name_, file_.attribute<std::uint32_t>("format_version"), signal_format_version);
    SignalMatrix matrix;
    matrix.provenance = {file_.text_attribute("program_version"), file_.text_attribute("store_hash"),
                         file_.attribute<std::uint64_t>("seed"), file_.text_attribute("estimator")};
    matrix.wavelength_nm = file_.attribute<double>("wavelength_nm");

    const std::size_t m = file_.length("/labels/id"), n = file_.length("/transceivers/id");
    if (m == 0 || n == 0) throw InputError(name_, "has no labels or no transceivers", "simulate it again");
    // Before anything of size m or n is made, the reading of their ids shows that there is room.
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

}  // namespace

SignalMatrix read_signal_file(const std::filesystem::path& path) {
  if (!is_hdf5(path)) throw InputError(path.string(), "is no HDF5 file", "name the output of 'simulate'");
  return MatrixReader(path).read();
}

bool is_hdf5(const std::filesystem::path& path) {
  return detail::read_first_bytes(path, 8) == "\x89HDF\r\n\x1a\n" || detail::has_file_checksum(path);
}

}  // namespace shelfbeam
