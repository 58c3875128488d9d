#include "shelfbeam/report/messages/selection.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

std::string units_reach(std::size_t units) {
  return counted(units, "transceiver") + (units == 1 ? " reaches" : " reach");
}

std::string all_labels(std::size_t labels) {
  return labels == 1 ? "the only label" : "all " + counted(labels, "label");
}

std::string labels_reached(std::size_t reached, std::size_t labels) {
  if (reached == labels) return all_labels(labels);
  return fmt::format("{} of {}", grouped(reached), counted(labels, "label"));
}

std::string no_selection_reaches(std::size_t labels) {
  return "No selection reaches " + all_labels(labels);
}

std::string_view whichever_fails(const Question& question) {
  return question.redundant ? ", whichever unit fails" : "";
}

std::string_view who_gave_up(const Placement& placement) {
  if (placement.solver == "greedy") return "The greedy method";
  return placement.solver == "search" ? "The search" : "";
}

}  // namespace shelfbeam
