#pragma once

#include "serve/project/project.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {

/// A folder with a store.json of a few numbers.
class ProjectFolder {
 public:
  static constexpr std::string_view first_text = "{ // shop\n  \"a\": 1,\n  \"b\": [1, 2.0] // list\n}\n";

  explicit ProjectFolder(std::string_view text = first_text) { write_store(text); }

  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path operator/(std::string_view name) const { return folder_ / name; }
  std::filesystem::path history() const { return folder_ / ".shelfbeam" / "history.jsonl"; }

  std::string store() const { return read_file(folder_ / "store.json"); }
  /// As another program writes it.
  void write_store(std::string_view text) const { folder_.write("store.json", text); }
  void write_history(std::string_view text) const { folder_.write(".shelfbeam/history.jsonl", text); }
  /// Of the history, with their ends.
  std::vector<std::string> lines() const {
    std::vector<std::string> lines(1);
    for (const char c : read_file(history())) {
      lines.back() += c;
      if (c == '\n') lines.emplace_back();
    }
    lines.pop_back();
    return lines;
  }

 private:
  TempFolder folder_;
};

/// A project that is open in a folder, with a clock that stands still.
class OpenProject : public testing::Test {
 protected:
  Project& project() { return *project_; }
  void close() { project_.reset(); }
  void reopen(const std::function<void()>& while_closed = [] {}) {
    close();
    while_closed();
    project_.emplace(folder.path(), options());
  }
  ProjectOptions options() const {
    return {.now = [this] { return now; }};
  }
  /// Changes "a" of the first text.
  void set_a(int before, int after, const std::string& label = "Change a") {
    project().edit(label, {to_set("/a", before, after)});
  }
  /// The label of each step, with a sign: whether it is done.
  std::vector<std::string> labels() {
    std::vector<std::string> labels;
    for (const Step& step : project().steps())
      labels.push_back((labels.size() < project().position() ? "+" : "-") + step.label);
    return labels;
  }
  void expect_first_text_at_0() {
    project().go(0);
    EXPECT_EQ(folder.store(), ProjectFolder::first_text);
  }

  ProjectFolder folder;
  std::chrono::system_clock::time_point now{seconds(1'764'246'632) + milliseconds(123)};

 private:
  std::optional<Project> project_{std::in_place, folder.path(), options()};
};

}  // namespace shelfbeam::serve
