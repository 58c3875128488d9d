#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/planogram/planogram_record.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

class Problems;

/// The places of a file as planogram programs export them: its records name a segment, a shelf and a
/// sequence, and `planogram.segments` of the store puts segments on fixtures.
class SegmentPlaces {
 public:
  /// Collects the problems of the members of `list`, which is read to `segments`.
  SegmentPlaces(const std::vector<SegmentPlace>& segments, const JsonCursor& list, const StoreNames& names,
                const Store& store, Problems& problems);
  /// Call it once, before adding records.
  void set_columns(const SegmentColumns& columns) { columns_ = columns; }

  /// Adds the places of a record, and returns their number. Throws InputError.
  std::size_t add(CsvReader& csv);
  /// All places, in the order of the records. The articles of a shelf share its width in their sequence, by
  /// the widths of their facings. Collects problems; `is_whole`: no record had one.
  std::vector<PlanogramPlace> finish(bool is_whole);

 private:
  struct Member {
    std::size_t fixture = 0;
    LabelSides sides;
    bool has_problem = false;   ///< the following are unknown
    double span = 0;            ///< m
    std::vector<int> segments;  ///< from the left; none if it takes all
    std::set<int> used;
  };
  struct Entry {
    PlanogramPlace place;
    std::size_t member = 0;
    int segment = 0, shelf = 0;
    double sequence = 0, width = 0, facings = 0;  ///< widths and facings: 0 if unknown
  };

  Member read_member(const SegmentPlace& given, const JsonCursor& json) const;
  std::vector<std::size_t> members_with(const std::string& planogram, int segment) const;
  int level_on(const CsvReader& csv, std::size_t member, int shelf) const;
  void share(std::vector<Entry*> shelf) const;
  void expect_segments(const JsonCursor& list) const;

  const std::vector<SegmentPlace>& given_;
  const JsonCursor list_;
  const StoreNames& names_;
  const Store& store_;
  Problems& problems_;
  SegmentColumns columns_;
  std::vector<Member> members_;
  std::map<std::pair<std::string, int>, std::vector<std::size_t>> listed_;  ///< by planogram and segment
  std::map<std::string, std::vector<std::size_t>> whole_;  ///< by planogram; they take all segments
  std::set<std::string> planograms_;                       ///< of the file
  std::vector<Entry> entries_;
};

}  // namespace shelfbeam
