#include "shelfbeam/base/names.hpp"

#include "shelfbeam/base/json.hpp"

#include "support/testing.hpp"

namespace shelfbeam {

enum class Fruit { apple, pear, quince };
template <>
inline constexpr auto names_of<Fruit> =
    std::to_array<Named<Fruit>>({{"apple", Fruit::apple}, {"pear", Fruit::pear}});

}  // namespace shelfbeam

namespace shelfbeam::test {
namespace {

TEST(Names, AreReadAndWritten) {
  EXPECT_EQ(to_text(Fruit::pear), "pear");
  EXPECT_EQ(to_text(Fruit::quince), "") << "has no name";
  EXPECT_EQ(from_text<Fruit>("apple"), Fruit::apple);
  EXPECT_EQ(from_text<Fruit>("quince"), std::nullopt);
  EXPECT_EQ(all_names<Fruit>(), (std::vector<std::string>{"apple", "pear"}));
}

TEST(Names, AreChoicesOfJson) {
  const JsonCursor fruits = JsonCursor::parse(R"(["pear", "peer"])", "fruits.json");
  EXPECT_EQ(fruits.element(0).choice<Fruit>(), Fruit::pear);
  expect_input_error([&] { fruits.element(1).choice<Fruit>(); }, "fruits.json: [1]", "'pear'");
  const std::span<const Named<Fruit>> first(names_of<Fruit>.data(), 1);
  expect_input_error([&] { fruits.element(0).choice<Fruit>(first); }, "'pear'");
}

}  // namespace
}  // namespace shelfbeam::test
