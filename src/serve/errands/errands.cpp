#include "serve/errands/errands.hpp"

#include <system_error>
#include <utility>

#include "serve/errands/comparison.hpp"
#include "serve/file_document.hpp"
#include "serve/project/archive.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

constexpr auto difference_name = "difference.html";
constexpr auto archive_name = "project.zip";

}  // namespace

Errands::Errands(fs::path folder, const std::string& program)
    : folder_(std::move(folder)),
      comparison_(program, "comparison", "the comparison"),
      difference_(program, "difference", "the comparison"),
      archive_(program, "archive", "the archive") {}

bool Errands::begin(const Request& request, const PlanRuns& plans) {
  const std::string verb = request.text("do");
  if (verb == "compare") {
    auto [words, names] =
        comparison_command(folder_, request.text("file"), request.json.value("of_pairs", false));
    comparison_.start(request, std::move(words), std::move(names));
  } else if (verb == "difference") {
    const auto plan = [&](const char* key) {
      return (folder_ / plans.at(request.number(key)).folder).string();
    };
    difference_.start(request,
                      {"diff", plan("before"), plan("after"), "-o", own_file(difference_name).string()});
  } else if (verb == "archive") {
    archive_.start(request, {"archive", folder_.string(), "-o", own_file(archive_name).string()});
  } else {
    return false;
  }
  return true;
}

std::vector<LateReply> Errands::poll() {
  std::vector<LateReply> replies;
  for (Errand* errand : {&comparison_, &difference_, &archive_})
    if (auto reply = errand->poll()) replies.push_back(std::move(*reply));
  return replies;
}

std::optional<http::Document> Errands::document(std::string_view name) {
  if (name == "difference") return document_of(own_file(difference_name), true);
  if (name != "archive") return {};
  auto archive = document_of(own_file(archive_name), false, max_archived_bytes);
  std::error_code ignored;
  fs::remove(own_file(archive_name), ignored);
  return archive;
}

}  // namespace shelfbeam::serve
