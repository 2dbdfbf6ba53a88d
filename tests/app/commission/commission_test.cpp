#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include <boresight/app/commission/commission_study.hpp>
#include <boresight/io/case/antenna_of.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> pressure_gains{
    "kr=1.2",       "wi=2 rad/s", "wp=300 rad/s", "kT=0.2 rad/(s.N.m)",
    "wd=5.5 rad/s", "kp=0.8 1/s", "wip=0.2 rad/s"};

// With a small ensemble, so that a plan takes a moment.
std::string small_case(const ScratchFolder& folder, const std::string& more = "") {
  return folder.write("case.toml", EditedCase().text() + "\n[ensemble]\ndraws = 1\n" + more);
}

ProgramResult commission(const std::string& path, const std::vector<std::string>& gains,
                         const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"commission", path, "--details", "--threads", "1"};
  if (!gains.empty()) arguments.emplace_back("--gains");
  arguments.insert(arguments.end(), gains.begin(), gains.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

TEST(Commission, PlansFromTheCasesGainsInTheCasesUnits) {
  const ScratchFolder folder;
  const std::string path =
      small_case(folder,
                 "[gains]\nstructure = 'DPF'\nkr = 0.3\nwi = '0.25 Hz'\nwp = '48 Hz'\nkT = '0.1 "
                 "rad/(s.N.m)'\nwd = '0.9 Hz'\nkp = '0.1 1/s'\nwip = '0.02 rad/s'\n");
  const ProgramResult result = commission(path, pressure_gains, {"--json", folder.file("plan")});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("1  as found"));
  EXPECT_THAT(result.output, Not(HasSubstr("ASSUMED start")));
  EXPECT_THAT(result.output, HasSubstr("wi = 0.25 Hz"));
  EXPECT_THAT(result.output, HasSubstr("kr = 1.2"));
  EXPECT_THAT(result.output, ContainsRegex("mdeg as found, .* mdeg at the end"));
  EXPECT_THAT(result.output,
              HasSubstr("Open the position loop, set the gains of the stage before"));
  EXPECT_THAT(result.output, ContainsRegex("stage +gains to set\n +1 +kr = 0.3; wi = 0.25 Hz"));
  EXPECT_THAT(result.output, HasSubstr("coherence"));
  EXPECT_THAT(content_of(folder.file("plan")), HasSubstr("\"assumed_detuning_1\": null"));
  // The same again, bytes and all, for two threads.
  const auto again = run_program({"commission", path, "--details", "--threads", "2", "--gains",
                                  "kr=1.2", "wi=2 rad/s", "wp=300 rad/s", "kT=0.2 rad/(s.N.m)",
                                  "wd=5.5 rad/s", "kp=0.8 1/s", "wip=0.2 rad/s"});
  EXPECT_EQ(again.output, result.output);
  // On a terminal each stage is a line of two tables.
  const auto brief =
      run_program({"commission", path, "--gains", "kr=1.2", "wi=2 rad/s", "wp=300 rad/s",
                   "kT=0.2 rad/(s.N.m)", "wd=5.5 rad/s", "kp=0.8 1/s", "wip=0.2 rad/s"});
  EXPECT_LE(std::ranges::count(brief.output, '\n'), 3 + 16 + 60);
  EXPECT_THAT(brief.output, Not(HasSubstr("Brakes on")));
}

TEST(Commission, SaysWhatItAssumesWhereNoGainsAreKnown) {
  const ScratchFolder folder;
  const ProgramResult result = commission(small_case(folder), pressure_gains);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("ASSUMED start"));
  EXPECT_THAT(result.output, Not(HasSubstr("as found  ")));
  EXPECT_THAT(result.output, HasSubstr("rate loop, 1 of"));
}

