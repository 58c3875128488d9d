#pragma once

#include "shelfbeam/base/fields/fields.hpp"

namespace shelfbeam {

/// Visits each key of a struct, of both of its forms and without those of its parts, and changes no value.
class EachKey : public Fields {
 public:
  virtual void key(std::string_view name, const Field& field) = 0;

  bool scalar(std::string_view name, Scalar, double&, const Field& field) override {
    return visit(name, field);
  }
  bool array(std::string_view name, Scalar, std::span<double>, const Field& field) override {
    return visit(name, field);
  }
  bool list(std::string_view name, Scalar, std::vector<double>&, const Field& field) override {
    return visit(name, field);
  }
  bool polygon(std::string_view name, std::vector<std::array<double, 2>>&, const Field& field) override {
    return visit(name, field);
  }
  bool integer(std::string_view name, std::int64_t&, const Field& field) override {
    return visit(name, field);
  }
  bool boolean(std::string_view name, bool&, const Field& field) override { return visit(name, field); }
  bool text(std::string_view name, std::string&, const Field& field) override { return visit(name, field); }
  bool choices(std::string_view name, std::vector<std::string_view>&, std::span<const std::string_view>, bool,
               const Field& field) override {
    return visit(name, field);
  }
  bool reference(std::string_view name, NameList, std::uint32_t&, const Field& field) override {
    return visit(name, field);
  }
  bool references(std::string_view name, NameList, std::vector<std::pair<std::string, std::uint32_t>>&,
                  const Field& field) override {
    return visit(name, field);
  }
  bool object(std::string_view name, const Part&, const Field& field) override { return visit(name, field); }
  bool objects(std::string_view name, std::size_t, const std::function<void(Fields&, std::size_t)>&,
               const Field& field) override {
    return visit(name, field);
  }
  bool custom(std::string_view name, const CustomValue&, const Field& field) override {
    return visit(name, field);
  }
  void either(std::initializer_list<std::string_view>, bool, const Part& first, const Part& second) override {
    first(*this);
    second(*this);
  }
  void one_of(std::initializer_list<std::string_view>) override {}
  void any_of(std::initializer_list<std::string_view>) override {}

 private:
  bool visit(std::string_view name, const Field& field) {
    key(name, field);
    return false;
  }
};

/// The keys of a struct, of both of its forms and without those of its parts.
std::vector<std::string_view> keys_of(const Fields::Part& part);

}  // namespace shelfbeam
