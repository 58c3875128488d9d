#pragma once

#include <cstddef>
#include <cstdint>

namespace shelfbeam::detail {

/// The signal of a label: the sum or the largest of the chosen signals; with unit failure, the same without
/// the largest.
enum class Receiving { sum, best, sum_without_best, second_best };

inline bool is_sum(Receiving rule) {
  return rule == Receiving::sum || rule == Receiving::sum_without_best;
}

/// The inner loops of searches, over the rows of a SearchMatrix, compiled for several processor types. Row
/// counts are multiples of SearchMatrix::block.
struct SearchKernels {
  /// Adds a column to the signals of the rows. `best` is the largest signal so far, for rules that omit it.
  static void receive(Receiving rule, const float* column, std::size_t rows, float* value, float* best);

  /// The lack of every row relative to `target`: in signal (sum rules), or in units that reach it alone.
  /// Returns true if any row lacks something.
  static bool lack(Receiving rule, const float* value, const float* best, float target, std::size_t rows,
                   float* lacking);

  struct Rows {
    const float* lacking;
    const float* weight;
    const float* share;  ///< r_i / b or r_i / C: columns that contribute this much support the row
    const float* shift;  ///< s_i: part of every signal that is not counted (sum rules)
    float target;
    std::size_t count;
  };
  /// The gain of one column with signals a:
  ///
  ///   sum_i weight_i min(lacking_i, max(0, a_i - shift_i))    (sum rules)
  ///   sum_i weight_i min(lacking_i, [a_i >= target])          (others)
  ///
  /// Increments `supporters` of the rows to which the column contributes scale x share.
  static float gain(Receiving rule, const float* column, float scale, const Rows& rows, float* supporters);

  /// sum_i weight_i lacking_i.
  static float need(const float* lacking, const float* weight, std::size_t rows);

  /// Whether a column supplies the whole lack of every row.
  static bool suffices(Receiving rule, const float* column, const float* lacking, float target,
                       std::size_t rows);

  /// Value of adding a column of signals a: sum_i weight_i min(a_i, max(0, demand - held_i)).
  static float worth(const float* column, const float* weight, const float* held, float demand,
                     std::size_t rows);
  /// Loss of removing it: sum_i weight_i max(0, a_i - max(0, held_i - demand)).
  static float loss(const float* column, const float* weight, const float* held, float demand,
                    std::size_t rows);

  /// The sums of the chosen columns and, if a unit may fail, the two largest signals of every row (received
  /// as `second_best`); null otherwise.
  struct Held {
    const float* sum;
    const float* best;
    const float* second;
  };
  /// Total lack after one column replaces another: sum_i max(0, demand - S_i), S_i = sum_i - out_i + in_i,
  /// less the largest of these signals if a unit may fail.
  static float lack_after(const Held& held, const float* out, const float* in, float demand,
                          std::size_t rows);
  /// The weight of the rows missed after the same exchange: sum_i weight_i [S_i < demand].
  static float missed_after(const Held& held, const float* out, const float* in, float demand,
                            const float* weight, std::size_t rows);
  /// held_i += in_i - out_i.
  static void exchange(const float* out, const float* in, std::size_t rows, float* held);

  /// sum_i |a_i - b_i|.
  static float distance(const float* a, const float* b, std::size_t rows);

  /// load_i += min(lacking_i, max(0, a_i - shift_i)) / lacking_i for rows with lacking_i > 0.
  static void load(Receiving rule, const float* column, const Rows& rows, float* load);
};

}  // namespace shelfbeam::detail
