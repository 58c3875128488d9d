#pragma once

#include <cstddef>
#include <cstdint>

namespace shelfbeam::detail {

/// What a label receives from a selection: the signals' sum or the best of them; and where the selection must
/// survive the failure of any unit, what is left of that without the best unit.
enum class Receiving { sum, best, sum_without_best, second_best };

inline bool is_sum(Receiving rule) {
  return rule == Receiving::sum || rule == Receiving::sum_without_best;
}

/// The inner loops of searches, over the rows of a SearchMatrix, compiled for several kinds of processor. The
/// number of rows is a multiple of SearchMatrix::block.
struct SearchKernels {
  /// Adds a column to what rows receive. `best` is the largest signal so far, used where the rule needs it.
  static void receive(Receiving rule, const float* column, std::size_t rows, float* value, float* best);

  /// What rows lack of `target`: the signal (sum rules), or how many units of sufficient signal. Returns
  /// whether any lacks something.
  static bool lack(Receiving rule, const float* value, const float* best, float target, std::size_t rows,
                   float* lacking);

  struct Rows {
    const float* lacking;
    const float* weight;
    const float* share;  ///< of what a row lacks: columns that give at least that support it
    const float* shift;  ///< of every signal that much is not counted (sum rules)
    float target;
    std::size_t count;
  };
  /// Sum over rows of weight min(max(0, a - shift), lacking) for one column, a its signal (sum rules), or of
  /// weight min(a, lacking), a whether the signal is `target` at least; counts the column in `supporters` of
  /// the rows to which it gives scale x share.
  static float gain(Receiving rule, const float* column, float scale, const Rows& rows, float* supporters);

  /// Sum over rows of weight x lacking.
  static float need(const float* lacking, const float* weight, std::size_t rows);

  /// Whether a column gives every row what it lacks.
  static bool suffices(Receiving rule, const float* column, const float* lacking, float target,
                       std::size_t rows);

  /// Sum over rows of weight min(a, max(0, demand - held)): what adding a column of signals a is worth.
  static float worth(const float* column, const float* weight, const float* held, float demand,
                     std::size_t rows);
  /// Sum over rows of weight max(0, a - max(0, held - demand)): what removing it costs.
  static float loss(const float* column, const float* weight, const float* held, float demand,
                    std::size_t rows);

  /// Sum over rows of max(0, demand - (held - out + in)): what is lacking once one column has replaced
  /// another.
  static float lack_after(const float* held, const float* out, const float* in, float demand,
                          std::size_t rows);
  /// held += in - out.
  static void exchange(const float* out, const float* in, std::size_t rows, float* held);

  /// Sum over rows of |a - b|.
  static float distance(const float* a, const float* b, std::size_t rows);

  /// load_i += min(max(0, a - shift_i), lacking_i) / lacking_i where something is lacking.
  static void load(Receiving rule, const float* column, const Rows& rows, float* load);
};

}  // namespace shelfbeam::detail
