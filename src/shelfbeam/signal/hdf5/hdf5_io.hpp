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

// The little of HDF5 that the signal file needs; hdf5_io.cpp alone includes the library.

namespace shelfbeam::detail {

using Shape = std::vector<std::size_t>;

/// The number types that data sets and attributes hold.
template <class T>
concept Hdf5Number = std::same_as<T, float> || std::same_as<T, double> || std::same_as<T, std::uint8_t> ||
    std::same_as<T, std::uint32_t> || std::same_as<T, std::uint64_t>;

/// What an entry of a data set, or an attribute, is.
struct Hdf5Type {
  enum Kind { real, whole, text } kind;
  std::size_t size;      ///< bytes; a text has zeros behind its end
  bool is_ascii = true;  ///< or UTF-8
};

template <Hdf5Number T>
inline constexpr Hdf5Type hdf5_type{std::floating_point<T> ? Hdf5Type::real : Hdf5Type::whole, sizeof(T)};

template <Hdf5Number T>
using FillRow = std::function<void(std::size_t row, std::span<T> values)>;

/// Writes a new HDF5 file with a checksum, whose bytes depend on what is written alone. Throws OutputError.
class Hdf5Writer {
 public:
  /// `name` stands for the file in errors.
  Hdf5Writer(const std::filesystem::path& path, const std::string& name);
  ~Hdf5Writer();

  void group(const std::string& path);
  template <Hdf5Number T>
  void numbers(const std::string& path, std::span<const T> values, const Shape& shape) {
    write(path, hdf5_type<T>, shape, values.data());
  }
  /// A matrix row by row, of which a few are in memory at a time.
  template <Hdf5Number T>
  void rows(const std::string& path, const Shape& shape, const FillRow<T>& fill) {
    write_rows(path, hdf5_type<T>, shape, [&](std::size_t row, void* values) {
      fill(row, {static_cast<T*>(values), shape[1]});
    });
  }
  void texts(const std::string& path, std::span<const std::string> values);  ///< one-dimensional

  template <Hdf5Number T>
  void attribute(const std::string& name, T value) {
    write_attribute(name, hdf5_type<T>, &value);
  }
  void attribute(const std::string& name, const std::string& value);

  void close();  ///< without it the file is not complete

 private:
  void write(const std::string& path, Hdf5Type type, const Shape& shape, const void* data);
  void write_rows(const std::string& path, Hdf5Type type, const Shape& shape,
                  const std::function<void(std::size_t row, void* values)>& fill);
  void write_attribute(const std::string& name, Hdf5Type type, const void* value);

  struct File;
  std::unique_ptr<File> file_;
};

/// Reads an HDF5 file. What is missing, of another type or shape, or too large for the memory throws
/// InputError, and before the library sees it, any damage to a file with a checksum. Others the library reads
/// as they are: one that somebody made for the purpose can do harm.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();

  /// Whether there is a data set of that name, or something damaged that may be one.
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
  /// The type of a data set, which is of that kind and shape, was written and fits into the memory.
  Hdf5Type type_of(const std::string& path, Hdf5Type::Kind kind, const Shape& shape) const;
  Hdf5Type type_of_attribute(const std::string& name, Hdf5Type::Kind kind) const;
  void read(const std::string& path, Hdf5Type type, void* data) const;
  void read_attribute(const std::string& name, Hdf5Type type, void* value) const;

  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace shelfbeam::detail
