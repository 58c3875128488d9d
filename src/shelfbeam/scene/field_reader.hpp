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

#include "shelfbeam/base/fields/each_key.hpp"
#include "shelfbeam/base/fields/key_rules.hpp"
#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/store_names.hpp"

namespace shelfbeam {

/// Reads an object with the keys of a struct and no others, and collects its problems. `complete` checks
/// rules that tie keys together. Returns whether there was no problem.
bool read_object(const JsonCursor& json, const StoreNames& names, Problems& problems,
                 const Fields::Part& part, const std::function<void(class FieldReader&)>& complete = {});

/// Reads the keys of a struct that an object of a store file has. It collects the problems of all keys; the
/// value of a key with a problem remains. Keys that it does not know are left to `expect_keys`.
class FieldReader final : public Fields, public KeyRules {
 public:
  FieldReader(const JsonCursor& json, const StoreNames& names, Problems& problems)
      : json_(json), names_(names), problems_(problems) {}

  const JsonCursor& json() const { return json_; }
  const StoreNames& names() const { return names_; }
  Problems& problems() const { return problems_; }
  void expect_keys(std::span<const std::string_view> known);
  bool is_given(std::string_view key) const { return json_.find(key).has_value(); }
  bool has_failed(std::string_view key) const;
  bool rule(std::initializer_list<std::string_view> keys, const std::function<void()>& check) override;

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
  template <class Read>
  bool read(std::string_view key, const Field& field, Read read_value);

  JsonCursor json_;
  const StoreNames& names_;
  Problems& problems_;
  std::vector<std::string> failed_;
};

}  // namespace shelfbeam
