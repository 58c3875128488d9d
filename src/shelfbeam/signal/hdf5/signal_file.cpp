#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include <cmath>
#include <span>
#include <type_traits>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/signal/hdf5/file_checksum.hpp"
#include "shelfbeam/signal/hdf5/hdf5_io.hpp"
#include "shelfbeam/signal/hdf5/signal_members.hpp"
#include "shelfbeam/signal/hdf5/signal_part.hpp"
#include "shelfbeam/signal/text_file.hpp"

namespace shelfbeam {

namespace {

void expect_hdf5(const std::filesystem::path& path) {
  if (!is_hdf5(path)) throw InputError(path.string(), "is not an HDF5 file", "use the output of 'simulate'");
}

}  // namespace

namespace detail {

class MatrixReader {
 public:
  explicit MatrixReader(const std::filesystem::path& path) : name_(path.string()), file_(path) {}

  bool is_part() const { return file_.has_attribute("parts"); }

  // The signals of states of a part are read one by one.
  StoredSignals read() const {
    if (!file_.has_attribute("format_version"))
      throw InputError(name_, "is an HDF5 file but not a signal file", "use the output of 'simulate'");
    expect_format_version(name_, file_.attribute<std::uint32_t>("format_version"), signal_format_version);
    StoredSignals matrix;
    matrix.provenance = {file_.text_attribute("program_version"), file_.text_attribute("store_hash"),
                         file_.attribute<std::uint64_t>("seed"), file_.text_attribute("estimator")};
    if (file_.has_attribute("complete"))
      matrix.provenance.complete = file_.attribute<std::uint32_t>("complete") != 0;
    matrix.wavelength_nm = file_.attribute<double>("wavelength_nm");
    if (file_.has_attribute("currency")) matrix.currency = file_.text_attribute("currency");

    const std::size_t m = file_.length("/labels/id"), n = file_.length("/transceivers/id");
    if (m == 0 || n == 0) throw InputError(name_, "has no labels or no transceivers", "simulate it again");
    // Reading the ids first verifies m and n before arrays of these sizes are allocated.
    each_label_member([&](const auto& path, auto member) { column(path, m, matrix.labels, member); });
    each_unit_member([&](const auto& path, auto member) { column(path, n, matrix.transceivers, member); });
    if (file_.has("/transceivers/pinned"))
      column("/transceivers/pinned", n, matrix.transceivers, &TransceiverColumn::pinned);
    if (file_.has("/transceivers/excluded"))
      matrix.excluded = printable_texts("/transceivers/excluded", file_.length("/transceivers/excluded"));
    // Other programs may copy the attributes alone.
    if (file_.has_attribute("light_hash") && file_.has("/labels/light") && file_.has("/transceivers/light")) {
      matrix.provenance.light_hash = file_.text_attribute("light_hash");
      column("/labels/light", m, matrix.labels, &LabelRow::light);
      column("/transceivers/light", n, matrix.transceivers, &TransceiverColumn::light);
    }

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
    if (is_part()) {
      matrix.part = part();
      if (matrix.part->members.size() != (matrix.states ? matrix.states->states : matrix.rows()))
        fail("/part/members", "differs in length from the part");
    }
    return matrix;
  }

  MatrixPart part() const {
    MatrixPart part;
    part.number = file_.attribute<std::uint32_t>("part");
    part.count = file_.attribute<std::uint32_t>("parts");
    if (part.count == 0 || part.number == 0 || part.number > part.count)
      fail("attribute part", fmt::format("is {} of {}", part.number, part.count));
    part.members = file_.numbers<std::uint32_t>("/part/members", {file_.length("/part/members")});
    for (std::size_t k = 1; k < part.members.size(); ++k)
      if (part.members[k] <= part.members[k - 1])
        fail(fmt::format("/part/members, row {}", k + 1), "is not in ascending order");
    if (file_.has_attribute("hard_labels")) part.hard_labels = file_.attribute<std::uint32_t>("hard_labels");
    return part;
  }

