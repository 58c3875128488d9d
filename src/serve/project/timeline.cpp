#include "serve/project/timeline.hpp"

#include <stdexcept>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/provenance.hpp"

namespace shelfbeam::serve {

void Timeline::add(Change change) {
  const bool joins = change.joins && position_ > 0;
  steps_.resize(position_);
  if (!joins) steps_.emplace_back();
  steps_.back().push_back(std::move(change));
  position_ = steps_.size();
}

void Timeline::forget(std::size_t count) {
  begin_ = hash_at(count);
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(count));
  position_ -= count;
}

const std::string& Timeline::hash_at(std::size_t position) const {
  return position == 0 ? begin_ : steps_[position - 1].back().after;
}

std::string Timeline::text_at(std::size_t position, std::string_view present) const {
  std::string text(present);
  try {
    for (std::size_t step = position_; step > position; --step)
      for (auto change = steps_[step - 1].rbegin(); change != steps_[step - 1].rend(); ++change)
        text = spliced(text, inverse(change->splices));
    for (std::size_t step = position_; step < position; ++step)
      for (const Change& change : steps_[step]) text = spliced(text, change.splices);
  } catch (const std::invalid_argument&) {
    text.clear();
  }
  if (content_hash(text) != hash_at(position))
    throw InputError("the history", "does not fit the text", "restart the program");
  return text;
}

}  // namespace shelfbeam::serve
