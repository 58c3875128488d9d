#pragma once

#include <string>
#include <string_view>

#include "shelfbeam/base/fields/fields.hpp"

namespace shelfbeam::test {

/// The rows of a Markdown table of the keys: key, unit of measure, default, meaning.
class TableFields final : public Fields {
 public:
  std::string rows;

  bool scalar(std::string_view key, Scalar kind, double& value, const Field& field) override;
  bool array(std::string_view key, Scalar kind, std::span<double> values, const Field& field) override;
  bool list(std::string_view key, Scalar kind, std::vector<double>& values, const Field& field) override;
  bool polygon(std::string_view key, Polygon& corners, const Field& field) override;
  bool integer(std::string_view key, std::int64_t& value, const Field& field) override;
  bool boolean(std::string_view key, bool& value, const Field& field) override;
  bool text(std::string_view key, std::string& value, const Field& field) override;
  bool choices(std::string_view key, std::vector<std::string_view>& values,
               std::span<const std::string_view> known, bool single, const Field& field) override;
  bool reference(std::string_view key, NameList list, std::uint32_t& index, const Field& field) override;
  bool references(std::string_view key, NameList list,
                  std::vector<std::pair<std::string, std::uint32_t>>& values, const Field& field) override;
  bool object(std::string_view key, const Part& part, const Field& field) override;
  bool objects(std::string_view key, std::size_t count, const std::function<void(Fields&, std::size_t)>& part,
               const Field& field) override;
  bool custom(std::string_view key, const CustomValue& value, const Field& field) override;
  void either(std::initializer_list<std::string_view> marks, bool is_first, const Part& first,
              const Part& second) override;
  void one_of(std::initializer_list<std::string_view>) override {}

 private:
  bool add(std::string_view key, std::string_view unit, const std::string& value, const Field& field);
};

}  // namespace shelfbeam::test
