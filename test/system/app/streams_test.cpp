// Tests of closed and full standard streams, and of pipes that are closed early.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Outcome;

class Streams : public test::ProgramTest {
 protected:
  // Runs the program with a redirection of the shell.
  Outcome redirected(const std::string& redirection, const std::string& line) const {
    std::vector<std::string> all{"/bin/sh", "-c", "exec \"$0\" \"$@\" " + redirection};
    for (const std::string& word : test::command(test::words(folder, line))) all.push_back(word);
    return test::run(all);
  }
};

TEST_F(Streams, MessagesThatCannotBeWrittenKeepTheExitCode) {
  for (const char* redirection : {"", "2>&-", "2>/dev/full", "2>&- >&- <&-"}) {
    SCOPED_TRACE(redirection);
    EXPECT_EQ(redirected(redirection, "inspect @missing.json").exit_code, 2);
    EXPECT_EQ(redirected(redirection, "unknown").exit_code, 2);
    EXPECT_EQ(redirected(redirection, "simulate @store.json -o @signal.h5 --samples 64 --quiet").exit_code,
              0);
  }
}

TEST_F(Streams, MessagesThatNobodyReadsKeepTheExitCode) {
  std::vector<std::string> all{"/bin/sh", "-c",
                               "exec 3>&1; { sleep 0.3; \"$0\" \"$@\" 2>&1 >&3; echo $? >&3; } | true"};
  for (const std::string& word : test::command(test::words(folder, "inspect @missing.json")))
    all.push_back(word);
  EXPECT_EQ(test::run(all).out, "2\n");
}

TEST_F(Streams, ResultsThatCannotBePrintedAreAnError) {
  for (const char* redirection : {">&-", ">/dev/full"})
    for (const char* line : {"inspect @store.json", "inspect @store.json --json", "--help", "--version",
                             "simulate @store.json -o @signal.h5 --samples 64"}) {
      SCOPED_TRACE(std::string(line) + redirection);
      const Outcome outcome = redirected(redirection, line);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_TRUE(outcome.err.starts_with("error: standard output: cannot be written (")) << outcome.err;
    }
  told("place @signal.h5 --quiet");  // it was written nevertheless
}

// Without replacements, the first file of the program takes the number of standard output or error.
TEST_F(Streams, ClosedStreamsDoNotOverwriteOutputs) {
  told("simulate @store.json -o @expected.h5 --samples 64 --quiet");
  EXPECT_EQ(redirected("<&- >&- 2>&-", "simulate @store.json -o @signal.h5 --samples 64").exit_code, 2);
  EXPECT_TRUE(bytes("signal.h5") == bytes("expected.h5"));
}

TEST_F(Streams, AClosedPipeEndsTheProgramQuietly) {
  const Outcome outcome = redirected("| true", "inspect @store.json");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

}  // namespace
}  // namespace shelfbeam
