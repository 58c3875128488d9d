// Tests that `plan` never replaces a finished plan or a file of the user, and never shares its folder.

#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::Json;
using test::names;
using test::small_store;

class PlanFolder : public test::ProgramTest {
 protected:
  static constexpr auto plan =
      "plan @store.json -o @plan --samples 64 --estimator uniform --no-certificate --quiet";
  std::string overwriting() const { return std::string(plan) + " --overwrite"; }
  void append_to(const std::string& name) const { folder.write(name, bytes(name) + "\n"); }
};

TEST_F(PlanFolder, AFinishedPlanIsReplacedOnRequestOnly) {
  told(plan);
  const auto before = contents(folder / "plan");
  for (const char* more : {"", " --seed 2", " --resume"})
    refused(plan + std::string(more),
            {path("plan") + ": contains a finished plan", "(--overwrite, --signal)"});
  told(overwriting() + " --seed 2");
  EXPECT_FALSE(bytes("plan/signal.h5") == before.at("signal.h5"));
  told(overwriting());
  EXPECT_TRUE(bytes("plan/signal.h5") == before.at("signal.h5"));
  EXPECT_EQ(names(folder / "plan").size(), before.size());
}

TEST_F(PlanFolder, FilesOfTheUserAreNeverReplaced) {
  for (const char* name : {"labels.csv", "placement.csv", "verification.csv", "report.html", "signal.h5",
                           "store.json", "placement.json"}) {
    folder.write(std::string("plan/") + name, "mine");
    refused(overwriting(), {path("plan") + "/" + name + ": was not written by an earlier run"});
    fs::remove_all(folder / "plan");
  }
  for (const char* name : {".plan.shelfbeam-record", "signal.h5.checkpoint"}) {
    folder.write(std::string("plan/") + name, "mine");
    refused(overwriting(), {path("plan") + "/" + name + ": "});
    EXPECT_EQ(bytes(std::string("plan/") + name), "mine");
    fs::remove_all(folder / "plan");
  }
  folder.write("plan/notes.txt", "mine");
  told(plan);
  EXPECT_EQ(bytes("plan/notes.txt"), "mine");
}

TEST_F(PlanFolder, FilesThatTheUserChangedAreNeverReplaced) {
  told(plan);
  for (const char* name :
       {"labels.csv", "placement.csv", "report.html", "signal.h5", "store.json", "placement.json"}) {
    const std::string file = std::string("plan/") + name, before = bytes(file);
    folder.write(file, std::string(name) == "placement.json"
                           ? "{" + before.substr(1, 20) + " " + before.substr(21)
                           : before + "\n");
    refused(overwriting(), {path(file) + ": ", "was changed since"});
    folder.write(file, before);
  }
  // Behind or in the record.
  const std::string placement = bytes("plan/placement.json");
  for (const std::string& text :
       {placement + "// mine\n", placement.substr(0, placement.size() - 2) + ", \"mine\": 1 }\n"}) {
    folder.write("plan/placement.json", text);
    refused(overwriting(), {path("plan/placement.json") + ": ", "was changed since"});
  }
  folder.write("plan/placement.json", placement);
  folder.write("plan/verification.csv", "id,verdict\n");  // not part of this plan
  refused(overwriting(), {path("plan/verification.csv") + ": "});
  fs::remove(folder / "plan/verification.csv");
  told(overwriting());
}

TEST_F(PlanFolder, ReportReplacesUnchangedFilesOnly) {
  told(plan);
  for (const char* name : {"labels.csv", "placement.csv", "report.html", "placement.json"}) {
    const std::string file = std::string("plan/") + name, before = bytes(file);
    append_to(file);
    refused("report @plan", {path(file) + ": was changed since the plan was written"});
    folder.write(file, before);
  }
  fs::remove(folder / "plan/labels.csv");
  told("report @plan");
  told(overwriting());
}

TEST_F(PlanFolder, ReportRefusesAnInvalidRecord) {
  told(plan);
  const std::string file = path("plan/placement.json");
  const Json placement = json("plan/placement.json");
  for (const auto& [files, where] : std::vector<std::pair<Json, std::string>>{
           {7, ": files"}, {{{"x", 3}}, ": files.x"}, {nullptr, ": "}, {{{"x", "y"}}, ": was changed"}}) {
    Json changed = placement;
    changed["files"] = files;
    if (files.is_null()) changed.erase("files");
    folder.write("plan/placement.json", changed.dump(2) + "\n");
    refused("report @plan", {file + where});
  }
  folder.write("plan/placement.json", "// mine\n" + placement.dump(2) + "\n");
  refused("report @plan", {file + ": was changed"});
}

