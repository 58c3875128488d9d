#include "serve/http/outbox.hpp"

#include <utility>

namespace shelfbeam::serve::http {

bool Outbox::push(Message message) {
  if (!messages_.empty() && waiting_ + message.bytes->size() > most_) return false;
  waiting_ += message.bytes->size();
  messages_.push_back(std::move(message));
  return true;
}

std::optional<Outbox::Fragment> Outbox::next() {
  if (!current_.bytes) {
    if (messages_.empty()) return std::nullopt;
    current_ = std::move(messages_.front());
    messages_.pop_front();
    waiting_ -= current_.bytes->size();
    sent_ = 0;
  }
  Fragment fragment{current_, std::string_view(*current_.bytes).substr(sent_, fragment_)};
  sent_ += fragment.bytes.size();
  fragment.is_last = sent_ == current_.bytes->size();
  if (fragment.is_last) current_ = {};
  return fragment;
}

void Outbox::clear() {
  messages_.clear();
  current_ = {};
  waiting_ = 0;
}

}  // namespace shelfbeam::serve::http
