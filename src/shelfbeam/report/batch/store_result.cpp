#include "shelfbeam/report/batch/store_result.hpp"

#include <algorithm>
#include <tuple>

namespace shelfbeam {

void sort_by_need(std::vector<StoreResult>& results) {
  const auto need = [](const StoreResult& result) {
    return std::tuple(result.status, result.warnings.empty(), -result.price.value_or(0), result.name);
  };
  std::sort(results.begin(), results.end(),
            [&](const StoreResult& a, const StoreResult& b) { return need(a) < need(b); });
}

}  // namespace shelfbeam