TEST_F(PlanFolder, ARefusedPlanLeavesNoNewFolders) {
  Json store = small_store();
  store["label_types"]["standard"]["threshold"] = -1;
  folder.write("wrong.json", store.dump());
  for (const std::string name : {"n1/n2/n3", "n1/n2/n3/"}) {
    refused("plan @wrong.json -o @" + name, {});
    refused("plan @store.json --memory 1K -o @" + name, {"memory"}, 5);
  }
  refused("plan @wrong.json -o @n1/n2/" + std::string(300, 'x'), {});
  refused("plan @store.json -o @n1/n2/" + std::string(300, 'x'), {"File name too long"});
  folder.write("old/notes.txt", "mine");
  refused("plan @store.json -o @old/n2/n3 --memory 1K", {"memory"}, 5);
}

// `simulate` may have taken hours for this file.
TEST_F(PlanFolder, ASignalFileWithoutAPlanIsKept) {
  fs::create_directory(folder / "plan");
  told("simulate @store.json -o @plan/signal.h5 --samples 64");
  refused(overwriting(), {path("plan/signal.h5") + ": was not written by an earlier run"});
}

// Without a record nothing shows whether the user has edited a file.
TEST_F(PlanFolder, FilesWithoutARecordAreNeverReplaced) {
  told("plan @store.json -o @whole --samples 64 --quiet");
  fs::create_directory(folder / "plan");
  for (const char* name : {"signal.h5", "verification.csv", "labels.csv", "placement.csv", "report.html"}) {
    const std::string file = std::string("plan/") + name;
    folder.write(file, bytes(std::string("whole/") + name));
    for (const std::string& line : {std::string(plan), overwriting()})
      refused(line, {path(file) + ": was not written by an earlier run"});
    fs::remove(folder / file);
  }
  folder.write("plan/store.json", bytes("whole/store.json"));  // would not change
  told(plan);
}

TEST_F(PlanFolder, LinksAreNeverReplaced) {
  told(plan);
  fs::rename(folder / "plan/labels.csv", folder / "shared.csv");
  for (const char* target : {"../shared.csv", "../missing.csv"}) {
    fs::create_symlink(target, folder / "plan/labels.csv");
    const test::Outcome outcome = test::shelfbeam(test::words(folder, overwriting()));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("plan/labels.csv: was not written by"), std::string::npos) << outcome.err;
    EXPECT_TRUE(fs::is_symlink(folder / "plan/labels.csv"));
    fs::remove(folder / "plan/labels.csv");
  }
  told(overwriting());
}

TEST_F(PlanFolder, APlanOfAnEarlierVersionIsReplacedOnRequest) {
  const fs::path old = fs::path(SHELFBEAM_SOURCE_DIR) / "test/system/compatibility/0.2.0/plan";
  fs::copy(old, folder / "plan");
  refused(plan, {path("plan") + ": contains a finished plan", "(--overwrite)"});
  told(overwriting());
  EXPECT_EQ(json("plan/placement.json")["complete"], true);
}

// A journal of a run that was killed while it renamed its files.
TEST_F(PlanFolder, FilesOfAKilledPlanAreReplaced) {
  told(plan);
  std::string journal;
  const Json record = json("plan/placement.json")["files"];
  for (const auto& [name, hash] : record.items()) journal += name + " " + hash.get<std::string>() + "\n";
  fs::remove(folder / "plan/placement.json");
  refused(plan, {"was not written by"});
  folder.write("plan/.plan.shelfbeam-record", journal);
  const std::string labels = bytes("plan/labels.csv");
  append_to("plan/labels.csv");
  refused(plan, {"plan/labels.csv: was not written by"});
  folder.write("plan/labels.csv", labels);
  told(plan);
  EXPECT_EQ(json("plan/placement.json")["complete"], true);
  EXPECT_FALSE(fs::exists(folder / "plan/.plan.shelfbeam-record"));
}

TEST_F(PlanFolder, AnInterruptedRunKeepsAFinishedPlan) {
  told(plan);
  const auto before = contents(folder / "plan");
  const std::string longer =
      "plan @store.json -o @plan --samples 4000000 --overwrite --no-certificate --checkpoint-interval 0 "
      "--threads 1 ";
  test::Process process(test::command(test::words(folder, longer)));
  process.wait_for_changes(path("plan/signal.h5.checkpoint"), 3);
  process.send(SIGINT);
  const test::Outcome outcome = process.wait();
  ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(outcome.err, "stopped early: the finished plan in " + path("plan") +
                             " is unchanged; repeat the command with '--resume' to continue\n");
  auto after = contents(folder / "plan");
  EXPECT_EQ(after.erase("signal.h5.checkpoint"), 1U);
  EXPECT_TRUE(after == before);
}

