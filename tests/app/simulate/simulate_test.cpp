#include <chrono>
#include <csignal>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include <boresight/app/simulate/drive_run.hpp>
#include <boresight/app/simulate/nonlinear_model.hpp>
#include <boresight/app/simulate/position_run.hpp>
#include <boresight/design/tuning/tuner.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/records/csv_table.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

io::Case reference_case() {
  return io::read_case(case_path("dss14-70m"));
}

TEST(CsvTable, IsWrittenAsARecorderWould) {
  io::CsvTable table;
  table.comments = {"a remark"};
  table.columns = {{"time", "s", 3, Eigen::Vector2d(0.0, 0.005)},
                   {"tach", "V", 1, Eigen::Vector2d(-1.25, 10.0)}};
  EXPECT_EQ(to_csv(table), "# a remark\ntime [s],tach [V]\n0.000,-1.2\n0.005,10.0\n");
  table.columns[1].values.resize(3);
  EXPECT_THROW(to_csv(table), InvalidInput);
}

TEST(NonlinearModel, SpreadsTheLinesOverTheMotors) {
  const auto model = make_nonlinear_antenna(reference_case());
  ASSERT_EQ(model.oil.lines.size(), 4U);
  EXPECT_DOUBLE_EQ(model.oil.lines.front().length, 13.11);
  EXPECT_DOUBLE_EQ(model.oil.lines.back().length, 15.60);
  EXPECT_NEAR(model.oil.lines[1].length, 13.94, 1e-9);
  // 2000 psi on four motors.
  EXPECT_NEAR(model.oil.supply_torque, 315.7, 0.1);
  EXPECT_NEAR(tachometer_scale(reference_case()), 2.2621, 1e-4);
}

TEST(NonlinearModel, ScalesATachometerOnAnyShaft) {
  io::Case antenna = reference_case();
  ASSERT_TRUE(antenna.campaign.tachometer);
  io::RecordedTachometerEntry& tachometer = *antenna.campaign.tachometer;
  const double volts = 20.0 * std::numbers::pi / 157.0;  // rad/s of the shaft, a volt
  tachometer.motor_teeth.reset();
  tachometer.tachometer_teeth.reset();
  tachometer.shaft = "motor";
  EXPECT_NEAR(tachometer_scale(antenna), volts, 1e-12);
  EXPECT_EQ(drive_tests(antenna, "slow-ramp").size(), 1U);
  tachometer.shaft = "antenna";
  EXPECT_NEAR(tachometer_scale(antenna) / volts, 28723.647, 1e-3);
}

