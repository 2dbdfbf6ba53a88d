// The command evaluate: what stands in its section, and how it ends.
#include <csignal>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program_run.hpp"
#include "io/edited_case.hpp"
#include <boresight/app/commands/evaluate_command.hpp>
#include <boresight/app/report/json_report.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/design/problem/pointing.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::app {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

std::string proposal_path(const std::string& name) {
  std::string path = BORESIGHT_SOURCE_DIR "/cases/dss14-70m/proposals/";
  path += name;
  return path + ".toml";
}

EvaluateArguments arguments_of(std::vector<std::string> proposals) {
  EvaluateArguments arguments;
  arguments.case_path = case_path("dss14-70m");
  arguments.proposals = std::move(proposals);
  arguments.structures = {"PI"};
  arguments.random_samples = 200;
  arguments.starts = 2;
  arguments.threads = 1;
  return arguments;
}

const Report& two_proposals() {
  static const Report report = evaluate_case(
      arguments_of({proposal_path("no-flywheels"), proposal_path("displacement-1.41")}), nullptr);
  return report;
}

std::string proposal_text(const std::string& name, const std::string& rest,
                          const std::string& currency = "kUSD") {
  return "name = '" + name + "'\ndescription = 'd'\n[cost]\namount = 1\ncurrency = '" + currency +
         "'\n" + rest;
}

TEST(Evaluate, ListsWhatSlewingRestsOn) {
  std::vector<std::string> keys;
  for (const auto& quantity : two_proposals().assumed) keys.push_back(quantity.key);
  EXPECT_THAT(keys, Contains("simulation.valve_stroke"));
  EXPECT_THAT(keys, Contains("simulation.bristle_stiffness"));
  EXPECT_THAT(keys, Not(Contains(StartsWith("recorder."))));
}

TEST(Evaluate, PutsTheAntennaAsItIsFirst) {
  const auto& section = *two_proposals().evaluated;
  ASSERT_EQ(section.candidates.size(), 3U);
  const auto& base = section.candidates[0];
  EXPECT_EQ(base.name, "as it is");
  EXPECT_EQ(base.cost, 0.0);
  EXPECT_THAT(base.changes, IsEmpty());
  for (const auto& candidate : section.candidates) {
    ASSERT_TRUE(candidate.chosen) << candidate.name;
    EXPECT_TRUE(candidate.feasible()) << candidate.name;
    EXPECT_TRUE(candidate.controllers[*candidate.chosen].design.verification.passed);
    EXPECT_EQ(candidate.controllers[*candidate.chosen].ensemble->members.size(), 30U);
  }
}

TEST(Evaluate, HoldsTheDriveToItsLimits) {
  const auto& section = *two_proposals().evaluated;
  const auto& base = *section.candidates[0].figures;
  const auto& larger = *section.candidates[2].figures;
  // Without load the valve lets the motors turn at 1.2 times the slew rate; against friction and
  // offset not, and a slew keeps a fifth of what is left.
  EXPECT_LT(*base.slew_rate_margin, 1.0);
  EXPECT_LT(*larger.slew_rate_margin, 1.0);
  EXPECT_GT(larger.supply_margin, base.supply_margin);
  ASSERT_TRUE(base.slew && base.slew->time);
  EXPECT_NEAR(base.slew->rate / base.slew->rate_asked, 0.8 * *base.slew_rate_margin, 1e-4);
  // Rest to rest takes at least the distance over the rate.
  EXPECT_GT(*base.slew->time, base.slew->distance / base.slew->rate);
  EXPECT_THAT(to_text(two_proposals()),
              HasSubstr("The drive as it is cannot reach the stated slew rate"));
}

TEST(Evaluate, ComparesOnTheSameSamples) {
  const auto& decision = *two_proposals().evaluated->decision;
  EXPECT_EQ(decision.random_samples, 200U);
  ASSERT_EQ(decision.statistics.options.size(), 3U);
  ASSERT_EQ(decision.statistics.pairs.size(), 3U);
  double best = 0.0;
  for (const auto& option : decision.statistics.options) {
    best += option.best.value;
    EXPECT_GE(option.expected_regret, 0.0);
  }
  EXPECT_NEAR(best, 1.0, 1e-9);
  // Both proposals stand above the antenna as it is on nearly every plant: paired, not apart.
  for (const auto& pair : decision.statistics.pairs) {
    if (pair.first == 0) {
      EXPECT_LT(pair.better.value, 0.2);
    }
  }
  ASSERT_TRUE(decision.tornado && decision.sobol && decision.tests);
  EXPECT_EQ(decision.inputs.size(), 6U);
  double first_order = 0.0;
  for (const auto& input : decision.sobol->outputs[0].inputs) {
    first_order += input.first_order.value;
  }
  EXPECT_LT(first_order, 1.1);
  EXPECT_GE(decision.tests->perfect.gain, 0.0);
  // Of those fit to be chosen, by the places of all.
  ASSERT_EQ(decision.tests->mean_loss.size(), 3U);
  EXPECT_EQ(decision.tests->choice, decision.best);
  EXPECT_EQ(decision.tests->mean_loss[decision.best],
            decision.statistics.options[decision.best].mean);
}

