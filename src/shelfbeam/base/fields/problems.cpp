#include "shelfbeam/base/fields/problems.hpp"

#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

void Problems::keep(const InputError& error) {
  constexpr std::size_t most = 1000;
  ++failures_;
  if (!first_) {
    const auto* json = dynamic_cast<const JsonError*>(&error);
    first_ = std::current_exception() ? std::current_exception()
             : json != nullptr        ? std::make_exception_ptr(*json)
                                      : std::make_exception_ptr(error);
  }
  if (all_.size() == most || !sentences_.insert(error.what()).second) return;
  Finding finding{FindingCode::invalid, error.where(), {}, error.what()};
  if (const auto* json = dynamic_cast<const JsonError*>(&error)) {
    finding.code = json->code();
    finding.path = json->path();
    finding.values = json->values();
  } else if (finding.path.starts_with(file_ + ": ")) {
    finding.path.erase(0, file_.size() + 2);
  }
  all_.push_back(std::move(finding));
}

}  // namespace shelfbeam