TEST(DriveTests, NameWhatARecordNeedsBeforeAnythingRuns) {
  const auto refusal = [](const auto& change, const std::string& test) -> std::string {
    io::Case antenna = reference_case();
    change(antenna);
    try {
      drive_tests(antenna, test);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "taken";
  };
  const auto lines = [](io::Case& antenna) { antenna.campaign.lines.clear(); };
  const auto table = [](io::Case& antenna) { antenna.campaign.tachometer.reset(); };
  const auto volts = [](io::Case& antenna) { antenna.campaign.tachometer->voltage.reset(); };
  const auto limit = [](io::Case& antenna) { antenna.campaign.tachometer->recorder_limit.reset(); };
  EXPECT_THAT(refusal(lines, "slosh"), HasSubstr("expected an [[oil.line]] with its length"));
  EXPECT_THAT(refusal(table, "slosh"), HasSubstr("expected a table [tachometer]"));
  EXPECT_THAT(refusal(volts, "slow-ramp"), HasSubstr("expected tachometer.voltage"));
  EXPECT_THAT(refusal(limit, "slow-ramp"), HasSubstr("expected tachometer.recorder_limit"));
  for (const auto* test : {"tracking", "slew"}) {
    EXPECT_EQ(refusal(lines, test), "taken");
    EXPECT_EQ(refusal(table, test), "taken");
  }
}

TEST(DriveTests, CommandsAreThoseOfThePaper) {
  const io::Case antenna = reference_case();
  const auto fast = drive_tests(antenna, "fast-ramp").front();
  const double limit = 10.0 * tachometer_scale(antenna);
  EXPECT_FALSE(fast.rate_loop_closed);
  EXPECT_NEAR(fast.command.maxCoeff(), 1.5 * limit, 1e-9);
  EXPECT_NEAR(fast.command.minCoeff(), -1.5 * limit, 1e-9);
  EXPECT_NEAR(fast.command.sum(), 0.0, 1e-6);
  EXPECT_EQ(drive_tests(antenna, "constant-speed").size(), 6U);
  for (const auto& name : simulated_test_names()) {
    for (const auto& test : drive_tests(antenna, name)) {
      EXPECT_TRUE(test.command.allFinite()) << name;
      EXPECT_LE(test.command.cwiseAbs().maxCoeff(), 150.0) << name;
    }
  }
}

TEST(DriveRun, FastRampLeavesTheRecordersRange) {
  const io::Case antenna = reference_case();
  auto test = drive_tests(antenna, "fast-ramp").front();
  test.command.conservativeResize(test.command.size() / 4);  // one period and some
  const auto run = run_drive_test(antenna, test, 1, {});
  const auto& columns = run.record.columns;
  ASSERT_EQ(columns.size(), 12U);
  EXPECT_EQ(columns[9].name, "tach");
  EXPECT_GT(run.at_limit, 0.02);
  EXPECT_NEAR(columns[9].values.maxCoeff(), 10.0, 5e-3);
  EXPECT_NEAR(columns[9].values.minCoeff(), -10.0, 5e-3);
  EXPECT_GT(run.largest_rate, 10.0 * tachometer_scale(antenna));
  EXPECT_GT(run.largest_torque, 69.49);  // the friction at speed
  EXPECT_LT(run.largest_torque, 316.0);
  for (std::size_t i = 1; i < 9; ++i) {
    EXPECT_GT(columns[i].values.minCoeff(), 0.0) << columns[i].name;
    EXPECT_LT(columns[i].values.maxCoeff(), 2000 * 6894.757e-6) << columns[i].name;
  }
}

TEST(DriveRun, SlowMotionBreaksAwayAtTheStaticFriction) {
  const io::Case antenna = reference_case();
  auto test = drive_tests(antenna, "slow-ramp").front();
  // The first quarter of a period: at rest, breakaway, sliding upwards.
  test.command.conservativeResize(static_cast<Eigen::Index>(12.0 / test.sample_time));
  const auto run = run_drive_test(antenna, test, 1, {});
  // Between the Coulomb level and the breakaway's with what bends the bristles faster.
  EXPECT_GT(run.static_friction, 10.33);
  EXPECT_LT(run.static_friction, 1.2 * 16.83);
  EXPECT_GT(run.largest_rate, 0.2);
}

TEST(DriveRun, EndsWhereItIsToldAndSaysSo) {
  const io::Case antenna = reference_case();
  const auto test = drive_tests(antenna, "slosh").front();
  const auto run = run_drive_test(antenna, test, 1, [](double done) { return done < 0.3; });
  EXPECT_FALSE(run.complete);
  ASSERT_EQ(run.record.comments.size(), 1U);
  EXPECT_THAT(run.record.comments.front(), StartsWith("incomplete: interrupted after"));
  const auto samples = run.record.columns.front().values.size();
  EXPECT_LT(samples, test.command.size());
  EXPECT_GT(samples, test.command.size() / 4);
}

TEST(PositionRun, RunsOnTheControllerItIsGiven) {
  const io::Case antenna = reference_case();
  const auto structure = io::loop_structure(antenna, "PI");
  SimulatedController given{
      design::tune(make_problem(antenna), structure, make_goals(antenna), {}).law, "of a report"};
  const auto same = run_slew(antenna, given, 1, {});
  EXPECT_THAT(same.description, HasSubstr("by PI with lag, of a report"));
  // Other gains move it otherwise.
  const auto& gains = control::gain_descriptions(structure);
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (gains[i].name == "position gain") given.law.gains[i] *= 0.5;
  }
  const auto slower = run_slew(antenna, given, 1, {});
  EXPECT_NE(slower.record.columns[2].values, same.record.columns[2].values);
}

