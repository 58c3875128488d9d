// Random edits of random texts, against a model that knows values only.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/json_parser.hpp"

#include "random_json.hpp"
#include "token_walk.hpp"

namespace shelfbeam::serve {
namespace {

using Ops = std::vector<EditOp>;
using Edit = std::function<EditedText(const std::string&, const Ops&)>;

void apply_to_model(Json& model, const EditOp& op) {
  Json patch{{"path", op.path}, {"op", op.before ? op.after ? "replace" : "remove" : "add"}};
  if (op.after) patch["value"] = *op.after;
  model = model.patch(Json::array({patch}));
}

// What is wrong with an edit; empty if nothing is.
std::string mistake(const std::string& text, const Ops& ops, const EditedText& result, const Json& model) {
  if (!same_value(parse_json(result.text, "result"), model)) return "another value";
  if (!same_value(result.value, model)) return "another returned value";
  if (spliced(text, result.splices) != result.text) return "other replacements";
  if (spliced(result.text, inverse(result.splices)) != text) return "replacements without inverse";
  if (ops.size() != 1) return {};
  const TokenWalk tokens(text);
  const Range may_change = tokens.changed_by(ops[0]);
  if (!result.text.starts_with(text.substr(0, may_change.begin))) return "other bytes before the place";
  if (!result.text.ends_with(text.substr(may_change.end))) return "other bytes behind the place";
  if (!ops[0].before && TokenWalk(result.text).comments() != tokens.comments()) return "another comment";
  if (ops[0].before && ops[0].after && same_value(*ops[0].before, *ops[0].after) && !result.splices.empty())
    return "bytes of an equal value";
  return {};
}

// Edits, undoes and redoes at random, then undoes everything. Returns the first mistake.
std::string first_mistake(const Edit& edit, std::size_t edits, std::uint64_t seed) {
  RandomJson random(seed);
  constexpr std::size_t edits_per_text = 50;
  for (std::size_t done = 0; done < edits;) {
    Json model;
    while (!model.is_structured()) model = random.value(4);
    const std::string first = random.text(model);
    std::string text = first;
    std::vector<EditedText> steps;
    std::vector<std::string> before;
    for (std::size_t k = 0; k < edits_per_text; ++k, ++done) {
      Ops ops;
      for (std::size_t count = random.below(3) == 0 ? 1 + random.below(4) : 1; count > 0; --count) {
        ops.push_back(random.op(model));
        apply_to_model(model, ops.back());
      }
      EditedText result = edit(text, ops);
      if (const std::string found = mistake(text, ops, result, model); !found.empty())
        return fmt::format("{} after\n{}\nin\n{}\nwhich became\n{}", found, ops[0].path, text, result.text);
      before.push_back(text);
      text = result.text;
      steps.push_back(std::move(result));
      if (random.below(8) > 0) continue;
      const std::size_t undone = random.below(steps.size() + 1);
      for (std::size_t step = steps.size(); step > steps.size() - undone; --step) {
        text = spliced(text, inverse(steps[step - 1].splices));
        if (text != before[step - 1]) return "an undone step does not lead back";
      }
      for (std::size_t step = steps.size() - undone; step < steps.size(); ++step)
        text = spliced(text, steps[step].splices);
      if (!steps.empty() && text != steps.back().text) return "redone steps lead elsewhere";
    }
    for (auto step = steps.rbegin(); step != steps.rend(); ++step)
      text = spliced(text, inverse(step->splices));
    if (text != first) return "the first text is not found again";
  }
  return {};
}

TEST(RandomEdits, AgreeWithAModel) {
  EXPECT_EQ(first_mistake(edited, 10'000, 1), "");
}

TEST(LongRandomEdits, AgreeWithAModel) {
  EXPECT_EQ(first_mistake(edited, 100'000, 2), "");
}

// Negative control: a wrong edit among fifty is noticed.
TEST(RandomEdits, MistakesAreNoticed) {
  const auto noticed = [](const std::function<void(std::string&)>& spoil) {
    const Edit wrong = [&, count = 0](const std::string& text, const Ops& ops) mutable {
      EditedText result = edited(text, ops);
      if (++count % 50 != 0) return result;
      spoil(result.text);
      return result.splices = {splice_between(text, result.text)}, result;
    };
    return first_mistake(wrong, 2000, 3);
  };
  EXPECT_NE(noticed([](std::string& text) {
              if (const auto at = text.find("// last"); at != std::string::npos) text.erase(at, 7);
            }).find("behind the place"),
            std::string::npos)
      << "a lost comment";
  EXPECT_NE(noticed([](std::string& text) {
              if (const auto at = text.find("0,"); at != std::string::npos) text[at] = '1';
            }).find("another value"),
            std::string::npos);
  EXPECT_NE(noticed([](std::string& text) {
              if (const auto at = text.find('\t'); at != std::string::npos) text[at] = ' ';
            }).find("bytes"),
            std::string::npos);
}

}  // namespace
}  // namespace shelfbeam::serve
