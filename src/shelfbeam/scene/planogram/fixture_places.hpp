#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "shelfbeam/scene/planogram/planogram_record.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

class Problems;

/// The places of a file whose records name fixtures, faces and levels.
class FixturePlaces {
 public:
  FixturePlaces(const ArticleLabels& labels, const FixtureColumns& columns, const StoreNames& names,
                const Store& store, const Problems& problems);

  /// Adds the place of a record, and returns the number of places added. Throws InputError.
  std::size_t add(CsvReader& csv);
  /// All places. Positions are spread evenly over an edge, as many as the largest one on it.
  std::vector<PlanogramPlace> finish();

 private:
  const ArticleLabels& labels_;
  const FixtureColumns columns_;
  const StoreNames& names_;
  const Store& store_;
  const Problems& problems_;
  std::map<std::string, std::size_t, std::less<>> index_;
  std::vector<PlanogramPlace> places_;
  std::vector<int> positions_;  ///< by place, from 1; 0: it has its distance
};

}  // namespace shelfbeam
