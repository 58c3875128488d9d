#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/base/fields/each_key.hpp"

namespace shelfbeam::test {

/// The rows of a Markdown table of the keys: key, unit of measure, default, meaning.
class TableFields final : public EachKey {
 public:
  std::string rows;

  void key(std::string_view name, const Field& field) override;

  bool scalar(std::string_view key, Scalar kind, double& value, const Field& field) override;
  bool array(std::string_view key, Scalar kind, std::span<double> values, const Field& field) override;
  bool list(std::string_view key, Scalar kind, std::vector<double>& values, const Field& field) override;
  bool integer(std::string_view key, std::int64_t& value, const Field& field) override;
  bool boolean(std::string_view key, bool& value, const Field& field) override;
  bool text(std::string_view key, std::string& value, const Field& field) override;
  bool choices(std::string_view key, std::vector<std::string_view>& values,
               std::span<const std::string_view> known, bool single, const Field& field) override;

 private:
  bool add(std::string_view key, std::string_view unit, const std::string& value, const Field& field);
};

}  // namespace shelfbeam::test
