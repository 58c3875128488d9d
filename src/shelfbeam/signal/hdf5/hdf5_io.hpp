#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/base/ids.hpp"

// The part of HDF5 that signal files require. Only hdf5_io.cpp includes the library.

namespace shelfbeam::detail {

using Shape = std::vector<std::size_t>;

/// The number types of data sets and attributes.
template <class T>
concept Hdf5Number =
    std::same_as<T, float> || std::same_as<T, double> || std::same_as<T, std::uint8_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t> || std::same_as<T, LabelId>;

/// The type of an attribute or of an entry of a data set.
struct Hdf5Type {
  enum Kind { real, whole, text } kind;
  std::size_t size;      ///< bytes; a text is padded with zeros
  bool is_ascii = true;  ///< or UTF-8
};

template <Hdf5Number T>
inline constexpr Hdf5Type hdf5_type{std::floating_point<T> ? Hdf5Type::real : Hdf5Type::whole, sizeof(T)};

template <Hdf5Number T>
using FillRow = std::function<void(std::size_t row, std::span<T> values)>;

/// Writes a new HDF5 file with a checksum. Its bytes depend only on the content. Throws OutputError.
class Hdf5Writer {
 public:
  /// Errors name the file as `name`.
  Hdf5Writer(const std::filesystem::path& path, const std::string& name);
  ~Hdf5Writer();

  void group(const std::string& path);
  template <Hdf5Number T>
  void numbers(const std::string& path, std::span<const T> values, const Shape& shape) {
    write(path, hdf5_type<T>, shape, values.data());
  }
  /// Writes a matrix row by row, with only a few rows in memory at a time.
  template <Hdf5Number T>
  void rows(const std::string& path, const Shape& shape, const FillRow<T>& fill) {
    write_rows(path, hdf5_type<T>, shape,
               [&](std::size_t row, void* values) { fill(row, {static_cast<T*>(values), shape[1]}); });
  }
  void texts(const std::string& path, std::span<const std::string> values);  ///< one-dimensional

  template <Hdf5Number T>
  void attribute(const std::string& name, T value) {
    write_attribute(name, hdf5_type<T>, &value);
  }
  void attribute(const std::string& name, const std::string& value);

  void close();  ///< completes the file

 private:
  void write(const std::string& path, Hdf5Type type, const Shape& shape, const void* data);
  void write_rows(const std::string& path, Hdf5Type type, const Shape& shape,
                  const std::function<void(std::size_t row, void* values)>& fill);
  void write_attribute(const std::string& name, Hdf5Type type, const void* value);

  struct File;
  std::unique_ptr<File> file_;
};

/// Reads an HDF5 file. Throws InputError for data that are missing, of another type or shape, or too large
/// for the memory. A corrupt file with a checksum is rejected before the library opens it. Files without a
/// checksum are not protected: a malicious file can exploit the library.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();

  /// Whether a data set of this name exists, even if it is corrupt.
  bool has(const std::string& path) const;
  /// The number of entries of a one-dimensional data set.
  std::size_t length(const std::string& path) const;
  template <Hdf5Number T>
  std::vector<T> numbers(const std::string& path, const Shape& shape) const {
    type_of(path, hdf5_type<T>.kind, shape);
    std::vector<T> values(std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies()));
    read(path, hdf5_type<T>, values.data());
    return values;
  }
  /// `shape[0]` rows of a matrix with `shape[1]` columns, from row `first` on.
  std::vector<float> numbers_of_rows(const std::string& path, std::size_t first, const Shape& shape) const;
  std::vector<std::string> texts(const std::string& path, std::size_t count) const;

  bool has_attribute(const std::string& name) const;
  template <Hdf5Number T>
  T attribute(const std::string& name) const {
    type_of_attribute(name, hdf5_type<T>.kind);
    T value{};
    read_attribute(name, hdf5_type<T>, &value);
    return value;
  }
  std::string text_attribute(const std::string& name) const;

 private:
  /// The type of a data set. Throws unless it has this kind and shape, was written and fits into memory.
  Hdf5Type type_of(const std::string& path, Hdf5Type::Kind kind, const Shape& shape) const;
  Hdf5Type type_of_attribute(const std::string& name, Hdf5Type::Kind kind) const;
  void read(const std::string& path, Hdf5Type type, void* data) const;
  void read_attribute(const std::string& name, Hdf5Type type, void* value) const;

  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace shelfbeam::detail
