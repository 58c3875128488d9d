#include "shelfbeam/scene/store/device_csv.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/scene/read_values.hpp"

namespace shelfbeam {

namespace {

// Calls `use(record)` for each record of a CSV that begins with the given columns.
template <class Use>
void each_record(const std::filesystem::path& path, std::string_view header, Use use) {
  const std::string text = read_file(path);
  if (!is_utf8(text)) throw InputError(path.string(), "is not UTF-8", "save it in that encoding");
  std::string_view content = text;
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  CsvReader csv(content, path.string());
  const std::string wanted = fmt::format("the first line must be {}", header);
  if (!csv.next()) throw InputError(path.string(), "is empty", wanted);
  const std::vector<std::string_view> columns = split(header, ',');
  if (csv.fields().size() < columns.size() ||
      !std::equal(columns.begin(), columns.end(), csv.fields().begin()))
    csv.fail("has another header", wanted);
  while (csv.next()) {
    if (csv.fields().size() < columns.size())
      csv.fail(fmt::format("has {} fields", csv.fields().size()),
               fmt::format("{} are expected: {}", columns.size(), header));
    use(csv);
  }
}

std::string id_of(const CsvReader& csv) {
  return check_name(csv.id(0), csv.where() + ": id");
}

Vec3 vector_at(const CsvReader& csv, std::size_t first) {
  return {csv.number(first), csv.number(first + 1), csv.number(first + 2)};
}

Vec3 point_at(const CsvReader& csv, std::size_t first) {
  const Vec3 p = vector_at(csv, first);
  for (int axis = 0; axis < 3; ++axis) check_coordinate(p[axis], csv.where());
  return p;
}

}  // namespace

void read_labels_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_record(path, "id,x,y,z,nx,ny,nz,type", [&](const CsvReader& csv) {
    Label label;
    label.id = id_of(csv);
    label.position = point_at(csv, 1);
    label.normal = unit_direction(vector_at(csv, 4), csv.where());
    label.type = names.label_type(std::string(csv.fields()[7]), csv.where());
    store.labels.push_back({std::move(label), csv.where()});
  });
}

void read_transceivers_csv(const std::filesystem::path& path, const StoreNames& names, Store& store) {
  each_record(path, "id,x,y,z,ax,ay,az,roll_deg,type", [&](const CsvReader& csv) {
    Transceiver unit;
    unit.id = id_of(csv);
    unit.position = point_at(csv, 1);
    unit.axis = unit_direction(vector_at(csv, 4), csv.where());
    unit.roll_deg = csv.number(7);
    if (!(std::abs(unit.roll_deg) <= 360))
      csv.fail(7, fmt::format("is {}", unit.roll_deg), "use a value from -360 to 360");
    unit.type = names.transceiver_type(std::string(csv.fields()[8]), csv.where());
    store.transceivers.push_back({std::move(unit), csv.where()});
  });
}

}  // namespace shelfbeam
