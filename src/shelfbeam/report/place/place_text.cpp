#include "shelfbeam/report/place/place_text.hpp"

namespace shelfbeam {

std::string place_text(const Words& words, const ShopPlace& place) {
  using Kind = ShopPlace::Kind;
  const bool has_wall = place.other.empty();
  switch (place.kind) {
    case Kind::none:
      break;
    case Kind::at:
      return words.say("place.at", place.fixture);
    case Kind::above:
      return words.say("place.above", place.fixture);
    case Kind::aisle:
      return has_wall ? words.say("place.aisle_wall", place.fixture)
                      : words.say("place.aisle", place.fixture, place.other);
    case Kind::between:
      return has_wall ? words.say("place.between_wall", place.fixture)
                      : words.say("place.between", place.fixture, place.other);
    case Kind::beside:
      return words.say("place.beside", place.fixture);
    case Kind::zone:
      return words.say("place.zone", words.fixed(place.ceiling, 2));
  }
  return {};
}

}  // namespace shelfbeam