  bool serves_plan() const { return file_.has_attribute("states") && file_.has("/states/standard_error"); }

  // The signals of all labels in the part's state k, with their errors if it serves a plan.
  SignalLayer state(std::uint32_t k, std::size_t m, std::size_t n) const {
    const auto read = [&](const char* path) {
      auto values = file_.numbers_of_rows(path, k * m, {m, n});
      expect_signals(path, values, k * m, n);
      return values;
    };
    SignalLayer layer{read("/states/signal"), {}};
    if (serves_plan()) layer.standard_error = read("/states/standard_error");
    return layer;
  }

 private:
  [[noreturn]] void fail(const std::string& place, std::string_view problem) const {
    throw InputError(name_ + ": " + place, std::string(problem), "simulate or export it again");
  }

  template <class Row, class T>
  void column(const std::string& path, std::size_t count, std::vector<Row>& rows, T Row::* member) const {
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
    tensor.hard = file_.numbers<LabelId>("/states/hard", {h});
    for (std::size_t k = 0; k < h; ++k)
      if (tensor.hard[k] >= matrix.rows() || (k > 0 && tensor.hard[k] <= tensor.hard[k - 1]))
        fail(fmt::format("/states/hard, row {}", k + 1), "is not a label in ascending order");
    if (is_part()) return tensor;
    tensor.signal = file_.numbers<float>("/states/signal", {tensor.states * h, matrix.columns()});
    expect_signals("/states/signal", tensor.signal, 0, matrix.columns());
    return tensor;
  }

  // One state has few batches, so its errors are too uncertain for a judgement of negative signals.
  void expect_signals(const std::string& path, std::span<const float> signal, std::size_t first_row,
                      std::size_t columns) const {
    for (std::size_t k = 0; k < signal.size(); ++k)
      if (const auto problem = amount_problem(std::abs(signal[k])); !problem.empty())
        fail(fmt::format("{}, row {}", path, first_row + k / columns + 1), problem);
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

  // An estimate near zero may be negative, but only by a few standard errors, unless these are of few states.
  std::vector<float> means(const std::string& path, const SignalMatrix& matrix,
                           const std::vector<float>& error) const {
    constexpr float max_errors = 10;
    const bool is_lenient = file_.has_attribute("states");
    return checked<float>(path, matrix, [&](std::size_t k, float value) {
      return amount_problem(is_lenient || -value < max_errors * error[k] ? std::abs(value) : value);
    });
  }

  std::string name_;
  Hdf5Reader file_;
};

SignalPart::SignalPart(const std::filesystem::path& path) : path_(path) {
  expect_hdf5(path);
  reader_ = std::make_unique<MatrixReader>(path);
  if (!reader_->is_part())
    throw InputError(path.string(), "is not a part of a simulation", "merge the parts of a simulation");
  share_ = reader_->part();
}

SignalPart::~SignalPart() = default;
SignalPart::SignalPart(SignalPart&&) noexcept = default;
SignalPart& SignalPart::operator=(SignalPart&&) noexcept = default;

StoredSignals SignalPart::matrix() const {
  return reader_->read();
}

bool SignalPart::serves_plan() const {
  return reader_->serves_plan();
}

SignalLayer SignalPart::state(std::uint32_t k, std::size_t labels, std::size_t units) const {
  return reader_->state(k, labels, units);
}

}  // namespace detail

StoredSignals read_signal_file(const std::filesystem::path& path) {
  expect_hdf5(path);
  const detail::MatrixReader reader(path);
  if (reader.is_part()) {
    const MatrixPart part = reader.part();
    throw InputError(path.string(), fmt::format("is part {} of {} of a simulation", part.number, part.count),
                     "merge all parts to one signal file");
  }
  return reader.read();
}

bool is_hdf5(const std::filesystem::path& path) {
  return detail::read_first_bytes(path, 8) == "\x89HDF\r\n\x1a\n" || detail::has_file_checksum(path);
}

}  // namespace shelfbeam