TEST(Commission, SaysThatGainsOnWhichTheAntennaRunsCannotBeUnstable) {
  const ScratchFolder folder;
  const std::string path = small_case(
      folder,
      "[gains]\nstructure = 'PI-0'\nkr = 6\nwi = '4 rad/s'\nkp = '2 1/s'\nwip = '0.1 rad/s'\n");
  const ProgramResult result = commission(path, pressure_gains);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("plants are unstable, but the antenna runs on them"));
  EXPECT_THAT(result.output, HasSubstr("no path was found from the gains as found"));
  EXPECT_THAT(result.output, Not(HasSubstr("nan ")));
  EXPECT_THAT(result.output, HasSubstr("Brakes on; nothing has been changed yet."));
  EXPECT_THAT(result.output,
              HasSubstr("Restore the gains as found only if the antenna did run on them."));
}

TEST(Commission, TunesWhereNoGainsAreGiven) {
  const ScratchFolder folder;
  const ProgramResult result =
      commission(small_case(folder), {}, {"--structure", "PI", "--starts", "3", "--details"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_THAT(result.output, HasSubstr("Final gains: from robust tuning."));
  EXPECT_THAT(result.output, Not(HasSubstr("pressure feedback, 1")));
}

// Friction that breaks away at more than twice what slides by limit-cycles; that of the case does
// not.
TEST(Commission, SaysThatAControllerLimitCyclesOnTheNonlinearAntenna) {
  const ScratchFolder folder;
  const std::vector<std::string> gains{"kr=0.043", "wi=0.3 rad/s", "wp=2.5 rad/s", "kp=30 1/s",
                                       "wip=0.2 rad/s"};
  const std::vector<std::string> structure{"--structure", "PI"};
  const ProgramResult still = commission(small_case(folder), gains, structure);
  EXPECT_EQ(still.exit_code, 0) << still.errors;
  EXPECT_THAT(still.output, Not(HasSubstr("On the nonlinear antenna")));
  const std::string sticky = folder.write(
      "sticky.toml",
      EditedCase()
              .replace("breakaway = { value = \"16.83 N.m\"", "breakaway = { value = \"55 N.m\"")
              .text() +
          "\n[ensemble]\ndraws = 1\n");
  const ProgramResult limit_cycles = commission(sticky, gains, structure);
  EXPECT_EQ(limit_cycles.exit_code, 0) << limit_cycles.errors;
  EXPECT_THAT(limit_cycles.output,
              ContainsRegex("On the nonlinear antenna PI has a limit cycle of \\+-[1-9]"));
}

nlohmann::json plan_of(const std::string& path, const std::vector<std::string>& more) {
  auto arguments = more;
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProgramResult result = commission(path, pressure_gains, arguments);
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return nlohmann::json::parse(result.output);
}

TEST(Commission, WritesSheetsBodePlotsAndTheControllerOfEveryStage) {
  const ScratchFolder folder;
  const std::string path = small_case(folder);
  const auto plan = plan_of(path, {"--folder", folder.file("plan")});
  const auto& stages = plan.at("stages");
  std::size_t checks = 0;
  for (const auto& stage : stages) checks += stage.at("checks").size();
  const std::string sheets = content_of(folder.file("plan/sheets.csv"));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(sheets, '\n')), checks + 1);
  // The valve's signal in percent of its stroke, the tachometer in volts.
  EXPECT_THAT(sheets, HasSubstr("\"valve command, still air\",% rms,"));
  EXPECT_THAT(sheets, HasSubstr("\"tachometer, still air\",V rms,"));
  const std::string page = content_of(folder.file("plan/sheets.html"));
  EXPECT_THAT(page, HasSubstr("measured"));
  EXPECT_THAT(page, HasSubstr("initials"));
  EXPECT_THAT(page, HasSubstr(fmt::format("Stage {0} of {0}: feedforward", stages.size())));
  for (std::size_t i = 1; i <= stages.size(); ++i) {
    EXPECT_THAT(content_of(folder.file(fmt::format("plan/commission-bode-{}.csv", i))),
                HasSubstr("gain"));
  }
  // The last stage's file is the controller, to the last bit.
  const std::string last = folder.file(fmt::format("plan/stage_{:02}_gains.toml", stages.size()));
  const ProgramResult again =
      run_program({"commission", path, "--gains", last, "--json", "-", "--threads", "1"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(nlohmann::json::parse(again.output).at("stages").back().at("gains"),
            stages.back().at("gains"));
}

TEST(Commission, TriesFreshPlantsAndWrongAntennas) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("case.toml", EditedCase().text() + "\n[ensemble]\ndraws = 12\n");
  const auto plan = plan_of(path, {"--plants", "20"});
  const auto& stages = plan.at("trials").at("stages");
  ASSERT_EQ(stages.size(), plan.at("stages").size());
  EXPECT_EQ(plan.at("trials").at("stable"), 20);
  for (const auto& trial : stages) {
    EXPECT_EQ(trial.at("plants"), 20);
    EXPECT_EQ(trial.at("stable"), 20);
    // The brackets are of twelve members, so that a few of 20 plants leave one.
    EXPECT_GE(trial.at("passing"), 16) << trial;
  }
  const auto& faults = plan.at("faults");
  const auto sign = std::ranges::find_if(
      faults, [](const auto& one) { return one.at("fault") == "tachometer with the wrong sign"; });
  ASSERT_NE(sign, faults.end());
  EXPECT_EQ(sign->at("stage"), 1);
  EXPECT_EQ(sign->at("stable"), false);
  EXPECT_TRUE(sign->at("quantity").is_null());
}

// A first-order answer to a square wave: its rise from 10 to 90 % is ln 9 time constants.
std::string step_record(const ScratchFolder& folder, double rise_time) {
  const double lag = rise_time / std::log(9.0);
  const double half = 8.0 * rise_time;
  std::string text = "time [s],rate command [deg/s],motor rate [rad/s]\n";
  constexpr double gear = 28724.0;
  constexpr double size = 0.01;  // deg/s at the sky
  double rate = 0.0;
  for (int k = 0; k < static_cast<int>(4.0 * half / 0.1); ++k) {
    const double time = 0.1 * k;
    const double command = static_cast<int>(time / half) % 2 == 1 ? size : 0.0;
    rate += (command - rate) * (1.0 - std::exp(-0.1 / lag));
    text +=
        fmt::format("{:.1f},{:.4f},{:.9g}\n", time, command, rate * gear * 0.017453292519943295);
  }
  return folder.write("stage.csv", text);
}

TEST(Commission, EvaluatesTheRecordOfAStageAndUpdatesThePlants) {
  const ScratchFolder folder;
  const std::string path = small_case(folder);
  const auto plan = plan_of(path, {});
  double expected = 0.0;
  for (const auto& check : plan.at("stages").front().at("checks")) {
    if (check.at("quantity") == "rise time 10 to 90 %") expected = check.at("expected");
  }
  ASSERT_GT(expected, 0.0);
  const auto good = plan_of(path, {"--record", "1", step_record(folder, expected)});
  const auto& record = good.at("records").front();
  EXPECT_EQ(record.at("stage"), 1);
  ASSERT_FALSE(record.at("checks").empty());
  for (const auto& check : record.at("checks")) EXPECT_EQ(check.at("verdict"), "passes");
  EXPECT_NEAR(record.at("checks").front().at("measured"), expected, 0.02 * expected);
  EXPECT_EQ(good.at("update").at("explained"), true);
  EXPECT_THAT(good.at("conclusions").front(), HasSubstr("passes"));
  // A valve of half its gain halves the loop's speed.
  const auto wrong = plan_of(path, {"--record", "1", step_record(folder, 2.0 * expected)});
  EXPECT_EQ(wrong.at("update").at("explained"), false);
  EXPECT_THAT(wrong.at("conclusions").front(), HasSubstr("OUTSIDE"));
  ASSERT_FALSE(wrong.at("update").at("faults").empty());
  EXPECT_THAT(wrong.at("update").at("faults").front().at("fault"), HasSubstr("halved"));
  // A stage that the plan does not have, and a file that is none.
  const auto refusal = [&](const std::string& stage, const std::string& file) {
    const ProgramResult result = commission(path, pressure_gains, {"--record", stage, file});
    EXPECT_EQ(result.exit_code, 2);
    return result.errors;
  };
  EXPECT_THAT(refusal("99", step_record(folder, expected)),
              HasSubstr("expected a stage of the plan, 1 to"));
  EXPECT_THAT(refusal("0", step_record(folder, expected)), HasSubstr("from 1, found 0"));
  EXPECT_THAT(refusal("1", folder.file("none.csv")), HasSubstr("none.csv"));
}

TEST(Commission, RefusesWhatItCannotUse) {
  const ScratchFolder folder;
  const std::string path = small_case(folder);
  const auto refusal = [&](const std::vector<std::string>& gains,
                           const std::vector<std::string>& more = {}) {
    const ProgramResult result = commission(path, gains, more);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.output, "");
    return result.errors;
  };
  EXPECT_THAT(refusal({"kr=1.2"}), HasSubstr("expected a value for wi (rate integral corner)"));
  auto unknown = pressure_gains;
  unknown.emplace_back("kx=1");
  EXPECT_THAT(refusal(unknown), HasSubstr("with a key of kr, wi, wp, kT, wd, kp, wip, found none"));
  auto wrong = pressure_gains;
  wrong[1] = "wi=2 m";
  EXPECT_THAT(refusal(wrong), HasSubstr("--gains 'wi=2 m'"));
  EXPECT_THAT(refusal({}, {"--structure", "XY"}), HasSubstr("XY"));
  EXPECT_THAT(refusal(pressure_gains, {"--before", "one"}),
              HasSubstr("expected both --before and --after, or neither"));
  EXPECT_THAT(refusal(pressure_gains, {"--before", "one", "--after", "two"}),
              HasSubstr("expected [[record]]s to compare, found none"));
  // A controller that no plant can be run on is infeasible, not bad input.
  auto wild = pressure_gains;
  wild[0] = "kr=60";
  const ProgramResult result = commission(path, wild);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, HasSubstr("unstable on an ensemble member"));
}

