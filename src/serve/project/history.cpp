#include "serve/project/history.hpp"

#include <algorithm>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/provenance.hpp"

#include "serve/project/regular_file.hpp"

namespace shelfbeam::serve {

namespace {

[[noreturn]] void does_not_follow() {
  throw InputError("a record", "does not follow from those before it");
}

std::size_t bytes_of(const Timeline::Changes& step) {
  std::size_t bytes = 0;
  for (const Change& change : step)
    for (const Splice& splice : change.splices) bytes += splice.before.size() + splice.after.size();
  return bytes;
}

// How many of the oldest steps exceed the limits; the texts of the others use at most half of the bytes.
std::size_t outdated(const Timeline& timeline, const HistoryLimits& limits) {
  const auto& steps = timeline.steps();
  std::size_t kept = 0, bytes = 0;
  while (kept < std::min(steps.size(), limits.steps)) {
    bytes += bytes_of(steps[steps.size() - kept - 1]);
    if (bytes > limits.bytes / 2) break;
    ++kept;
  }
  // The text that the history then begins with is one of the applied steps.
  return std::min(steps.size() - kept, timeline.position());
}

}  // namespace

History::History(std::filesystem::path path, const HistoryLimits& limits)
    : file_(std::move(path)), limits_(limits), most_bytes_(limits.bytes) {
  const auto found = read_regular_file(file_.path(), max_text_file);
  if (!found) return;
  read(found->content);
  if (texts_) shorten(texts_->last);
}

void History::read(std::string_view content) {
  std::size_t at = 0, end = 0;
  for (std::size_t number = 1; (end = content.find('\n', at)) != std::string_view::npos; ++number) {
    try {
      replay(read_record(content.substr(at, end - at),
                         fmt::format("{}: line {}", file_.path().string(), number)));
    } catch (const OtherHistoryFormat&) {
      throw;
    } catch (const InputError&) {
      break;
    } catch (const std::invalid_argument&) {
      break;
    }
    at = end + 1;
  }
  const bool is_last = content.find('\n', at) >= content.size() - 1;
  if (at < content.size() && (at == 0 || !is_last)) write_file(file_.path().string() + ".damaged", content);
  if (at > 0) file_.open(at);
}

void History::replay(const Record& record) {
  if (const auto* beginning = std::get_if<Beginning>(&record)) {
    if (texts_) does_not_follow();
    texts_.emplace().last = beginning->text;
    timeline_ = Timeline(content_hash(beginning->text));
    return;
  }
  if (!texts_) does_not_follow();
  std::string text;
  const std::string& hash = timeline_.hash_at(timeline_.position());
  if (const auto* change = std::get_if<Change>(&record)) {
    text = spliced(texts_->last, change->splices);
    if (change->before != hash || content_hash(text) != change->after) does_not_follow();
    timeline_.add(*change);
  } else {
    const auto& move = std::get<Move>(record);
    if (move.before != hash || move.position > timeline_.steps().size()) does_not_follow();
    text = timeline_.text_at(move.position, texts_->last);
    timeline_.move(move.position);
  }
  texts_->before = std::exchange(texts_->last, std::move(text));
}

void History::begin(const std::string& text, const std::string& time) {
  file_.replace(line_of(Beginning{time, text}));
  timeline_ = Timeline(content_hash(text));
}

void History::write(const Record& record) {
  file_.append(line_of(record));
}

void History::accept(const Record& record, const std::string& text) {
  if (const auto* change = std::get_if<Change>(&record))
    timeline_.add(*change);
  else
    timeline_.move(std::get<Move>(record).position);
  shorten(text);
}

void History::shorten(const std::string& text) {
  if (timeline_.steps().size() <= 2 * limits_.steps && file_.size() <= most_bytes_) return;
  try {
    rewrite(outdated(timeline_, limits_), text);
  } catch (const OutputError&) {  // the long history is as good
  }
}

void History::rewrite(std::size_t count, const std::string& text) {
  Timeline kept = timeline_;
  kept.forget(count);
  const auto& steps = kept.steps();
  const std::string& time =
      timeline_.steps().empty() ? "" : timeline_.steps()[count == 0 ? 0 : count - 1].back().time;
  std::string content = line_of(Beginning{time, timeline_.text_at(count, text)});
  for (const Timeline::Changes& step : steps)
    for (const Change& change : step) content += line_of(change);
  if (kept.position() < steps.size())
    content += line_of(Move{steps.back().back().time, kept.position(), kept.hash_at(steps.size()),
                            kept.hash_at(kept.position())});
  file_.replace(content);
  timeline_ = std::move(kept);
  most_bytes_ = std::max(limits_.bytes, 2 * file_.size());
}

}  // namespace shelfbeam::serve
