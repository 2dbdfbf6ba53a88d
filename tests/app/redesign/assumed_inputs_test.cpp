// Which assumed inputs a report lists: those that its numbers rest on, and no others.
#include <algorithm>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include "scratch_folder.hpp"
#include <boresight/app/commands/simulate_command.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/tested_drive_of.hpp>

namespace boresight::app {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

using Keys = std::set<std::string>;

// Of [simulation] and [recorder] only.
Keys listed(const std::vector<io::Quantity>& quantities) {
  Keys keys;
  for (const auto& quantity : quantities) {
    if (quantity.key.starts_with("simulation.") || quantity.key.starts_with("recorder.")) {
      keys.insert(quantity.key);
    }
  }
  return keys;
}

io::Case edited(const ScratchFolder& folder, const EditedCase& text) {
  return io::read_case(folder.write("case.toml", text.text()));
}

io::Case reference() {
  return io::read_case(case_path("dss14-70m"));
}

TEST(AssumedInputs, OfTheLinearPlantNameNothingSimulated) {
  const auto assumed = assumed_inputs(reference());
  EXPECT_THAT(listed(assumed), IsEmpty());
  EXPECT_GT(assumed.size(), 40U);
}

TEST(AssumedInputs, OfRunsInTimeAreAllOfTheSimulationThatTheyUse) {
  const auto keys = listed(assumed_inputs(reference(), {.time_runs = true}));
  // All that the case assumes of [simulation], offset_torque being inferred.
  EXPECT_THAT(keys,
              UnorderedElementsAre("simulation.return_pressure", "simulation.null_leakage_share",
                                   "simulation.case_leakage_share", "simulation.valve_stroke",
                                   "simulation.valve_stroke_time", "simulation.valve_overlap",
                                   "simulation.bristle_stiffness", "simulation.bristle_damping",
                                   "simulation.line_damping_ratio", "simulation.makeup_pressure",
                                   "simulation.air_fraction", "simulation.preload_torque",
                                   "simulation.backlash"));
}

TEST(AssumedInputs, NameNoPreloadWhereGearsHaveNoBacklash) {
  const ScratchFolder folder;
  EditedCase text;
  text.replace("backlash = { value = \"0.1 rad\"", "# backlash = { value = \"0.1 rad\"");
  EXPECT_THAT(listed(assumed_inputs(edited(folder, text), {.time_runs = true})),
              Not(Contains("simulation.preload_torque")));
}

// What achievable_limits says moves with each key of steady motion at hand, and with no other.
TEST(AssumedInputs, OfSteadyMotionAreThoseThatMoveWhatTheDriveCanDo) {
  const auto keys = listed(assumed_inputs(reference(), {.steady_motion = true}));
  const auto reach = [](const io::Case& antenna) {
    const auto limits =
        design::achievable_limits(make_nonlinear_antenna(antenna), 1.8, {80.0, 100.0});
    return std::pair(limits.rate, limits.acceleration);
  };
  const auto as_it_is = reach(reference());
  const ScratchFolder folder;
  const auto moves = [&](const std::string& old, const std::string& replacement) {
    return reach(edited(folder, EditedCase().replace(old, replacement))) != as_it_is;
  };
  EXPECT_TRUE(moves("valve_stroke = { value = \"150", "valve_stroke = { value = \"160"));
  EXPECT_TRUE(moves("valve_overlap = { value = \"0\"", "valve_overlap = { value = \"0.1\""));
  EXPECT_THAT(keys, IsSupersetOf({"simulation.valve_stroke", "simulation.valve_overlap",
                                  "simulation.return_pressure"}));
  EXPECT_FALSE(moves("backlash = { value = \"0.1", "backlash = { value = \"0.2"));
  EXPECT_FALSE(
      moves("bristle_stiffness = { value = \"2500", "bristle_stiffness = { value = \"3500"));
  EXPECT_FALSE(moves("bristle_damping = { value = \"5 ", "bristle_damping = { value = \"7 "));
  EXPECT_FALSE(
      moves("line_damping_ratio = { value = \"0.01", "line_damping_ratio = { value = \"0.02"));
  EXPECT_FALSE(
      moves("valve_stroke_time = { value = \"0.05", "valve_stroke_time = { value = \"0.06"));
  EXPECT_FALSE(moves("air_fraction = { value = \"0\"", "air_fraction = { value = \"0.001\""));
  for (const char* key : {"air_fraction", "backlash", "preload_torque", "bristle_stiffness",
                          "bristle_damping", "line_damping_ratio", "valve_stroke_time"}) {
    EXPECT_THAT(keys, Not(Contains(std::string("simulation.") + key)));
  }
}

TEST(AssumedInputs, OfGoalsOnGustsNameTheStroke) {
  const ScratchFolder folder;
  EXPECT_THAT(listed(assumed_inputs(reference(), {.valve_stroke = true})),
              UnorderedElementsAre("simulation.valve_stroke"));
  EditedCase text;
  text.replace("[goals]\n", "[goals]\ncrest_factor = \"3\"\n");
  EXPECT_THAT(listed(assumed_inputs(edited(folder, text))),
              UnorderedElementsAre("simulation.valve_stroke"));
}

TEST(AssumedInputs, OfSimulatedTestsFollowTheTests) {
  const ScratchFolder folder;
  const auto of = [&](std::vector<std::string> tests) {
    SimulateArguments arguments;
    arguments.case_path = case_path("dss14-70m");
    arguments.folder = folder.file("records");
    arguments.tests = std::move(tests);
    return listed(simulate_tests(arguments, [] { return true; }).report.assumed);
  };
  const auto loops = listed(assumed_inputs(reference(), {.time_runs = true}));
  EXPECT_EQ(of({"tracking"}), loops);
  const auto slosh = of({"slosh"});
  EXPECT_THAT(slosh, Contains("recorder.pressure_noise"));
  EXPECT_THAT(slosh, Not(Contains(StartsWith("simulation.rate_loop"))));
  const auto ramp = of({"slow-ramp", "tracking"});
  EXPECT_THAT(ramp, IsSupersetOf(slosh));
  EXPECT_THAT(ramp, Contains("simulation.rate_loop_gain"));
  EXPECT_THAT(ramp, IsSupersetOf(loops));
}

TEST(AssumedInputs, NameSignalsOfTheComputerOnlyWhereTheyAreUsed) {
  const ScratchFolder folder;
  EditedCase text;
  text.replace("[controller]\n",
               "[computer]\nvalve_voltage = { value = \"10 V\", basis = \"assumed\" }\n"
               "[controller]\n");
  const auto antenna = edited(folder, text);
  const auto names_it = [](const std::vector<io::Quantity>& assumed) {
    return std::ranges::count(assumed, "computer.valve_voltage", &io::Quantity::key);
  };
  EXPECT_EQ(names_it(assumed_inputs(antenna)), 0);
  EXPECT_EQ(names_it(assumed_inputs(antenna, {.computer = true})), 1);
}

TEST(AssumedInputs, OfRecordsNameWhatStandsInForInstruments) {
  io::Case antenna = reference();
  antenna.campaign->records.emplace_back();
  EXPECT_THAT(listed(assumed_inputs(antenna)),
              UnorderedElementsAre("simulation.return_pressure", "recorder.pressure_gain",
                                   "recorder.pressure_zero", "recorder.tachometer_gain"));
}

}  // namespace
}  // namespace boresight::app