TEST(Evaluate, SamplesAgreeWithTheEnsemble) {
  // Both are over the same ranges, apart from the corners: their means are near.
  const auto& section = *two_proposals().evaluated;
  for (std::size_t i = 0; i < section.candidates.size(); ++i) {
    const auto& candidate = section.candidates[i];
    const double members =
        candidate.controllers[*candidate.chosen].compared_rms() * 180e3 / 3.14159265358979;
    EXPECT_NEAR(section.decision->statistics.options[i].mean, members, 0.06 * members)
        << candidate.name;
  }
}

TEST(Evaluate, ComparesOnTheNonlinearAntenna) {
  const auto& section = *two_proposals().evaluated;
  ASSERT_TRUE(section.time_domain);
  for (const auto& candidate : section.candidates) {
    const auto& controller = candidate.controllers[*candidate.chosen];
    ASSERT_TRUE(controller.time_domain) << candidate.name;
    const auto& wind = controller.time_domain->wind;
    ASSERT_EQ(wind.status, design::RunStatus::complete) << candidate.name;
    ASSERT_TRUE(controller.expected) << candidate.name;
    EXPECT_EQ(controller.expected->records, 10);
    EXPECT_DOUBLE_EQ(controller.simulated_to_linear_rms(),
                     controller.expected->rms.value / wind.predicted_rms);
    EXPECT_DOUBLE_EQ(
        controller.compared_rms(),
        std::hypot(controller.simulated_to_linear_rms() * controller.member_rms,
                   limit_cycle_amplitude(controller.time_domain->limit_cycles) / std::sqrt(2.0)));
    // Friction and backlash cost no PI loop twice of what wind does.
    EXPECT_GT(controller.simulated_to_linear_rms(), 0.9) << candidate.name;
    EXPECT_LT(controller.simulated_to_linear_rms(), 2.0) << candidate.name;
    EXPECT_EQ(controller.time_domain->limit_cycles.size(), 2U);
    EXPECT_TRUE(controller.time_domain->reversal);
    // Losses scale with the square of the rms.
    const double rms = controller.effect().rms(controller.design.boresight_rms);
    const double loss = design::pointing_loss_db(rms, section.bands[0].beamwidth,
                                                 design::LossConvention::mean_loss_two_axes);
    EXPECT_NEAR(candidate.figures->losses[0], loss, 1e-5 * loss);
  }
  EXPECT_THAT(to_text(two_proposals()), HasSubstr("Controllers on the nonlinear antenna"));
}

TEST(Evaluate, ComparesLinearLoopsIfAskedTo) {
  auto arguments = arguments_of({proposal_path("half-flywheels")});
  arguments.random_samples = 100;
  arguments.time_domain = false;
  const Report report = evaluate_case(arguments, nullptr);
  EXPECT_FALSE(report.evaluated->time_domain);
  for (const auto& candidate : report.evaluated->candidates) {
    const auto& controller = candidate.controllers[*candidate.chosen];
    EXPECT_FALSE(controller.time_domain);
    EXPECT_EQ(controller.compared_rms(), controller.member_rms);
  }
  EXPECT_THAT(to_text(report), HasSubstr("linear loops only"));
  // What only simulated runs rest on is not listed then.
  for (const auto& quantity : report.assumed) {
    EXPECT_NE(quantity.key, "simulation.bristle_stiffness");
  }
}

TEST(Evaluate, ListsWhatProposalsAssume) {
  bool cost = false, change = false;
  for (const auto& one : two_proposals().assumed) {
    cost = cost || one.key == "no flywheels: cost.amount";
    change = change || one.key == "displacement x 1.41: motor.displacement";
  }
  EXPECT_TRUE(cost);
  EXPECT_TRUE(change);
}

TEST(Evaluate, DoesNotDependOnThreads) {
  auto arguments = arguments_of({proposal_path("half-flywheels")});
  arguments.random_samples = 150;
  const std::string one = to_json(evaluate_case(arguments, nullptr));
  arguments.threads = 3;
  EXPECT_EQ(to_json(evaluate_case(arguments, nullptr)), one);
}

