#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/fields.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

inline nlohmann::ordered_json array_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

/// The lists of the store whose members have names.
struct StoreLists {
  const std::vector<NamedMaterial>& materials;
  const std::vector<LabelType>& label_types;
  const std::vector<TransceiverType>& transceiver_types;
};

/// Writes the values of a struct to an object of the resolved store, from which FieldReader restores them to
/// the bit.
class FieldWriter final : public Fields {
 public:
  FieldWriter(nlohmann::ordered_json& json, const StoreLists& lists) : json_(json), lists_(lists) {}

  bool scalar(std::string_view key, Scalar, double& value, const Field& field) override {
    return write(key, value, field);
  }
  bool array(std::string_view key, Scalar, std::span<double> values, const Field& field) override {
    return write(key, std::vector(values.begin(), values.end()), field);
  }
  bool list(std::string_view key, Scalar, std::vector<double>& values, const Field& field) override {
    return write(key, values, field);
  }
  bool polygon(std::string_view key, Polygon& corners, const Field& field) override {
    return write(key, corners, field);
  }
  bool integer(std::string_view key, std::int64_t& value, const Field& field) override {
    return write(key, value, field);
  }
  bool boolean(std::string_view key, bool& value, const Field& field) override {
    return write(key, value, field);
  }
  bool text(std::string_view key, std::string& value, const Field& field) override {
    return write(key, value, field);
  }
  bool choices(std::string_view key, std::vector<std::string_view>& values, std::span<const std::string_view>,
               bool single, const Field& field) override {
    return single ? write(key, values.front(), field) : write(key, values, field);
  }
  bool reference(std::string_view key, NameList list, std::uint32_t& index, const Field& field) override {
    return field.is_written && write(key, name_of(list, index), field);
  }
  bool references(std::string_view key, NameList, std::vector<std::pair<std::string, std::uint32_t>>& values,
                  const Field& field) override;
  bool object(std::string_view key, const Part& part, const Field& field) override;
  bool objects(std::string_view key, std::size_t count, const std::function<void(Fields&, std::size_t)>& part,
               const Field& field) override;
  bool custom(std::string_view key, const CustomValue& value, const Field& field) override {
    return field.is_written && write(key, value.write(), field);
  }
  void either(std::initializer_list<std::string_view>, bool is_first, const Part& first,
              const Part& second) override {
    (is_first ? first : second)(*this);
  }
  void one_of(std::initializer_list<std::string_view>) override {}
  void any_of(std::initializer_list<std::string_view>) override {}

 private:
  template <class Value>
  bool write(std::string_view key, const Value& value, const Field& field) {
    if (field.is_written) json_[key] = value;
    return false;
  }

  const std::string& name_of(NameList list, std::uint32_t index) const;

  nlohmann::ordered_json& json_;
  const StoreLists& lists_;
};

/// A described value as an object of the resolved store.
template <class Described>
nlohmann::ordered_json resolved(Described value, const StoreLists& lists) {
  nlohmann::ordered_json json;
  FieldWriter writer(json, lists);
  if constexpr (requires { value.fields(writer); })
    value.fields(writer);
  else
    describe(value, writer);
  return json;
}

}  // namespace shelfbeam
