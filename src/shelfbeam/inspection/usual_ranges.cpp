#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/fields/each_key.hpp"
#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/scene/store/device_fields.hpp"

namespace shelfbeam {

namespace {

// Warns of values outside the usual limits of their description.
class UsualRanges final : public EachKey {
 public:
  UsualRanges(const std::string& where, WarningList& warnings) : where_(where), warnings_(warnings) {}

  bool scalar(std::string_view key, Scalar kind, double& value, const Field& field) override {
    const bool is_length = kind == Scalar::length || kind == Scalar::distance || kind == Scalar::extent;
    if (value < field.usual_least || value > field.usual_most)
      warnings_.add(FindingCode::unusual_value, fmt::format("{}.{}", where_, key), "is {:.3g}{}; {}", value,
                    is_length ? " m" : "", field.usual);
    return false;
  }
  void key(std::string_view, const Field&) override {}

 private:
  const std::string& where_;
  WarningList& warnings_;
};

template <class Described>
void check(Described value, const std::string& where, WarningList& warnings) {
  UsualRanges ranges(where, warnings);
  describe(value, ranges);
}

}  // namespace

void warn_of_unusual_values(const Inspected& store, WarningList& warnings) {
  const Store& file = store.store;
  for (const LabelType& type : file.label_types)
    check(type, fmt::format("{}: label_types.{}", file.file, type.name), warnings);
  for (const TransceiverType& type : file.transceiver_types)
    check(type, fmt::format("{}: transceiver_types.{}", file.file, type.name), warnings);
  for (const auto& [grid, where] : file.grids) check(grid, where, warnings);
  for (const auto& [area, where] : file.areas) check(area, where, warnings);
  for (const auto& [rail, where] : file.rails) check(rail, where, warnings);
  for (const auto& [fixture, where] : file.fixtures) check(fixture, where, warnings);
}

}  // namespace shelfbeam
