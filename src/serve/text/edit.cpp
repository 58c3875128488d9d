#include "serve/text/edit.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/text/gap.hpp"
#include "serve/text/layout.hpp"
#include "serve/text/text_tree.hpp"
#include "serve/text/tree_edit.hpp"

namespace shelfbeam::serve {

namespace {

const std::string text_name = "the text";

// A list that grows or shrinks by more elements is written anew, as each of them moves those behind it.
constexpr std::size_t most_moved = 1000;

std::string quoted(const Json& value) {
  constexpr std::size_t most = 80;
  return shortened(value.dump(-1, ' ', false, Json::error_handler_t::replace), most);
}

std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps;
  try {
    for (Json::json_pointer rest(path); !rest.empty(); rest.pop_back()) steps.push_back(rest.back());
  } catch (const Json::parse_error&) {
    throw EditConflict(path, "is not a JSON pointer");
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

// Applies operations to the value and to the text alike.
class Editor {
 public:
  explicit Editor(std::string_view text)
      : value_(parse_json(text, text_name)), tree_(text), layout_(layout_of(text)) {}

  void apply(const EditOp& op) {
    const std::vector<std::string> steps = steps_of(op.path);
    if (!op.before && !op.after) throw EditConflict(op.path, "has neither an old nor a new value");
    if (op.after)
      if (const std::string problem = value_problem(*op.after, steps.size()); !problem.empty())
        throw EditConflict(op.path, problem);
    Place place{&value_, &tree_.root(), ""};
    for (std::size_t k = 0; k + 1 < steps.size(); ++k)
      if (!enter(place, steps[k])) throw EditConflict(op.path, "does not exist");
    if (!op.before) {
      insert_at(place, steps, op);
      return;
    }
    const Place around = place;
    if (!steps.empty() && !enter(place, steps.back())) throw EditConflict(op.path, "does not exist");
    if (!same_value(*place.value, *op.before))
      throw EditConflict(op.path, fmt::format("is {}, not {}", quoted(*place.value), quoted(*op.before)));
    if (op.after)
      set(place, *op.after);
    else if (steps.empty())
      throw EditConflict(op.path, "cannot be removed");
    else
      remove_at(around, steps.back());
  }

  Json& value() { return value_; }
  std::vector<Splice> splices() const { return tree_.changes(); }

 private:
  struct Place {
    Json* value;
    TextNode* node;
    std::string indentation;  ///< of its line
    std::size_t used = 0;     ///< of that line, before the value
  };

  // The position of a part among its siblings; their number if it does not exist.
  static std::size_t position(const Json& value, const std::string& step) {
    if (value.is_array()) return to_whole_number(step, value.size()).value_or(value.size());
    if (!value.is_object()) return value.size();
    return static_cast<std::size_t>(std::distance(value.begin(), value.find(step)));
  }

  static std::vector<TextElement>& elements_of(const Place& place) {
    std::vector<TextElement>& elements = TextTree::open(*place.node).list;
    if (elements.size() != place.value->size())
      throw std::logic_error("the elements of a text are not those of its value");
    return elements;
  }

  static bool enter(Place& place, const std::string& step) {
    const std::size_t index = position(*place.value, step);
    if (!place.value->is_structured() || index >= place.value->size()) return false;
    enter(place, index);
    return true;
  }
  static void enter(Place& place, std::size_t index) {
    TextElement& element = elements_of(place)[index];
    if (element.begins_line()) place.indentation = indentation(element.before);
    place.used = place.indentation.size() + element.name.size();
    place.node = &element.value;
    place.value = &*std::next(place.value->begin(), static_cast<std::ptrdiff_t>(index));
  }

  void insert_at(const Place& place, const std::vector<std::string>& steps, const EditOp& op) {
    if (steps.empty()) throw EditConflict(op.path, "exists already");
    Json& parent = *place.value;
    const std::string& step = steps.back();
    if (parent.is_structured()) elements_of(place);
    if (parent.is_array()) {
      const auto index = to_whole_number(step, parent.size());
      if (!index)
        throw EditConflict(op.path, fmt::format("is not a place in a list of {} elements", parent.size()));
      insert(tree_, *place.node, {*index, "", place.indentation}, *op.after, layout_);
      parent.insert(std::next(parent.begin(), static_cast<std::ptrdiff_t>(*index)), *op.after);
    } else if (parent.is_object()) {
      if (!is_utf8(step)) throw EditConflict(op.path, "has a key that is not UTF-8");
      if (parent.contains(step)) throw EditConflict(op.path, "exists already");
      append(place, step, *op.after);
    } else {
      throw EditConflict(op.path, "does not exist");
    }
  }

  void append(const Place& place, const std::string& key, const Json& value) {
    Json& parent = *place.value;
    insert(tree_, *place.node, {parent.size(), key, place.indentation}, value, layout_);
    if (parent.is_array())
      parent.push_back(value);
    else
      parent.get_ref<Json::object_t&>().emplace_back(key, value);
  }

  void remove_at(const Place& place, const std::string& step) {
    const std::size_t index = position(*place.value, step);
    remove(tree_, *place.node, index, layout_);
    place.value->erase(std::next(place.value->begin(), static_cast<std::ptrdiff_t>(index)));
  }

  void set(const Place& place, const Json& after) {
    Json& before = *place.value;
    if (same_value(before, after)) return;
    if (before.is_object() && after.is_object() && !before.empty()) {
      set_members(place, after);
    } else if (before.is_array() && after.is_array() && !before.empty() &&
               std::max(before.size(), after.size()) - std::min(before.size(), after.size()) < most_moved) {
      set_elements(place, after);
    } else {
      tree_.set(*place.node,
                value_text(after, layout_, place.indentation, room_behind(place.used, place.node->text),
                           fills_lines(place.node->text)));
      before = after;
    }
  }

  // New members come first, so that the object is never empty in between.
  void set_members(const Place& place, const Json& after) {
    std::vector<std::string> outdated;
    for (const auto& [key, value] : place.value->items())
      if (!after.contains(key)) outdated.push_back(key);
    for (const auto& [key, value] : after.items()) {
      Place member = place;
      if (enter(member, key))
        set(member, value);
      else
        append(place, key, value);
    }
    for (const std::string& key : outdated) remove_at(place, key);
  }

  // Equal elements at both ends stay as they are.
  void set_elements(const Place& place, const Json& after) {
    Json& before = *place.value;
    const std::size_t shorter = std::min(before.size(), after.size());
    std::size_t front = 0, back = 0;
    while (front < shorter && same_value(before[front], after[front])) ++front;
    while (back < shorter - front &&
           same_value(before[before.size() - 1 - back], after[after.size() - 1 - back]))
      ++back;
    for (std::size_t k = front; k < shorter - back; ++k) {
      Place element = place;
      enter(element, k);
      set(element, after[k]);
    }
    for (std::size_t k = shorter - back; k < after.size() - back; ++k) {
      insert(tree_, *place.node, {k, "", place.indentation}, after[k], layout_);
      before.insert(std::next(before.begin(), static_cast<std::ptrdiff_t>(k)), after[k]);
    }
    while (before.size() > after.size()) remove_at(place, std::to_string(before.size() - back - 1));
  }

  Json value_;
  TextTree tree_;
  Layout layout_;
};

}  // namespace

EditedText edited(std::string_view text, const std::vector<EditOp>& ops) {
  Editor editor(text);
  for (const EditOp& op : ops) editor.apply(op);
  std::vector<Splice> splices = editor.splices();
  EditedText result{spliced(text, splices), {}, std::move(splices)};
  const std::string path = ops.size() == 1 ? ops.front().path : "";
  try {
    result.value = parse_json(result.text, text_name, max_document);
  } catch (const InputError& error) {
    throw EditConflict(path, std::string("cannot be changed so: ") + error.what());
  }
  // The file of a person is at stake: no mistake of ours may pass.
  if (!same_value(result.value, editor.value())) throw std::logic_error("an edit has changed other values");
  return result;
}

}  // namespace shelfbeam::serve
