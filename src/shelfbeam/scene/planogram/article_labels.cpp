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
}

void ArticleLabels::fields(Fields& f) {
  f.text("file", file, {.says = "the CSV file", .fewest = 1});
  f.label_type("type", style.type, {.says = "label type of records without one"});
  f.length("hook", style.hook, {.says = hook_says, .is_optional = true});
  f.scalar("tilt_deg", Scalar::degrees, style.tilt_deg,
           {.says = tilt_says, .least = least_label_tilt, .most = most_label_tilt, .is_optional = true});
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
}

}  // namespace shelfbeam
