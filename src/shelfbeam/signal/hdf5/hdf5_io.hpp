#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
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

template <Hdf5Number T>
using FillRow = std::function<void(std::size_t row, std::span<T> values)>;

/// Writes a new HDF5 file whose bytes depend on what is written alone. Throws InputError when that fails.
class Hdf5Writer {
 public:
  /// `name` stands for the file in errors.
  Hdf5Writer(const std::filesystem::path& path, const std::string& name);
  ~Hdf5Writer();

  void group(const std::string& path);
  template <Hdf5Number T>
  void numbers(const std::string& path, std::span<const T> values, const Shape& shape);
  /// A matrix row by row, of which a few are in memory at a time.
  template <Hdf5Number T>
  void rows(const std::string& path, const Shape& shape, const FillRow<T>& fill);
  void texts(const std::string& path, std::span<const std::string> values);  ///< one-dimensional

  template <Hdf5Number T>
  void attribute(const std::string& name, T value);
  void attribute(const std::string& name, const std::string& value);

  void close();  ///< without it the file is not complete

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Reads an HDF5 file. What is missing, of another type or shape, or larger than the file can hold throws
/// InputError before memory is taken for it.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();

  /// Whether there is a data set of that name, or something damaged that may be one.
  bool has(const std::string& path) const;
  /// The number of entries of a one-dimensional data set.
  std::size_t length(const std::string& path) const;
  template <Hdf5Number T>
  std::vector<T> numbers(const std::string& path, const Shape& shape) const;
  std::vector<std::string> texts(const std::string& path, std::size_t count) const;

  bool has_attribute(const std::string& name) const;
  template <Hdf5Number T>
  T attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace shelfbeam::detail
