#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// Bytes of a text.
struct Range {
  std::size_t begin, end;
};

/// The tokens of a JSON text with comments, found without the code under test.
class TokenWalk {
 public:
  explicit TokenWalk(std::string_view text);

  /// The bytes that an operation may change: a value, or all between the tokens, other than commas, around
  /// the place of an insertion or a removal.
  Range changed_by(const EditOp& op) const;
  const std::vector<std::string>& comments() const { return comments_; }

 private:
  struct Part {
    std::size_t first, value, last;  ///< tokens
  };
  void read_tokens(std::string_view text);
  void read_value(const std::string& path, std::size_t first);
  Range around(std::size_t first, std::size_t last) const;

  std::vector<Range> tokens_;
  std::vector<char> kinds_;  ///< first characters
  std::vector<std::string> texts_, comments_;
  std::size_t at_ = 0;
  std::map<std::string, Part> parts_;
};

}  // namespace shelfbeam::serve
