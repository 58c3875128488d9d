#include "shelfbeam/scene/field_reader.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/fields/each_key.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

void expect_size(const JsonCursor& json, const Field& field) {
  const std::size_t size = json.is_object() ? json.value().size() : json.size();
  if (size < field.fewest || (field.longest > 0 && size > field.longest))
    json.fail(size == 0 ? "is empty" : fmt::format("has {} members", size),
              field.longest == 0  ? fmt::format("give at least {}", field.fewest)
              : field.fewest == 0 ? fmt::format("at most {} are allowed", field.longest)
                                  : fmt::format("give {} to {}", field.fewest, field.longest));
}

// "'a', 'b' and 'c'"
std::string listed(std::initializer_list<std::string_view> keys, std::string_view before_last) {
  std::string list;
  for (const std::string_view& key : keys)
    list += fmt::format("{}'{}'",
                        list.empty()             ? ""
                        : &key == keys.end() - 1 ? fmt::format(" {} ", before_last)
                                                 : ", ",
                        key);
  return list;
}

}  // namespace

bool read_object(const JsonCursor& json, const StoreNames& names, Problems& problems,
                 const Fields::Part& part, const std::function<void(FieldReader&)>& complete) {
  const std::size_t failures = problems.failures();
  FieldReader reader(json, names, problems);
  reader.expect_keys(keys_of(part));
  if (json.is_object()) part(reader);
  if (json.is_object() && complete) complete(reader);
  return failures == problems.failures();
}

void FieldReader::expect_keys(std::span<const std::string_view> known) {
  problems_.collect([&] {
    for (const JsonError& error : json_.unknown_keys(known)) problems_.keep(error);
  });
}

bool FieldReader::has_failed(std::string_view key) const {
  return std::find(failed_.begin(), failed_.end(), key) != failed_.end();
}

bool FieldReader::rule(std::initializer_list<std::string_view> keys, const std::function<void()>& check) {
  const bool can_check = std::none_of(keys.begin(), keys.end(), [&](auto key) { return has_failed(key); });
  return can_check && problems_.collect(check);
}

template <class Read>
bool FieldReader::read(std::string_view key, const Field& field, Read read_value) {
  bool is_read = false;
  const std::size_t failures = problems_.failures();
  problems_.collect([&] {
    const auto found = field.is_optional ? json_.find(key) : std::optional(json_[key]);
    if (!found) return;
    read_value(*found);
    is_read = problems_.failures() == failures;
  });
  if (problems_.failures() != failures) failed_.emplace_back(key);
  return is_read;
}

bool FieldReader::scalar(std::string_view key, Scalar kind, double& value, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) { value = read_scalar(json, kind, field); });
}

bool FieldReader::array(std::string_view key, Scalar kind, std::span<double> values, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    json.numbers(values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      problems_.collect([&] { values[k] = read_scalar(json.element(k), kind, field); });
  });
}

bool FieldReader::list(std::string_view key, Scalar kind, std::vector<double>& values, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    expect_size(json, field);
    values.assign(json.size(), 0);
    for (std::size_t k = 0; k < values.size(); ++k)
      problems_.collect([&] { values[k] = read_scalar(json.element(k), kind, field); });
  });
}

bool FieldReader::polygon(std::string_view key, Polygon& corners, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) { corners = read_polygon(json); });
}

bool FieldReader::integer(std::string_view key, std::int64_t& value, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    value = json.integer(static_cast<std::int64_t>(field.least), static_cast<std::int64_t>(field.most));
  });
}

bool FieldReader::boolean(std::string_view key, bool& value, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) { value = json.boolean(); });
}

bool FieldReader::text(std::string_view key, std::string& value, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    value = field.is_name ? read_name(json) : json.text();
    if (value.size() < field.fewest) json.fail("is empty", "give a text");
  });
}

bool FieldReader::choices(std::string_view key, std::vector<std::string_view>& values,
                          std::span<const std::string_view> known, bool single, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    std::vector<std::string_view> chosen;
    const auto choose = [&](const JsonCursor& one) {
      const std::string_view name = *std::find(known.begin(), known.end(), one.choice(known));
      if (std::find(chosen.begin(), chosen.end(), name) != chosen.end())
        one.fail("is a duplicate", "remove it");
      chosen.push_back(name);
    };
    if (single) {
      choose(json);
    } else {
      for (const JsonCursor& one : json.elements()) problems_.collect([&] { choose(one); });
      if (json.size() == 0) json.fail("is empty", "name at least one, or remove the key");
    }
    values = std::move(chosen);
  });
}

bool FieldReader::reference(std::string_view key, NameList list, std::uint32_t& value, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) { value = names_.index(list, json); });
}

bool FieldReader::references(std::string_view key, NameList list,
                             std::vector<std::pair<std::string, std::uint32_t>>& values, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    if (field.one_for_all && json.is_object())
      read_object(json, names_, problems_, [&](Fields& fields) {
        for (auto& [name, value] : values) fields.reference(name, list, value, {});
      });
    else if (field.one_for_all)
      for (auto& [name, value] : values) value = names_.index(list, json);
    else
      for (const auto& [name, value] : json.members())
        problems_.collect(
            [&, &name = name, &value = value] { values.emplace_back(name, names_.index(list, value)); });
  });
}

bool FieldReader::object(std::string_view key, const Part& part, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) { read_object(json, names_, problems_, part); });
}

bool FieldReader::objects(std::string_view key, std::size_t,
                          const std::function<void(Fields&, std::size_t)>& part, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) {
    expect_size(json, field);
    for (std::size_t k = 0; k < json.size(); ++k)
      if (!read_object(json.element(k), names_, problems_, [&](Fields& fields) { part(fields, k); }))
        failed_.push_back(fmt::format("{}[{}]", key, k));
  });
}

bool FieldReader::custom(std::string_view key, const CustomValue& value, const Field& field) {
  return read(key, field, [&](const JsonCursor& json) { value.read(json); });
}

void FieldReader::either(std::initializer_list<std::string_view> marks, bool, const Part& first,
                         const Part& second) {
  const bool is_first = std::any_of(marks.begin(), marks.end(), [&](auto key) { return is_given(key); });
  const Part &chosen = is_first ? first : second, &other = is_first ? second : first;
  const std::vector<std::string_view> own = keys_of(chosen);
  for (const std::string_view key : keys_of(other))
    if (const auto found = json_.find(key); found && std::find(own.begin(), own.end(), key) == own.end()) {
      failed_.emplace_back(key);
      problems_.collect([&] {
        if (is_first)
          found->fail(fmt::format("has no effect beside '{}'", fmt::join(marks, "' and '")),
                      "remove one of the two");
        found->fail(fmt::format("has no effect without '{}'", fmt::join(marks, "' and '")),
                    "remove it, or add them");
      });
    }
  chosen(*this);
}

void FieldReader::one_of(std::initializer_list<std::string_view> keys) {
  if (std::count_if(keys.begin(), keys.end(), [&](auto key) { return is_given(key); }) == 1) return;
  problems_.collect([&] { json_.fail("must have one of " + listed(keys, "and"), "keep one of them"); });
}

void FieldReader::any_of(std::initializer_list<std::string_view> keys) {
  if (std::any_of(keys.begin(), keys.end(), [&](auto key) { return is_given(key); })) return;
  problems_.collect(
      [&] { json_.fail("has no effect without " + listed(keys, "or"), "add one of them, or remove it"); });
}

}  // namespace shelfbeam