TEST(SimulateCommand, NamesTheGainsThatAreNotThere) {
  const ScratchFolder folder;
  const auto none = run_program({"simulate", case_path("dss14-70m"), "slew", "--gains", "case",
                                 "--folder", folder.file("a")});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.errors, HasSubstr("--gains case: expected [gains] in the case, found none"));
}

TEST(SimulateCommand, WritesTheRecordAndRepeatsIt) {
  const ScratchFolder folder;
  const std::string path = case_path("dss14-70m");
  const auto run = run_program({"simulate", path, "slosh", "--folder", folder.file("a")});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("slosh"));
  EXPECT_THAT(run.output, HasSubstr("bristle_stiffness"));  // among the assumptions
  const std::string record = content_of(folder.file("a/slosh.csv"));
  EXPECT_THAT(record, StartsWith("time [s],p1_in [MPa],p1_out [MPa],p2_in [MPa],p2_out [MPa],"
                                 "p3_in [MPa],p3_out [MPa],p4_in [MPa],p4_out [MPa],tach [V],"
                                 "rate_command [V],valve_command [V]\n0.0000,"));
  EXPECT_EQ(std::ranges::count(record, '\n'), 10002);
  run_program({"simulate", path, "slosh", "--folder", folder.file("b")});
  EXPECT_EQ(content_of(folder.file("b/slosh.csv")), record);
  run_program({"simulate", path, "slosh", "--folder", folder.file("c"), "--seed", "2"});
  EXPECT_NE(content_of(folder.file("c/slosh.csv")), record);
}

TEST(SimulateCommand, RefusesWhatItCannotRun) {
  const ScratchFolder folder;
  const std::string path = case_path("dss14-70m");
  const auto unknown = run_program({"simulate", path, "slosch", "--folder", folder.file("a")});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("found 'slosch'"));
  const auto twice =
      run_program({"simulate", path, "slosh", "slosh", "--folder", folder.file("a")});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_THAT(twice.errors, HasSubstr("each test once"));
  const auto bare =
      run_program({"simulate", case_path("dss14-64m"), "slosh", "--folder", folder.file("a")});
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_THAT(bare.errors, HasSubstr("[simulation]"));
  const auto nowhere =
      run_program({"simulate", path, "slosh", "--folder", folder.write("file", "") + "/inside"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.errors, HasSubstr("expected a folder"));
}

TEST(SimulateCommand, InterruptLeavesAMarkedRecord) {
  const ScratchFolder folder;
  ProgramRun run({"simulate", case_path("dss14-70m"), "slow-ramp", "fast-ramp", "slosh", "--folder",
                  folder.file("records")});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  run.signal(SIGINT);
  const auto result = run.wait();
  // -1: the signal came before the program listened, 0: after its work.
  EXPECT_THAT(result.exit_code, testing::AnyOf(-1, 0, 130));
  if (result.exit_code != 130) return;
  EXPECT_THAT(result.output, HasSubstr("Interrupted"));
  // It came during a test, whose record says so, or before one, which the report names.
  bool marked = false;
  std::string left_out;
  for (const std::string name : {"slow-ramp", "fast-ramp", "slosh"}) {
    const std::string record = content_of(folder.file("records/" + name + ".csv"));
    if (record.starts_with("# incomplete: interrupted after")) marked = true;
    if (record.empty()) left_out += (left_out.empty() ? "Not run: " : ", ") + name;
    EXPECT_TRUE(record.empty() || record.ends_with('\n'));
  }
  EXPECT_TRUE(marked || !left_out.empty());
  EXPECT_THAT(result.output, HasSubstr(left_out));
}

}  // namespace
}  // namespace boresight::app
