#include "shelfbeam/scene/store_names.hpp"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

template <class Id>
std::uint32_t NameIndex<Id>::find(const std::string& name, const std::string& where,
                                  const JsonCursor* cursor) const {
  if (const auto found = names_.find(name); found != names_.end()) return found->second;
  if (problems_ != nullptr) problems_->expect_complete(what_);
  std::vector<std::string_view> known;
  for (const auto& [key, index] : names_) known.push_back(key);
  const std::string problem = fmt::format("names the unknown {} {}", what_, in_quotes(name)),
                    remedy = known.empty() ? "define it first" : suggest(name, known);
  if (cursor != nullptr) cursor->fail(problem, remedy, FindingCode::unknown_name, {name});
  throw InputError(where, problem, remedy);
}

template class NameIndex<MaterialId>;
template class NameIndex<LabelTypeId>;
template class NameIndex<TransceiverTypeId>;

std::uint32_t StoreNames::index(NameList list, const JsonCursor& name) const {
  if (list == NameList::material) return material(name).value;
  return list == NameList::label_type ? label_type(name).value : transceiver_type(name).value;
}

}  // namespace shelfbeam