// The only checkpoint is that of the complete simulation.
TEST_F(PlanFolder, AnInterruptionAfterTheSimulationKeepsItsCheckpoint) {
  const std::string simple = "plan @store.json -o @plan --samples 16000 --no-certificate --threads 1 ";
  const std::string longer = simple + "--sensitivity ";
  for (const std::string more : {"", "--overwrite "}) {
    fs::remove_all(folder / "plan");
    if (!more.empty()) told(plan);
    test::Process process(test::command(test::words(folder, longer + more)));
    process.wait_for_changes(path("plan/signal.h5.checkpoint"), 1);
    process.send(SIGINT);
    const test::Outcome outcome = process.wait();
    ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
    const std::string state = more.empty() ? "the simulation is complete, but the later steps are not"
                                           : "the finished plan in " + path("plan") + " is unchanged";
    EXPECT_EQ(outcome.err, "stopped early: " + state + "; repeat the command with '--resume' to continue\n");
    ASSERT_TRUE(fs::exists(folder / "plan/signal.h5.checkpoint"));
    // The later steps are not part of the checkpoint, and take long: once is enough.
    const std::string again = (more.empty() ? longer : simple) + more + "--resume";
    const std::string out = test::shelfbeam(test::words(folder, again)).out;
    EXPECT_NE(out.find("continued from the checkpoint"), std::string::npos) << out;
    EXPECT_FALSE(fs::exists(folder / "plan/signal.h5.checkpoint"));
  }
}

TEST_F(PlanFolder, AnInterruptedPlanMayBeReplaced) {
  const std::string longer =
      "plan @store.json -o @plan --samples 4000000 --no-certificate --checkpoint-interval 0 --threads 1 ";
  test::Process process(test::command(test::words(folder, longer)));
  process.wait_for_changes(path("plan/signal.h5.checkpoint"), 3);
  process.send(SIGINT);
  ASSERT_EQ(process.wait().exit_code, 3);
  EXPECT_EQ(json("plan/placement.json")["complete"], false);
  told(plan);
  EXPECT_EQ(json("plan/placement.json")["complete"], true);
}

// A file that the user saves, or a plan that is copied there, while the simulation runs.
TEST_F(PlanFolder, FilesThatAppearDuringTheRunAreNeverReplaced) {
  told("plan @store.json -o @other --samples 64 --no-certificate --quiet");
  const std::string longer =
      "plan @store.json -o @plan --samples 4000000 --no-certificate --checkpoint-interval 0 --threads 1 "
      "--overwrite ";
  for (const bool whole : {false, true}) {
    fs::remove_all(folder / "plan");
    test::Process process(test::command(test::words(folder, longer)));
    process.wait_for_changes(path("plan/signal.h5.checkpoint"), 3);
    if (whole)
      fs::copy(folder / "other", folder / "plan");
    else
      folder.write("plan/labels.csv", "mine");
    process.send(SIGINT);
    const test::Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 2);
    const std::string problem = whole ? path("plan") + ": has received a finished plan since"
                                      : path("plan/labels.csv") + ": was not written by";
    EXPECT_NE(outcome.err.find(problem), std::string::npos) << outcome.err;
    const std::string mark = "the plan is kept in '";
    const std::size_t begin = outcome.err.find(mark);
    ASSERT_NE(begin, std::string::npos) << outcome.err;
    const std::string rest = outcome.err.substr(begin + mark.size());
    const fs::path kept = rest.substr(0, rest.find('\''));
    EXPECT_EQ(names(kept), names(folder / "other"));
    fs::remove_all(kept);
    auto found = contents(folder / "plan");
    EXPECT_EQ(found.erase("signal.h5.checkpoint"), 1U);
    EXPECT_TRUE(found == (whole ? contents(folder / "other")
                                : std::map<std::string, std::string>{{"labels.csv", "mine"}}));
  }
}

TEST_F(PlanFolder, AnOutputInUseIsRefused) {
  for (const std::string line : {"plan @store.json -o @plan ", "simulate @store.json -o @signal.h5 "}) {
    test::Process process(
        test::command(test::words(folder, line + "--samples 60000000000 --estimator uniform --quiet")));
    const std::string output = path(line.starts_with("plan") ? "plan" : "signal.h5");
    const fs::path lock =
        (fs::is_directory(output) || line.starts_with("plan") ? fs::path(output) : folder.path()) /
        ".signal.h5.shelfbeam-locked";
    process.wait_for_changes(lock, 1);
    for (std::string pid; pid.empty() && !process.has_ended();) pid = read_file(lock);
    const std::string pid = read_file(lock).substr(0, read_file(lock).find('\n'));
    // Meanwhile, the first process may still add and remove files.
    const test::Outcome second = test::shelfbeam(test::words(folder, line + "--samples 64"));
    EXPECT_EQ(second.exit_code, 2);
    EXPECT_NE(
        second.err.find(fmt::format("{}: is in use by another run of shelfbeam (process {})", output, pid)),
        std::string::npos)
        << second.err;
    process.send(SIGKILL);
    process.wait();
    // The kernel has removed the lock, though not its file.
    EXPECT_TRUE(fs::exists(lock));
    told(line + "--samples 64 --quiet");
    EXPECT_FALSE(fs::exists(lock));
  }
}

}  // namespace
}  // namespace shelfbeam
