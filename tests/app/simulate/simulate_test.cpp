#include <array>
#include <chrono>
#include <csignal>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include "lag_loops.hpp"
#include <boresight/app/simulate/simulated_tests.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/io/case/case_friction.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

io::Case reference_case() {
  return io::read_case(case_path("dss14-70m"));
}

TEST(SimulatedTests, SayWhichControllerMovedTheAntenna) {
  const io::Case antenna = reference_case();
  const control::Controller controller{control::LoopStructure::named("PI"),
                                       {0.15, 0.4, 2.6, 8.0, 0.15}};
  const auto section =
      section_of(run_position_test(antenna, "slew", controller, 1, {}), antenna, "of a report");
  EXPECT_THAT(section.description, AllOf(StartsWith("1 deg by PI with lag, of a report at up to "),
                                         HasSubstr("deg/s and ")));
}

TEST(SimulatedTests, SayWhatSlewingAsksOfADriveThatHasLess) {
  design::PositionTestRecord record;
  record.controller.structure = control::LoopStructure::named("PI");
  record.slew =
      design::SlewCourse{degree, 0.16 * degree, 0.1 * degree, 0.25 * degree, 0.2 * degree};
  EXPECT_THAT(section_of(record, reference_case(), "tuned").description,
              HasSubstr("; the case's slew rate of 0.25 deg/s is out of reach: against this "
                        "friction the supply sustains at most 0.2 deg/s"));
}

TEST(SimulatedTests, SayWhatWasDoneToTheDrive) {
  design::DriveTestRecord record;
  record.kind = design::DriveTestKind::constant_speed;
  record.tachometer_volts = 0.5;
  EXPECT_EQ(section_of(record).description,
            "square wave of +-0.5 V of tachometer into the rate loop");
}

TEST(SimulatedTests, NameTheCaseWhoseSupplyCannotMoveTheAntenna) {
  io::Case antenna = reference_case();
  antenna.friction_curve->coulomb.value = 400.0;
  antenna.friction_curve->breakaway.value = 400.0;
  const control::Controller controller{control::LoopStructure::named("PI"),
                                       {0.15, 0.4, 2.6, 8.0, 0.15}};
  try {
    run_position_test(antenna, "slew", controller, 1, {});
    ADD_FAILURE() << "it slews";
  } catch (const InfeasibleRequirement& error) {
    EXPECT_THAT(error.what(), StartsWith(antenna.path + ": the supply cannot slew this antenna"));
  }
  antenna.simulation.reset();
  EXPECT_THROW(run_position_test(antenna, "tracking", controller, 1, {}), InvalidInput);
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
  const auto run =
      run_program({"simulate", path, "slosh", "--details", "--folder", folder.file("a")});
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

// A controller of other tools, which a file states.
TEST(SimulateCommand, RunsAStateSpaceOfAFile) {
  const ScratchFolder folder;
  const control::Controller loops = reference::lag_loops();
  io::write_controller(folder.file("mine.mat"), control::to_state_space(loops));
  const std::string path = case_path("dss14-70m");
  const auto run = run_program({"simulate", path, "slew", "--controller", folder.file("mine.mat"),
                                "--details", "--folder", folder.file("a")});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  // The lines are wrapped where the path's length has it.
  std::string words = std::regex_replace(run.output, std::regex("\\s+"), " ");
  EXPECT_THAT(words, AllOf(HasSubstr("by state space, order 2, "),
                           HasSubstr("sampled every 0.02 s by Tustin's method")));
  const auto nothing =
      run_program({"simulate", path, "slew", "--part", "mine", "--folder", folder.file("c")});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("--part: expected --controller"));
  const auto both = run_program({"simulate", path, "slew", "--controller", folder.file("mine.mat"),
                                 "--gains", "case", "--folder", folder.file("b")});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.errors, HasSubstr("expected either --controller or --gains"));

  // Without names in its file it takes them from the command line.
  auto bare = nlohmann::json::parse(io::controller_json(control::to_state_space(loops)));
  std::array<std::string, 2> names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string signals = i == 0 ? "inputs" : "outputs";
    for (const std::string name : bare.at(signals)) names.at(i) += name + ",";
    bare.erase(signals);
  }
  std::vector<std::string> words_of_bare{"simulate",
                                         path,
                                         "slew",
                                         "--controller",
                                         folder.write("bare.json", bare.dump()),
                                         "--folder",
                                         folder.file("d")};
  const auto unnamed = run_program(words_of_bare);
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_THAT(unnamed.errors, HasSubstr("in the file or by --inputs, found none"));
  for (const std::string& word :
       {std::string("--inputs"), names[0], std::string("--outputs"), names[1]})
    words_of_bare.push_back(word);
  EXPECT_EQ(run_program(words_of_bare).exit_code, 0);
  EXPECT_EQ(content_of(folder.file("d/slew.csv")), content_of(folder.file("a/slew.csv")));

  plant::StateSpace loud = control::to_state_space(loops);
  loud.c *= 50.0;
  loud.d *= 50.0;
  io::write_controller(folder.file("loud.json"), loud);
  const auto unstable = run_program({"montecarlo", path, "--controller", folder.file("loud.json")});
  EXPECT_EQ(unstable.exit_code, 3);
  EXPECT_THAT(unstable.errors, HasSubstr("unstable on the nominal antenna; it is stable with its "
                                         "output times 0."));
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
