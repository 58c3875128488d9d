#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace shelfbeam::detail {

/// The other end of a pipe is gone, or sent what cannot be.
class BrokenPipe : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sends values to the process at the other end of a pipe, which takes them in the same order and types with
/// PipeReader. The descriptor is the caller's. Throws BrokenPipe.
class PipeWriter {
 public:
  explicit PipeWriter(int descriptor) : descriptor_(descriptor) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(const T& value) { bytes(&value, sizeof value); }
  void operator()(const std::string& text) { values(text); }
  /// Its memory is given back: what is sent is not needed here any more.
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& array) {
    values(array);
    array = {};
  }
  /// Sends what is buffered.
  void flush();

 private:
  template <class Values>
  void values(const Values& sent) {
    (*this)(std::uint64_t{sent.size()});
    bytes(sent.data(), sent.size() * sizeof sent[0]);
  }
  void bytes(const void* data, std::size_t size);

  int descriptor_;
  std::vector<char> buffer_;
};

/// Takes what PipeWriter sends, but never more than `memory` bytes in one array. Throws BrokenPipe.
class PipeReader {
 public:
  PipeReader(int descriptor, std::size_t memory) : descriptor_(descriptor), memory_(memory) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { bytes(&value, sizeof value); }
  void operator()(std::string& text) { values(text); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& array) { values(array); }

 private:
  template <class Values>
  void values(Values& taken) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > memory_ / sizeof taken[0]) throw BrokenPipe("an array is larger than the memory");
    taken.resize(count);
    bytes(taken.data(), count * sizeof taken[0]);
  }
  void bytes(void* data, std::size_t size);

  int descriptor_;
  std::size_t memory_;
};

}  // namespace shelfbeam::detail