// A plan that there is none of does not take the comparison with it.
TEST(Commission, ComparesTwoRecordsOfTheCaseWithoutAPlan) {
  const io::Case antenna = io::read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/campaign.toml");
  CommissionOptions options;
  options.gains = pressure_gains;
  options.gains[0] = "kr=60";
  options.before = "constant-speed-0.25V";
  options.after = "constant-speed-0.5V";
  const auto plant = make_plant(antenna);
  const design::Mission mission = mission_of(antenna);
  const io::DesignedAntenna designed{
      antenna,
      mission,
      {design::EnsembleSource::ranges, {{"one", plant}, {"another", plant}, {"a third", plant}}},
      design::PlantDistribution::of_ranges(mission),
      {},
      false};
  const auto report = plan_commission(designed, options);
  ASSERT_TRUE(report.failure);
  EXPECT_THROW(std::rethrow_exception(report.failure), InfeasibleRequirement);
  ASSERT_GE(report.comparisons.size(), 2U);
  for (const auto& channel : report.comparisons) EXPECT_FALSE(channel.predicted.has_value());
  const std::string text = to_text(report);
  EXPECT_THAT(text, HasSubstr("None: "));
  EXPECT_THAT(text, HasSubstr("Before and after: 'constant-speed-0.25V'"));
  EXPECT_THAT(text, HasSubstr("There is no plan for DPF: "));
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_TRUE(json.at("no_plan").is_string());
  EXPECT_TRUE(json.at("stages").empty());
  EXPECT_EQ(json.at("comparisons").size(), report.comparisons.size());
}

}  // namespace
}  // namespace boresight::app
