#include "shelfbeam/plan/question/fitting_signals.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/world/coverage.hpp"
#include "shelfbeam/transport/world/rough_coats.hpp"

namespace shelfbeam {

namespace {

using Numbers = std::vector<std::uint32_t>;

// The index of the member of `from` for each member of `to`: the same key and, if possible, the same id.
template <class Row, class Key>
std::variant<Numbers, MisfitReason> matching(const std::vector<Row>& to, const std::vector<Row>& from,
                                             const Key& key, Misfit code) {
  std::unordered_multimap<std::uint64_t, std::uint32_t> found;
  for (std::uint32_t k = 0; k < from.size(); ++k) found.emplace(key(from[k]), k);
  Numbers numbers;
  MisfitReason reason{code};
  for (const Row& row : to) {
    const auto [first, last] = found.equal_range(key(row));
    if (first == last) {
      if (!reason.missing) reason.missing = {0, row.id};
      ++reason.missing->count;
      continue;
    }
    // Those with this id come first, then the smaller indices.
    const auto rank = [&](const auto& one) { return std::pair(from[one.second].id != row.id, one.second); };
    numbers.push_back(std::ranges::min_element(first, last, {}, rank)->second);
  }
  if (reason.missing) return reason;
  return numbers;
}

bool is_identity(const Numbers& numbers, std::size_t size) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] != k) return false;
  return numbers.size() == size;
}

// Some rows and columns of a matrix with `width` columns.
template <class T>
std::vector<T> part(const std::vector<T>& entries, const Numbers& rows, const Numbers& columns,
                    std::size_t width) {
  std::vector<T> result;
  if (entries.empty()) return result;
  result.reserve(rows.size() * columns.size());
  for (const std::uint32_t i : rows)
    for (const std::uint32_t j : columns) result.push_back(entries[i * width + j]);
  return result;
}

// Keeps some rows and columns of all arrays, one after another, so that at most one is in memory twice.
void reduce(SignalMatrix& matrix, const Numbers& rows, const Numbers& columns) {
  const std::size_t width = matrix.columns();
  const auto reduce_one = [&](auto& entries) { entries = part(entries, rows, columns, width); };
  reduce_one(matrix.mean);
  reduce_one(matrix.standard_error);
  reduce_one(matrix.direct);
  reduce_one(matrix.flags);
  for (auto* layers : {&matrix.by_bounce, &matrix.by_length})
    for (SignalLayer& layer : *layers) {
      reduce_one(layer.mean);
      reduce_one(layer.standard_error);
    }
}

// A matrix from another source, without an estimator, is taken for complete.
bool finds_the_same_light(const std::string& estimator, const Scene& scene, const PathRules& wanted) {
  if (estimator.empty()) return true;
  const std::optional<PathRules> rules = rules_of_estimator(estimator);
  return rules && rules->max_bounces == wanted.max_bounces &&
         uncovered_light(scene, rules->strategy) == uncovered_light(scene, wanted.strategy);
}

}  // namespace

std::variant<SignalMatrix, MisfitReason> fitting_signals(StoredSignals signals, const Scene& scene,
                                                         const PathRules& wanted) {
  const Provenance& origin = signals.provenance;
  if (signals.states) return MisfitReason{Misfit::states};
  if (signals.part) return MisfitReason{Misfit::part};
  if (!origin.complete) return MisfitReason{Misfit::incomplete};
  if (!finds_the_same_light(origin.estimator, scene, wanted)) return MisfitReason{Misfit::paths};
  SignalMatrix head = detail::matrix_head(scene, scene_hash(scene), origin.seed, origin.estimator);
  const bool has_light = origin.light_hash.has_value();
  if (with_rough_coats(scene) && (!has_light || origin.light_hash == light_keys(scene).light_hash))
    return MisfitReason{Misfit::coats};
  if (!has_light && (origin.store_hash != head.provenance.store_hash || signals.rows() != head.rows() ||
                     signals.columns() != head.columns()))
    return MisfitReason{Misfit::store};
  if (has_light && origin.light_hash != head.provenance.light_hash) return MisfitReason{Misfit::light};
  const auto key = [&](const auto& row) { return has_light ? row.light : hash64(row.id); };
  const auto rows = matching(head.labels, signals.labels, key, Misfit::labels);
  if (const auto* missing = std::get_if<MisfitReason>(&rows)) return *missing;
  const auto columns = matching(head.transceivers, signals.transceivers, key, Misfit::transceivers);
  if (const auto* missing = std::get_if<MisfitReason>(&columns)) return *missing;
  const Numbers &i = std::get<Numbers>(rows), &j = std::get<Numbers>(columns);
  for (std::size_t k = 0; k < i.size(); ++k) {
    head.labels[k].batches = signals.labels[i[k]].batches;
    head.labels[k].samples = signals.labels[i[k]].samples;
  }
  SignalMatrix fitting = std::move(signals);
  if (!is_identity(i, fitting.rows()) || !is_identity(j, fitting.columns())) reduce(fitting, i, j);
  fitting.labels = std::move(head.labels);
  fitting.transceivers = std::move(head.transceivers);
  fitting.excluded = std::move(head.excluded);
  fitting.currency = std::move(head.currency);
  fitting.provenance = std::move(head.provenance);
  return fitting;
}

}  // namespace shelfbeam
