#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::vector<std::string> every_command{"redesign", "audit", "identify",
                                             "model",    "tune",  "match"};

TEST(CommandLine, HelpNamesEveryCommandAndExitCode) {
  const ProgramResult help = run_program({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.errors, "");
  for (const auto& command : every_command) EXPECT_THAT(help.output, HasSubstr("\n  " + command));
  for (const auto* code : {"0 done", "1 internal", "2 bad input", "3 constraints infeasible",
                           "4 numerical", "130 interrupted"}) {
    EXPECT_THAT(help.output, HasSubstr(code));
  }
}

TEST(CommandLine, HelpOfACommandNamesItsOptions) {
  for (const auto& command : every_command) {
    const ProgramResult help = run_program({command, "--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const auto* option : {"CASE", "--json", "--seed", "--threads"}) {
      EXPECT_THAT(help.output, HasSubstr(option));
    }
  }
}

TEST(CommandLine, TellsItsVersion) {
  const ProgramResult version = run_program({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.output, "boresight " BORESIGHT_VERSION "\n");
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  const std::string path = case_path("dss14-70m");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"desing", path},
                                                    {"model"},
                                                    {"model", path, "another.toml"},
                                                    {"model", path, "--jsn", "report.json"},
                                                    {"model", path, "--json"},
                                                    {"model", path, "--seed", "first"},
                                                    {"model", path, "--seed", "1.5"},
                                                    {"model", path, "--threads", "-2"},
                                                    {"model", "audit", path}}) {
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_EQ(result.output, "") << testing::PrintToString(arguments);
    EXPECT_NE(result.errors, "") << testing::PrintToString(arguments);
  }
}

TEST(CommandLine, PrintsNothingButTheReport) {
  const ProgramResult model = run_program({"model", case_path("dss14-70m")});
  EXPECT_EQ(model.exit_code, 0);
  EXPECT_EQ(model.errors, "");
  EXPECT_THAT(model.output, StartsWith("Boresight " BORESIGHT_VERSION " model: DSS-14"));
  EXPECT_EQ(model.output.find('\033'), std::string::npos);
}

TEST(CommandLine, WritesJsonBesideTheText) {
  const ScratchFolder folder;
  const std::string json = folder.file("report.json");
  const ProgramResult plain = run_program({"model", case_path("dss14-70m")});
  const ProgramResult both = run_program({"model", case_path("dss14-70m"), "--json", json});
  EXPECT_EQ(both.exit_code, 0);
  EXPECT_EQ(both.output, plain.output);
  EXPECT_THAT(content_of(json), StartsWith("{"));
  EXPECT_EQ(folder.entries(), 1U) << "a temporary was left behind";
}

TEST(CommandLine, ReplacesAnOlderReportWhole) {
  const ScratchFolder folder;
  const std::string json = folder.write("report.json", std::string(1000000, 'o'));
  EXPECT_EQ(run_program({"model", case_path("dss14-70m"), "--json", json}).exit_code, 0);
  EXPECT_THAT(content_of(json), Not(HasSubstr("ooo")));
}

TEST(CommandLine, LeavesNothingHalfWritten) {
  const ScratchFolder folder;
  const std::string json = folder.file("none/report.json");
  const ProgramResult result = run_program({"model", case_path("dss14-70m"), "--json", json});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.errors, HasSubstr(json + ": expected a place to write to"));
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(CommandLine, DoesNotReplaceAFolder) {
  const ScratchFolder folder;
  const std::string json = folder.file("report.json");
  std::filesystem::create_directory(json);
  EXPECT_EQ(run_program({"model", case_path("dss14-70m"), "--json", json}).exit_code, 2);
  EXPECT_TRUE(std::filesystem::is_directory(json));
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(CommandLine, ListsEveryAssumedInput) {
  for (const std::string antenna : {"dss14-70m", "dss14-64m"}) {
    const ProgramResult model = run_program({"model", case_path(antenna), "--details"});
    const std::string list = model.output.substr(model.output.find("Assumed inputs"));
    std::size_t assumed = 0;
    for (const auto& quantity : io::read_case(case_path(antenna)).quantities) {
      // Only simulated tests rest on these, and their report lists them.
      if (quantity.key.starts_with("simulation.") || quantity.key.starts_with("recorder."))
        continue;
      const bool counts = quantity.basis == io::Basis::assumed ||
                          quantity.uncertainty_source.starts_with("assumed");
      EXPECT_EQ(list.find("  " + quantity.key + " ") != std::string::npos, counts) << quantity.key;
      assumed += counts ? 1 : 0;
    }
    EXPECT_GT(assumed, 50U);
  }
}

// Whether the signal comes before, during or after the work, what is printed is whole.
TEST(CommandLine, StopsOnRequestWithWhatIsWhole) {
  using namespace std::chrono_literals;
  for (const auto delay : {0ms, 50ms, 500ms}) {
    const ScratchFolder folder;
    const std::string json = folder.file("report.json");
    const ProgramRun run({"redesign", case_path("dss14-70m"), "--json", json, "--threads", "1"});
    std::this_thread::sleep_for(delay);
    run.signal(SIGINT);
    const ProgramResult result = run.wait();
    EXPECT_THAT(result.exit_code, testing::AnyOf(-1, 0, 130));
    EXPECT_EQ(result.errors, "");
    const bool written = std::filesystem::exists(json);
    EXPECT_EQ(written, result.exit_code >= 0);
    if (result.exit_code == 130) {
      EXPECT_THAT(result.output, HasSubstr("INTERRUPTED"));
      EXPECT_THAT(content_of(json), HasSubstr("\"interrupted\": true"));
      EXPECT_THAT(content_of(json), testing::EndsWith("}\n"));
    }
    EXPECT_EQ(folder.entries(), written ? 1U : 0U);
  }
}

}  // namespace
}  // namespace boresight::app