TEST(Evaluate, KeepsProposalsThatMissTheirGoals) {
  const ScratchFolder folder;
  // A valve of 0.3 Hz leaves no loop its sensitivity; nothing here is stable enough.
  const std::string slow =
      folder.write("slow.toml", proposal_text("slow valve",
                                              "[drive]\nvalve_frequency = '0.02 Hz'\n"
                                              "valve_damping = '0.01'\n"));
  const auto run = run_program({"evaluate", case_path("dss14-70m"), slow, "--structure", "PI",
                                "--draws", "100", "--starts", "2"});
  EXPECT_EQ(run.exit_code, 3) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("boresight: slow valve: "));
  EXPECT_THAT(run.output, HasSubstr("as it is"));
  EXPECT_THAT(run.output, HasSubstr("Not eligible: no controller of "));
}

TEST(Evaluate, EndsWithCode3WhereNoCandidateMeetsANeededBudget) {
  const ScratchFolder folder;
  const std::string antenna =
      folder.write("case.toml", EditedCase()
                                    .replace("name = \"stated Ka-band need\"",
                                             "name = \"stated Ka-band need\"\n"
                                             "wind_speed = \"50 m/s\"")
                                    .text());
  const auto run = run_program({"evaluate", antenna, proposal_path("half-flywheels"), "--structure",
                                "PI", "--draws", "100", "--starts", "2", "--time-domain", "none"});
  EXPECT_EQ(run.exit_code, 3) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr(antenna + ": NOT MET: stated Ka-band need"));
}

// A state space starts from the loops that are best in the time domain.
TEST(Evaluate, RefusesAStateSpaceWithoutTheTimeDomainWhereItIsNamed) {
  const auto run = run_program({"evaluate", case_path("dss14-70m"), proposal_path("half-flywheels"),
                                "--structure", "PI", "SS", "--time-domain", "none"});
  EXPECT_EQ(run.exit_code, 2) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("expected the time domain for a state space (SS)"));
}

TEST(Evaluate, RefusesBadProposalsBeforeAnyWork) {
  const ScratchFolder folder;
  const std::string one =
      folder.write("one.toml", proposal_text("same", "[motor]\nflywheel_disks = 3\n"));
  const std::string two =
      folder.write("two.toml", proposal_text("same", "[motor]\nflywheel_disks = 4\n"));
  auto run = run_program({"evaluate", case_path("dss14-70m"), one, two});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.output, "");
  EXPECT_THAT(run.errors, StartsWith("boresight: " + two +
                                     ":1:8: name: expected a name of its own, "
                                     "found 'same', which " +
                                     one + " has too"));
  const std::string money =
      folder.write("money.toml", proposal_text("other", "[motor]\nflywheel_disks = 4\n", "MEUR"));
  run = run_program({"evaluate", case_path("dss14-70m"), one, money});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.errors, HasSubstr("cost.currency: expected the currency of"));
  const std::string own =
      folder.write("own.toml", proposal_text("as it is", "[motor]\nflywheel_disks = 4\n"));
  run = run_program({"evaluate", case_path("dss14-70m"), own});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.errors, HasSubstr("expected another name than 'as it is'"));
  run = run_program({"evaluate", case_path("dss14-70m"), one, "--structure", "PIDD"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.errors, HasSubstr("--structure: "));
  run = run_program({"evaluate", case_path("dss14-70m"), "no-such-file.toml"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.errors, HasSubstr("no-such-file.toml: expected a readable file"));
}

TEST(Evaluate, EvaluatesTheAntennaAsItIsWithoutProposals) {
  auto arguments = arguments_of({});
  arguments.time_domain = false;
  const Report report = evaluate_case(arguments, nullptr);
  ASSERT_EQ(report.evaluated->candidates.size(), 1U);
  EXPECT_TRUE(report.evaluated->candidates.front().feasible());
  EXPECT_FALSE(report.evaluated->decision);
  EXPECT_TRUE(report.evaluated->not_run.empty());
  EXPECT_FALSE(report.interrupted);
}

TEST(Evaluate, TellsWhatWasWholeWhenInterrupted) {
  auto arguments = arguments_of({proposal_path("no-flywheels")});
  int asked = 0;
  const Report report = evaluate_case(arguments, [&] { return ++asked > 2000; });
  EXPECT_TRUE(report.interrupted);
  ASSERT_TRUE(report.evaluated);
  EXPECT_FALSE(report.evaluated->decision);
  EXPECT_FALSE(report.evaluated->not_run.empty());
  EXPECT_THAT(to_text(report), HasSubstr("Not run: "));
  const Report none = evaluate_case(arguments, [] { return true; });
  EXPECT_TRUE(none.evaluated->candidates.empty());
  EXPECT_THAT(to_text(none), HasSubstr("INTERRUPTED"));
  EXPECT_FALSE(to_json(none).empty());
}

}  // namespace
}  // namespace boresight::app
