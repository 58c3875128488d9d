#include "shelfbeam/scene/store/store.hpp"

#include "reader.hpp"
#include "scratch_folder.hpp"

namespace shelfbeam::fuzz {

namespace {

constexpr const char* segments_key = R"("segments": [
    { "planogram": "P", "segments": [1, 2], "fixture": "A", "face": "back", "from": 1, "to": 8, "first_shelf": 0 },
    { "planogram": "P", "segments": [3], "fixture": "F", "face": "left", "right_to_left": true, "from_top": true },
    { "planogram": "Q", "fixture": "B", "face": "top" } ], )";

constexpr const char* planogram_store = R"({
  "units": "ft", "planogram": { "file": "planogram.csv", "type": "l",
    "fixtures": [ { "fixtures": "?", "hook": 0.1 }, { "fixtures": "F*", "type": "l", "tilt_deg": 30 } ] },
  "materials": { "m": { "type": "lambertian", "reflectance": 0.5 } }, "label_types": { "l": { "threshold": 0.02 } },
  "transceiver_types": { "t": { "emission": { "type": "isotropic", "intensity": 0.5 } } },
  "fixtures": [
    { "type": "gondola", "id": "A", "at": [0, 0], "length": 9, "depth": 2, "height": 6, "material": "m", "shelves": [1, 2, 4] },
    { "type": "freezer", "id": "F", "at": [20, 9], "rotation_deg": 30, "length": 6, "depth": 3, "height": 3, "material": "m" },
    { "type": "box", "id": "B", "min": [30, 0, 0], "max": [31, 1, 1], "material": "m" } ],
  "transceivers": { "list": [ { "id": "T", "position": [1, 2, 3], "type": "t" } ] }
})";

constexpr const char* article_seed = R"(article,fixture,face,level,position
4006381333931,A,front,2,1
4006381333948,A,front,2,2
4006381333931,A,back,1,1
)";

constexpr const char* described_seed = R"(Name,article,description,fixture,face,level,x
x,1,"Rye
 bread)"
                                       "\u202e"
                                       R"(",A,back,1,2
,2,,F,left,1,2
)";

constexpr const char* mounted_seed = R"(article,fixture,face,level,x,y,hook,tilt_deg,type
1,B,top,1,1,0.5,,30,l
2,B,left,1,2,,0.1,-9,
3,A,back,1,1,,,,
)";

constexpr const char* segments_seed = R"(UPC,Product Name,Planogram,Segment,Shelf,Position,Width,HFacings,hook
7,Jam,P,1,1,1,0.1,2,
8,Tea,P,1,1,2,,1,0.1
9,,P,2,0,1,,,
10,Salt,P,3,1,1,,,
7,,Q,4,1,1,,,
)";

void fuzz_planogram(std::string_view bytes) {
  constexpr std::size_t memory = 1 << 26;
  scratch().write("planogram.csv", bytes);
  std::string store = planogram_store;
  constexpr std::string_view file = "\"file\"";
  if (bytes.find("egment") != std::string_view::npos) store.insert(store.find(file), segments_key);
  make_scene(parse_store(store, "store.json", scratch().path(), {false, memory}));
}

std::vector<std::string> planogram_seeds() {
  return {
      article_seed,
      "article,fixture,face,level,x,n\r\n\"Milk, 1 l\",A,front,3,1.5,2\r\n\"Milk, 1 l\",F,left,1,0.1,1\r\n",
      "Article;Fixture;FACE;Level;Position\n4,00638E+12;A;Front;2;1\n01.02.2024;A;front;2;2\n",
      described_seed,
      mounted_seed,
      segments_seed,
      "article;fixture;face;level;x\nA;A;front;1;0,25\nB;F;right;1;2,5\n"};
}

}  // namespace

extern const Reader planogram;
const Reader planogram{"planogram", fuzz_planogram, planogram_seeds};

}  // namespace shelfbeam::fuzz
