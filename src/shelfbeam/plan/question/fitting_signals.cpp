#include "shelfbeam/plan/question/fitting_signals.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "shelfbeam/transport/run/matrix_rows.hpp"

namespace shelfbeam {

namespace {

using Numbers = std::vector<std::uint32_t>;

// The index of the member of `from` for each member of `to`: the same light and, if possible, the same id.
template <class Row>
std::variant<Numbers, MisfitReason> matching(const std::vector<Row>& to, const std::vector<Row>& from,
                                             Misfit code) {
  std::unordered_multimap<std::uint64_t, std::uint32_t> found;
  for (std::uint32_t k = 0; k < from.size(); ++k) found.emplace(from[k].light, k);
  Numbers numbers;
  MisfitReason missing{code};
  for (const Row& row : to) {
    const auto [first, last] = found.equal_range(row.light);
    if (first == last) {
      if (missing.missing++ == 0) missing.first_missing = row.id;
      continue;
    }
    // Those with this id come first, then the smaller indices.
    const auto rank = [&](const auto& one) { return std::pair(from[one.second].id != row.id, one.second); };
    numbers.push_back(std::ranges::min_element(first, last, {}, rank)->second);
  }
  if (missing.missing > 0) return missing;
  return numbers;
}

bool is_identity(const Numbers& numbers, std::size_t size) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] != k) return false;
  return numbers.size() == size;
}

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

SignalMatrix part(const SignalMatrix& matrix, SignalMatrix head, const Numbers& rows,
                  const Numbers& columns) {
  const auto take = [&](const auto& entries) { return part(entries, rows, columns, matrix.columns()); };
  head.mean = take(matrix.mean);
  head.standard_error = take(matrix.standard_error);
  head.direct = take(matrix.direct);
  head.flags = take(matrix.flags);
  for (const SignalLayer& layer : matrix.by_bounce)
    head.by_bounce.push_back({take(layer.mean), take(layer.standard_error)});
  for (const SignalLayer& layer : matrix.by_length)
    head.by_length.push_back({take(layer.mean), take(layer.standard_error)});
  head.length_step = matrix.length_step;
  return head;
}

}  // namespace

std::variant<SignalMatrix, MisfitReason> fitting_signals(StoredSignals signals, const Scene& scene) {
  if (signals.states) return MisfitReason{Misfit::states};
  SignalMatrix head =
      detail::matrix_head(scene, scene_hash(scene), signals.provenance.seed, signals.provenance.estimator);
  if (signals.provenance.light_hash.empty()) {
    if (signals.provenance.store_hash != head.provenance.store_hash) return MisfitReason{Misfit::store};
    return SignalMatrix(std::move(signals));
  }
  if (signals.provenance.light_hash != head.provenance.light_hash) return MisfitReason{Misfit::light};
  const auto rows = matching(head.labels, signals.labels, Misfit::labels);
  if (const auto* missing = std::get_if<MisfitReason>(&rows)) return *missing;
  const auto columns = matching(head.transceivers, signals.transceivers, Misfit::transceivers);
  if (const auto* missing = std::get_if<MisfitReason>(&columns)) return *missing;
  const Numbers &i = std::get<Numbers>(rows), &j = std::get<Numbers>(columns);
  for (std::size_t k = 0; k < i.size(); ++k) {
    head.labels[k].batches = signals.labels[i[k]].batches;
    head.labels[k].samples = signals.labels[i[k]].samples;
  }
  if (!is_identity(i, signals.rows()) || !is_identity(j, signals.columns()))
    return part(signals, std::move(head), i, j);
  SignalMatrix fitting = std::move(signals);
  fitting.labels = std::move(head.labels);
  fitting.transceivers = std::move(head.transceivers);
  fitting.excluded = std::move(head.excluded);
  fitting.currency = std::move(head.currency);
  fitting.provenance = std::move(head.provenance);
  return fitting;
}

}  // namespace shelfbeam
