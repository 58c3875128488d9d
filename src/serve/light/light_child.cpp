#include "serve/light/light_child.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::serve {

void LightChild::start(const jobs::LightJob& job) {
  child_.reset();
  buffer_.clear();
  child_.emplace(std::vector<std::string>{program_, "light"}, memory_limit(), jobs::input_of(job));
}

void LightChild::pause() const {
  if (child_) child_->pause();
}

void LightChild::resume() const {
  if (child_) child_->resume();
}

std::vector<std::string> LightChild::poll(std::string& failure) {
  if (!child_) return {};
  jobs::ChildEnd end;
  const bool has_ended = child_->has_ended(end);
  std::vector<std::string> frames;
  for (std::string more = child_->take_output(); !more.empty(); more = child_->take_output()) {
    buffer_ += more;
    add_complete_frames(frames);
  }
  if (!has_ended) return frames;
  child_.reset();
  if (end.exit_code == 0) return frames;
  failure = end.err.substr(0, end.err.find('\n'));
  if (constexpr std::string_view mark = "error: "; failure.starts_with(mark)) failure.erase(0, mark.size());
  if (failure.empty()) failure = "the light could not be computed";
  return frames;
}

void LightChild::add_complete_frames(std::vector<std::string>& frames) {
  std::size_t at = 0;
  for (std::uint32_t size = 0; buffer_.size() - at >= sizeof size; at += sizeof size + size) {
    std::memcpy(&size, buffer_.data() + at, sizeof size);
    if (buffer_.size() - at - sizeof size < size) break;
    frames.push_back(buffer_.substr(at + sizeof size, size));
  }
  buffer_.erase(0, at);
}

}  // namespace shelfbeam::serve
