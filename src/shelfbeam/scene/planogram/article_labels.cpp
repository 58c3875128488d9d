#include "shelfbeam/scene/planogram/article_labels.hpp"

#include <cstddef>
#include <string_view>

namespace shelfbeam {

namespace {

constexpr std::string_view hook_says = "distance of the labels in front of the edge",
                           tilt_says = "upward tilt of the labels";

}  // namespace

void OwnStyle::replace_by(const OwnStyle& other) {
  if (other.type) type = other.type;
  if (other.hook) hook = other.hook;
  if (other.tilt_deg) tilt_deg = other.tilt_deg;
}

void StyledFixtures::fields(Fields& f) {
  constexpr std::string_view otherwise = "that of `planogram`";
  f.text("fixtures", pattern,
         {.says = "ids of fixtures; `*` matches any run of characters, `?` one", .fewest = 1});
  LabelStyle own;
  if (f.label_type("type", own.type, {.says = "label type", .is_optional = true, .otherwise = otherwise}))
    style.type = own.type;
  if (f.length("hook", own.hook, {.says = hook_says, .is_optional = true, .otherwise = otherwise}))
    style.hook = own.hook;
  if (f.scalar("tilt_deg", Scalar::degrees, own.tilt_deg,
               {.says = tilt_says,
                .least = least_label_tilt,
                .most = most_label_tilt,
                .is_optional = true,
                .otherwise = otherwise}))
    style.tilt_deg = own.tilt_deg;
  f.any_of({"type", "hook", "tilt_deg"});
}

void SegmentPlace::fields(Fields& f) {
  f.text("planogram", planogram,
         {.says = "name of the planogram in the file",
          .is_name = true,
          .is_optional = true,
          .otherwise = "the only one of the file"});
  f.list("segments", Scalar::amount, segments,
         {.says = "numbers of segments, 1 to 100, from the left to the right",
          .fewest = 1,
          .longest = 100,
          .is_optional = true,
          .otherwise = "all of the planogram, ascending"});
  f.text("fixture", fixture, {.says = "id of the fixture on which they stand", .fewest = 1});
  std::vector<std::string_view> known{top_face}, chosen{face ? to_text(*face) : top_face};
  for (const auto& [name, one] : names_of<Face>) known.insert(known.end() - 1, name);
  if (f.choices("face", chosen, known, true, {.says = "face of the fixture; of a box also its top"}))
    face = from_text<Face>(chosen.front());
  f.scalar(
      "from", Scalar::distance, from,
      {.says = "where the first segment begins: distance from the left end of the face, as a person sees "
               "it who stands before it",
       .is_optional = true});
  double end = to.value_or(0);
  if (f.length("to", end,
               {.says = "where the last segment ends; the segments have equal lengths",
                .is_optional = true,
                .otherwise = "the right end"}))
    to = end;
  f.integer("first_shelf", first_shelf,
            {.says = "number in the file of the lowest board: 2 if the bottom deck is shelf 1",
             .least = 0,
             .most = 1000,
             .is_optional = true});
  f.boolean("from_top", from_top,
            {.says = "whether shelves are counted downwards; `first_shelf` is then the highest board",
             .is_optional = true});
  f.boolean("right_to_left", right_to_left,
            {.says = "whether segments and sequences run from the right to the left", .is_optional = true});
}

void ArticleLabels::fields(Fields& f) {
  f.text("file", file, {.says = "the CSV file", .fewest = 1});
  std::vector<std::string_view> known, chosen;
  for (const auto& [name, one] : names_of<Encoding>) known.push_back(name);
  if (encoding) chosen.push_back(to_text(*encoding));
  if (f.choices("encoding", chosen, known, true,
                {.says = "[encoding](csv.md#spreadsheets) of a file that is not UTF-8",
                 .is_optional = true,
                 .otherwise = "guessed, with a warning"}))
    encoding = from_text<Encoding>(chosen.front());
  f.label_type("type", style.type, {.says = "label type of records without one"});
  f.length("hook", style.hook, {.says = hook_says, .is_optional = true});
  f.scalar("tilt_deg", Scalar::degrees, style.tilt_deg,
           {.says = tilt_says, .least = least_label_tilt, .most = most_label_tilt, .is_optional = true});
  f.integer(
      "first_level", first_level,
      {.says = "number in the file of the lowest board", .least = 0, .most = 1000, .is_optional = true});
  f.boolean("from_top", from_top,
            {.says = "whether boards are counted downwards; `first_level` is then the highest board",
             .is_optional = true});
  f.integer("first_position", first_position,
            {.says = "number in the file of the first position of an edge",
             .least = 0,
             .most = 1,
             .is_optional = true});
  f.boolean(
      "fill_down", fill_down,
      {.says = "whether an empty fixture, face, level, planogram, segment or shelf repeats the one above, "
               "as in merged cells",
       .is_optional = true});
  f.objects(
      "fixtures", fixtures.size(),
      [this](Fields& own, std::size_t k) {
        if (k >= fixtures.size()) fixtures.resize(k + 1);
        fixtures[k].fields(own);
      },
      {.says = "[other values on some fixtures](#mounting-of-labels-of-articles); the last matching member "
               "that has a key applies",
       .longest = 1000,
       .is_optional = true,
       .otherwise = "none"});
  f.objects(
      "segments", segments.size(),
      [this](Fields& own, std::size_t k) {
        if (k >= segments.size()) segments.resize(k + 1);
        segments[k].fields(own);
      },
      {.says = "[fixtures of segments](#files-of-planogram-programs), for a file that names segments and "
               "shelves",
       .fewest = 1,
       .longest = 1000,
       .is_optional = true,
       .otherwise = "none"});
}

}  // namespace shelfbeam
