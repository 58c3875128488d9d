#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Labels as people in the shop call them, by the rows of a matrix.
class LabelNames {
 public:
  LabelNames(const Scene& scene, const SignalMatrix& matrix, const Words& words);

  /// "Rye bread (G3 back, board 2)": article and place. Without a description of the article, "G3 back, board
  /// 2, at 1.25 m" on a board, and coordinates elsewhere: "W1 at 2.00, 0.50 m, 1.20 m high". If the place is
  /// unknown, the id or, instead of an article number, coordinates.
  const std::string& name(LabelId row) const { return names_[row]; }
  /// By row.
  const std::vector<std::string>& all() const { return names_; }
  /// The fixture or wall of a label, "other places" if it is unknown.
  const std::string& fixture(LabelId row) const { return fixtures_[row]; }
  /// From 1, the lowest; 0: on no board.
  int board(LabelId row) const { return boards_[row]; }

  /// "G5: 48 of 48" for each fixture of these labels, in the order of the store.
  std::vector<std::string> counts(std::span<const LabelId> rows) const;

  /// The names of a few labels, otherwise numbers by fixture: "48 on G5, 3 on C2 and others".
  std::string list(std::span<const LabelId> rows) const;

 private:
  /// The number of these labels per fixture, in the order of the store.
  std::vector<std::pair<std::string, std::size_t>> per_fixture(std::span<const LabelId> rows) const;

  Words words_;
  std::vector<std::string> names_, fixtures_;
  std::vector<int> boards_;
  std::unordered_map<std::string, std::size_t> labels_on_;  ///< by fixture
};

}  // namespace shelfbeam
