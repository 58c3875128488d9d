#pragma once

#include <cstddef>
#include <string>

namespace shelfbeam {

/// The memory of a scene, estimated before it is allocated.
class SceneMemory {
 public:
  explicit SceneMemory(std::size_t limit) : limit_(limit) {}

  /// Throws InputError with this location if the sum exceeds the limit.
  void add(double bytes, const std::string& where);
  double bytes() const { return bytes_; }

 private:
  std::size_t limit_;
  double bytes_ = 0;
};

}  // namespace shelfbeam
