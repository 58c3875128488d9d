#pragma once

#include <string>

#include "shelfbeam/report/place/shop_place.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// "over the aisle between G3 and G4", "above G3", "beside C2"; empty for Kind::none.
std::string place_text(const Words& words, const ShopPlace& place);

}  // namespace shelfbeam
