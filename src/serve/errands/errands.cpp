#include "serve/errands/errands.hpp"

#include <system_error>
#include <utility>

#include "serve/errands/comparison.hpp"
#include "serve/file_document.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

constexpr auto difference_name = "difference.html";
constexpr auto archive_name = "project.zip";

}  // namespace

Errands::Errands(fs::path folder, const std::string& program)
    : folder_(std::move(folder)),
      comparison_(program, "comparison", "the comparison with measurements"),
      difference_(program, "difference", "the comparison of two plans"),
      report_(program, "report", "the report"),
      archive_(program, "archive", "the archive") {
  remove_archives();
}

Errands::~Errands() {
  remove_archives();
}

// Also what a program left that was killed while it packed.
void Errands::remove_archives() const {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_ / ".shelfbeam", error))
    if (entry.path().filename().string().starts_with(archive_name)) fs::remove(entry.path(), error);
}

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
  } else if (verb == "plan_report") {
    report_.start(request, {"report", (folder_ / plans.at(request.number("plan")).folder).string(), "--store",
                            (folder_ / "store.json").string()});
  } else if (verb == "archive") {
    archive_.start(request, {"archive", folder_.string(), "-o", own_file(archive_name).string()});
  } else {
    return false;
  }
  return true;
}

std::vector<LateReply> Errands::poll() {
  std::vector<LateReply> replies;
  for (Errand* errand : {&comparison_, &difference_, &report_, &archive_})
    if (auto reply = errand->poll()) replies.push_back(std::move(*reply));
  return replies;
}

std::optional<http::Document> Errands::document(std::string_view name) const {
  if (name == "difference") return document_of(own_file(difference_name), true);
  if (name == "archive") return document_of(own_file(archive_name));
  return {};
}

}  // namespace shelfbeam::serve
