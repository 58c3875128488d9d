#include "shelfbeam/signal/tables/matrix_export.hpp"

#include <bit>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

static_assert(std::endian::native == std::endian::little, "NPY files are written in memory byte order");

namespace shelfbeam {

namespace {

/// Writes a file piece by piece; the file appears when it is complete.
class PieceWriter {
 public:
  explicit PieceWriter(const std::filesystem::path& path)
      : name_(path.string()), file_(path), out_(file_.temporary(), std::ios::binary | std::ios::trunc) {}

  void write(std::string_view piece) { out_.write(piece.data(), static_cast<std::streamsize>(piece.size())); }

  void commit() {
    out_.close();
    if (!out_) cannot_write(name_, system_reason());
    file_.commit();
  }

 private:
  std::string name_;
  AtomicFile file_;
  std::ofstream out_;
};

void check_size(const SignalMatrix& matrix, std::span<const float> values) {
  if (values.size() != matrix.rows() * matrix.columns())
    throw std::invalid_argument("matrix export: the values do not have the matrix's size");
}

}  // namespace

void write_matrix_csv(const SignalMatrix& matrix, std::span<const float> values,
                      const std::filesystem::path& path, bool safe) {
  check_size(matrix, values);
  PieceWriter file(path);
  fmt::memory_buffer line;
  const auto end_line = [&] {
    line.push_back('\n');
    file.write({line.data(), line.size()});
    line.clear();
  };
  line.append(std::string_view("label"));
  for (const TransceiverColumn& unit : matrix.transceivers) {
    const std::string id = csv_field(unit.id, safe);
    // Readers determine the separator from the header.
    const bool is_doubtful = !id.starts_with('"') && id.find_first_of(";\t") != std::string::npos;
    fmt::format_to(std::back_inserter(line), ",{}", is_doubtful ? csv_quoted(id) : id);
  }
  end_line();
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    line.append(csv_field(matrix.labels[i].id, safe));
    for (const float value : values.subspan(i * matrix.columns(), matrix.columns()))
      fmt::format_to(std::back_inserter(line), ",{:.9g}", value);
    end_line();
  }
  file.commit();
}

void write_matrix_npy(const SignalMatrix& matrix, std::span<const float> values,
                      const std::filesystem::path& path) {
  check_size(matrix, values);
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   matrix.rows(), matrix.columns());
  // The data must begin at a multiple of 64 bytes. 10 bytes precede this text, and a line break ends it.
  header.append(63 - (header.size() + 10) % 64, ' ');
  header += '\n';
  PieceWriter file(path);
  file.write(std::string_view("\x93NUMPY\x01\x00", 8));
  file.write(
      {std::initializer_list<char>{static_cast<char>(header.size()), static_cast<char>(header.size() >> 8)}
           .begin(),
       2});
  file.write(header);
  file.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  file.commit();
}

}  // namespace shelfbeam
