#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/signal/parts/part_files.hpp"

namespace shelfbeam {

/// States of a shop that were simulated for a plan, in parts. Only one state is in memory at a time.
class SampledStates {
 public:
  /// Throws InputError as `merge_parts`, and if the parts do not serve a plan.
  explicit SampledStates(std::span<const std::filesystem::path> parts);

  std::uint32_t count() const { return static_cast<std::uint32_t>(places_.size()); }
  /// Throws InputError unless they are of this store and seed, with these labels and candidates, and at least
  /// this number of states.
  void expect(const std::string& store_hash, std::uint64_t seed, std::size_t labels, std::size_t candidates,
              std::uint32_t states) const;
  /// The signals of all labels in state k, by label and candidate. Throws InputError for a corrupt file.
  SignalLayer state(std::uint32_t k) const;

 private:
  struct Place {
    std::size_t part;
    std::uint32_t state;  ///< within the part
  };
  std::vector<detail::SignalPart> parts_;
  std::vector<Place> places_;
  Provenance provenance_;
  std::size_t labels_ = 0, candidates_ = 0;
};

}  // namespace shelfbeam
