#include "shelfbeam/scene/store/drawing.hpp"

#include "shelfbeam/scene/field_reader.hpp"
#include "shelfbeam/scene/store/store_parts.hpp"

namespace shelfbeam {

namespace {

constexpr double max_pixels = 1e9;  // units of a DXF file may be small
constexpr double min_size = 1e-3;
constexpr std::array<std::string_view, 8> units{"mm", "cm", "dm", "m", "km", "in", "ft", "yd"};

void describe_line(Fields& f, std::string_view key, std::optional<ScaleLine>& line, std::string_view says) {
  ScaleLine value = line.value_or(ScaleLine{});
  if (f.object(key, [&](Fields& own) { value.fields(own); },
               {.says = says, .is_optional = true, .otherwise = "none", .is_written = line.has_value()}))
    line = value;
}

}  // namespace

void ScaleLine::fields(Fields& f) {
  const auto point = [&](std::string_view key, std::array<double, 2>& value, std::string_view says) {
    f.array(key, Scalar::number, value,
            {.says = says, .least = -max_pixels, .most = max_pixels, .unit = "pixels"});
  };
  point("from", from, "`[x, y]` of the beginning, from the upper left corner of the picture");
  point("to", to, "`[x, y]` of the end");
  f.length("length", length, {.says = "its length in the shop"});
}

void describe(Drawing& drawing, Fields& f) {
  f.text("file", drawing.file,
         {.says = "name of a PNG, JPEG, WEBP, PDF or DXF file in the folder of the store file",
          .is_name = true});
  f.integer("page", drawing.page,
            {.says = "page of a PDF file", .least = 1, .most = 100'000, .is_optional = true});
  f.choices("unit", drawing.unit, units, true,
            {.says = "unit of length of a DXF file: `mm`, `cm`, `dm`, `m`, `km`, `in`, `ft` or `yd`; `scale` "
                     "comes before it",
             .is_optional = true,
             .otherwise = "none",
             .is_written = !drawing.unit.empty()});
  std::array<double, 2> origin = drawing.origin.value_or(std::array<double, 2>{});
  if (f.array("origin", Scalar::number, origin,
              {.says = "`[x, y]` of the picture's lower left corner in the coordinates of a DXF file",
               .is_optional = true,
               .otherwise = "none",
               .is_written = drawing.origin.has_value()}))
    drawing.origin = origin;
  f.array(
      "size", Scalar::number, drawing.size,
      {.says = "`[width, height]` of the picture to which all pixels here refer; points of a PDF page, units "
               "of a DXF file",
       .least = min_size,
       .most = max_pixels,
       .unit = "pixels"});
  f.plan_point("at", drawing.at,
               {.says = "`[x, y]` of the picture's lower left corner in the shop",
                .is_optional = true,
                .otherwise = "the origin"});
  describe_line(f, "scale", drawing.scale, "a line of known length, which gives the scale");
  describe_line(f, "check", drawing.check,
                "a second line of known length in another direction, which checks the scale");
  f.scalar("rotation_deg", Scalar::degrees, drawing.rotation_deg,
           {.says = "counterclockwise rotation about the lower left corner", .is_optional = true});
  std::array<double, 4> crop = drawing.crop.value_or(std::array<double, 4>{});
  if (f.array("crop", Scalar::number, crop,
              {.says = "`[left, top, right, bottom]` of the part that is shown",
               .least = -max_pixels,
               .most = max_pixels,
               .unit = "pixels",
               .is_optional = true,
               .otherwise = "the whole picture",
               .is_written = drawing.crop.has_value()}))
    drawing.crop = crop;
}

void expect_drawing(const JsonCursor& section, const StoreNames& names, Problems& problems) {
  Drawing drawing;
  read_object(section, names, problems, [&](Fields& f) { describe(drawing, f); });
}

}  // namespace shelfbeam
