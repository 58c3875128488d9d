#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam::test {

/// Describes the keys of a struct as the JSON schema of an object. Structs with two forms have two schemas.
class SchemaFields final : public Fields {
 public:
  using Json = nlohmann::ordered_json;

  explicit SchemaFields(bool is_first_form) : is_first_form_(is_first_form) {}

  /// The schema of an object with these keys and no others.
  Json object_schema() const;
  bool has_forms() const { return has_forms_; }
  /// Adds a key.
  void add(std::string_view key, Json schema, bool is_required);

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
  void one_of(std::initializer_list<std::string_view> keys) override;
  void any_of(std::initializer_list<std::string_view> keys) override;

 private:
  bool describe(std::string_view key, Json schema, const Field& field, const Json& value = {});
  Json part_schema(const Part& part) const;

  bool is_first_form_, has_forms_ = false;
  Json required_ = Json::array(), properties_ = Json::object(), one_of_ = Json::array(),
       any_of_ = Json::array();
};

/// One schema, or the alternatives of a struct with two forms; `more` adds keys.
nlohmann::ordered_json schema_of(const Fields::Part& part);

/// Markdown without links and marks: "`a` [b](c)" becomes "'a' b".
std::string plain(std::string_view markdown);

/// JSON in which everything that fits takes one line.
std::string compact(const nlohmann::ordered_json& json, std::size_t indent = 0);

}  // namespace shelfbeam::test
