#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/document/on_one_line.hpp"
#include "io/edited_case.hpp"
#include <boresight/app/report/json_writer.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/io/case/case_simulation.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/description/time_domain_results.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
constexpr double mdeg = 1e-3 * degree;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TimeDomainSection section() {
  TimeDomainSection section;
  section.controller = "PI, robust";
  section.wind_speed = 10.0;
  section.sample_time = 0.02;
  section.encoder_resolution = 0.3464 * mdeg;
  section.feedforward = {.rate_to_rate_command = 1.0,
                         .acceleration_to_rate_command = -0.008,
                         .rate_to_valve_command = 1.02,
                         .acceleration_to_valve_command = 0.116,
                         .rate_to_motor_torque = 0.9,
                         .acceleration_to_motor_torque = 1.817,
                         .friction = {8.0, 13.0, 0.15, 50.0, 1.5, 0.94},
                         .friction_to_valve_command = 0.0232,
                         .friction_change_to_valve_command = 0.019,
                         .supply_torque = 306.0};
  section.friction_feedforward = 0.8;
  section.options.tracking_rate = 4.17 * mdeg;
  section.options.limits = {0.25 * degree, 0.2 * degree};
  section.options.settled_error = 0.527 * mdeg;
  section.options.allowed_limit_cycle = 0.7453 * mdeg;
  auto& wind = section.result.wind;
  wind.predicted_rms = 0.5 * mdeg;
  wind.realisation_error = -0.01 * mdeg;
  wind.sampling = 0.001 * mdeg;
  wind.boresight_rms = 0.6 * mdeg;
  wind.encoder_rms = 0.4 * mdeg;
  wind.influences = {
      {design::Influence::friction, design::RunStatus::complete, 0.52 * mdeg, 0.08 * mdeg},
      {design::Influence::gear, design::RunStatus::complete, 0.59 * mdeg, 0.01 * mdeg}};
  wind.interaction = 0.019 * mdeg;
  design::LimitCycleResult rest;
  rest.limit_cycle = true;
  rest.encoder_amplitude = 0.29 * mdeg;
  rest.boresight_amplitude = 0.295 * mdeg;
  rest.frequency = 0.0612;
  rest.persistence = 0.97;
  rest.starts = 3;
  rest.starts_with_limit_cycle = 2;
  design::LimitCycleResult moving;
  moving.rate = 4.17 * mdeg;
  moving.encoder_amplitude = 0.007 * mdeg;
  moving.valve_command_rms = 1.25;
  moving.starts = 3;
  section.result.limit_cycles = {rest, moving};
  design::ReversalResult reversal;
  reversal.encoder_error = 4.98 * mdeg;
  reversal.boresight_error = 5.04 * mdeg;
  reversal.encoder_error_without_friction = 1.5 * mdeg;
  reversal.boresight_error_without_friction_feedforward = 9.03 * mdeg;
  reversal.time_of_largest = 1.34;
  section.result.reversal = reversal;
  design::SlewResult slew;
  slew.distance = 1.0 * degree;
  slew.limits = {0.1 * degree, 0.03 * degree};
  slew.achievable_limits = false;
  slew.command_time = 13.3;
  slew.largest_error = 32.0 * mdeg;
  slew.overshoot = 13.0 * mdeg;
  slew.settling_time = 24.16;
  section.result.slew = slew;
  return section;
}

TEST(TimeDomain, TextSaysWhatTheNumbersAre) {
  const std::string text = to_text(section());
  EXPECT_THAT(text, HasSubstr("on the nonlinear antenna: PI, robust"));
  EXPECT_THAT(text, HasSubstr("linear prediction"));
  EXPECT_THAT(text, HasSubstr("-0.0100"));
  EXPECT_THAT(text, HasSubstr("+0.0800      0.5200"));
  EXPECT_THAT(text, HasSubstr("At rest, no wind: a limit cycle of +-0.2900 mdeg at the encoder"));
  const std::string flat = on_one_line(text);
  EXPECT_THAT(flat, HasSubstr("0.0612 Hz, in 2 of 3 runs, from different initial steps."));
  EXPECT_THAT(
      flat,
      HasSubstr(
          "no lasting limit cycle above the encoder's resolution in 3 runs (+-0.0070 mdeg and a "
          "valve command of 1.25 rad/s rms left)"));
  EXPECT_THAT(flat, HasSubstr("peak error 5.0400 mdeg in boresight (9.0300 without friction "
                              "feedforward), 4.9800 mdeg at the encoder 1.34 s after"));
  EXPECT_THAT(text, ContainsRegex("valve command +commanded acceleration a +0[.]116 s"));
  EXPECT_THAT(text, ContainsRegex("valve command +change of Tf per s +0[.]019 rad/.N[.]m."));
  EXPECT_THAT(flat,
              HasSubstr("Tf = 8 + 5 exp(-(w/0.15)^2) + 50 (1 - exp(-|w|/1.5)) + 0.94 |w| N.m"));
  EXPECT_THAT(flat, AllOf(HasSubstr("It is 80 % of the antenna's friction."),
                          HasSubstr("80 % of the friction fed forward.")));
  EXPECT_THAT(flat, HasSubstr("sqrt(1 - T/306), as a loaded orifice passes less: T = 1.817 a + "
                              "Tf N.m against the flow, at most 0.9 of the supply."));
  EXPECT_THAT(flat, HasSubstr("drive limit; specified 0.25 deg/s and 0.2 deg/s2"));
  EXPECT_THAT(flat, HasSubstr("24.16 s after the end of the command"));
}

TEST(TimeDomain, SaysInWordsThatASlewArrivesWithinItsBound) {
  auto slew = section();
  slew.result.slew->settling_time = 0.0;
  slew.candidates = {{"PI, robust", slew.result}, {"DPF, robust", section().result}};
  const std::string text = to_text(slew);
  EXPECT_THAT(text, HasSubstr("0.5270 mdeg from the end of the command on;"));
  EXPECT_THAT(text, Not(HasSubstr("0.00 s")));
  EXPECT_THAT(text, HasSubstr("at once"));
  EXPECT_THAT(text, HasSubstr("24.16"));
}

TEST(TimeDomain, DecidesForAControllerFreeOfLimitCycles) {
  auto chosen = section();
  EXPECT_EQ(decide(chosen), "");
  // One of less rms in wind that limit-cycles beyond the allowed 0.7453 mdeg, which is why it was
  // passed over.
  auto limit_cycles = chosen.result;
  limit_cycles.wind.boresight_rms = 0.1 * mdeg;
  limit_cycles.limit_cycles[0].boresight_amplitude = 8.73 * mdeg;
  chosen.candidates = {{"PI, robust", chosen.result}, {"DPF+C, robust", limit_cycles}};
  EXPECT_THAT(decide(chosen),
              StartsWith("Not DPF+C, robust, with 0.500 mdeg on the linear plant: on the nonlinear "
                         "antenna it has 0.100 and has a limit cycle of +-8.73 mdeg"));
  // So is one that only the linear plant prefers, and one whose run in wind was lost.
  chosen.candidates[1].result.wind.boresight_rms = 5.0 * mdeg;
  EXPECT_EQ(decide(chosen), "");
  chosen.candidates[1].result.wind.predicted_rms = 0.4 * mdeg;
  EXPECT_THAT(decide(chosen), StartsWith("Not DPF+C, robust, with 0.400 mdeg on the linear plant"));
  chosen.candidates[1].result.limit_cycles = chosen.result.limit_cycles;
  EXPECT_EQ(decide(chosen), "");
  chosen.candidates[1].result.wind.status = design::RunStatus::lost;
  chosen.candidates[1].result.wind.boresight_rms = nan;
  EXPECT_THAT(decide(chosen), HasSubstr("its run did not complete (lost)"));
  // Where all do.
  chosen.result = limit_cycles;
  EXPECT_THAT(decide(chosen),
              HasSubstr("no controller that completes its run in wind is free of limit cycles"));
  EXPECT_THAT(decide(chosen), Not(HasSubstr("Recommended")));
  // A run that did not end has no amplitude.
  chosen.result.limit_cycles[0] = {};
  chosen.result.limit_cycles[0].status = design::RunStatus::lost;
  EXPECT_THAT(decide(chosen), HasSubstr("but was not shown free of limit cycles (a run"));
  auto lost = section();
  lost.result.wind.boresight_rms = nan;
  EXPECT_THAT(
      decide(lost),
      HasSubstr("No controller completed its run on the nonlinear antenna in 10 m/s of wind"));
}

TEST(TimeDomain, RecommendsByRmsAndLimitCycleTogether) {
  const double allowed = 0.7453 * mdeg;
  const auto candidate = [&](double rms, double limit_cycles) {
    auto result = section().result;
    result.wind.boresight_rms = rms * mdeg;
    result.limit_cycles[0].boresight_amplitude = limit_cycles * mdeg;
    result.limit_cycles[0].limit_cycle = limit_cycles > 0.0;
    return assessment_of({"controller", {}}, result, std::nullopt, allowed);
  };
  const auto winner = [](const std::vector<design::Assessment>& candidates) {
    return design::recommend(candidates, {.accepted = design::Fitness::unstable}).winner;
  };
  EXPECT_EQ(winner({candidate(1.0722, 0.542), candidate(1.075, 0.17)}), 1U);
  EXPECT_EQ(winner({candidate(0.95, 0.542), candidate(1.075, 0.17)}), 0U);
  EXPECT_EQ(winner({candidate(1.0, 0.2), candidate(1.0, 0.2)}), 0U);
  EXPECT_EQ(winner({candidate(0.3, 5.0), candidate(1.0, 0.2)}), 1U);
  // Beyond the allowed amplitude the limit cycle counts in the rms too.
  EXPECT_EQ(winner({candidate(0.3, 5.0), candidate(1.0, 4.0)}), 1U);
  EXPECT_EQ(winner({candidate(nan, 0.1), candidate(1.0, 0.2)}), 1U);
  EXPECT_EQ(winner({candidate(nan, 0.1), candidate(1.0, 4.0)}), 1U);
}

TEST(TimeDomain, SaysThatTheSlewRateIsOutOfReach) {
  auto slow = section();
  EXPECT_THAT(conclude(slow), HasSubstr("With 20 % flow and pressure reserve the drive slews at "
                                        "0.1 deg/s, not the specified 0.25."));
  slow.result.slew->achievable_limits = true;
  EXPECT_THAT(conclude(slow), Not(HasSubstr("reserve")));
}

TEST(TimeDomain, NamesAnAssumedStrokeThatDecides) {
  auto assumed = section();
  assumed.stroke_assumption = "a valve stroke of 150 rad/s that is assumed";
  EXPECT_EQ(assumed_stroke(assumed), "");
  assumed.slew_hangs_on_stroke = true;
  EXPECT_THAT(conclude(assumed), HasSubstr("The achievable slew rate depends on a valve stroke of "
                                           "150 rad/s that is assumed: state"));
  design::InfluenceResult limits;
  limits.influence = design::Influence::limits;
  limits.difference = 0.1 * assumed.result.wind.boresight_rms;
  assumed.result.wind.influences = {limits};
  EXPECT_THAT(decide(assumed), HasSubstr("The simulated rms and the slew rate depend on"));
  assumed.stroke_assumption.clear();
  EXPECT_EQ(assumed_stroke(assumed), "");
}

TEST(TimeDomain, TextSaysWhyThereAreNoNumbers) {
  auto lost = section();
  lost.result.wind.status = design::RunStatus::lost;
  lost.result.wind.message = "the encoder is 1 rad off";
  lost.result.limit_cycles[0].status = design::RunStatus::failed;
  lost.result.limit_cycles[0].message = "no steady motion";
  lost.result.reversal->status = design::RunStatus::lost;
  lost.result.reversal->message = "gone";
  lost.result.slew->largest_error = nan;
  lost.result.slew->settling_time.reset();
  lost.result.slew->status = design::RunStatus::failed;
  lost.result.slew->message = "the supply cannot move it";
  const std::string text = on_one_line(to_text(lost));
  EXPECT_THAT(text, HasSubstr("In wind of 10 m/s no rms: lost: the encoder is 1 rad off."));
  EXPECT_THAT(text, Not(HasSubstr("linear prediction")));
  EXPECT_THAT(text, HasSubstr("At rest, no wind: failed: no steady motion."));
  EXPECT_THAT(text, HasSubstr("Velocity reversals: lost: gone."));
  EXPECT_THAT(text, HasSubstr("the supply cannot move it."));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  auto slow = section();
  slow.result.slew->settling_time.reset();
  EXPECT_THAT(on_one_line(to_text(slow)), HasSubstr("not within 0.5270 mdeg 40 s after"));
}

TEST(TimeDomain, StatesWhetherASecondIntegratorConfirmsTheRun) {
  const auto told = [](const TimeDomainSection& section) { return on_one_line(to_text(section)); };
  auto checked = section();
  EXPECT_THAT(told(checked), Not(HasSubstr("CVODES")));
  EXPECT_TRUE(json_of(checked).at("integrators").is_null());
  auto& both = checked.result.integrators.emplace();
  both.collocation_rms = 0.6 * mdeg;
  both.cvodes_rms = 0.6 * mdeg;
  both.difference_rms = 3e-7 * mdeg;
  both.duration = 300.0;
  EXPECT_THAT(told(checked), HasSubstr("CVODES: 0.6000 mdeg in this wind, differs by 5e-07 of the "
                                       "rms (limit 1e-04); the integration is confirmed."));
  EXPECT_THAT(conclude(checked), Not(HasSubstr("CVODES")));
  const auto json = json_of(checked).at("integrators");
  EXPECT_DOUBLE_EQ(json.at("ratio_1").get<double>(), 5e-7);
  EXPECT_TRUE(json.at("agree").get<bool>());

  both.difference_rms = 0.012 * mdeg;
  EXPECT_THAT(told(checked), HasSubstr("the integration is NOT confirmed."));
  EXPECT_THAT(conclude(checked), HasSubstr("Do not rely on the simulated rms: CVODES, a second "
                                           "integrator, differs from it by 2 %."));
  both.ratio_without_quantisation = 2e-6;
  EXPECT_THAT(told(checked), HasSubstr("differ by 2e-06; the integration is confirmed. The"));
  EXPECT_EQ(conclude(checked).find("CVODES"), std::string::npos);
  both.status = design::RunStatus::lost;
  EXPECT_THAT(conclude(checked), HasSubstr("a second integrator, loses the target."));
  both.status = design::RunStatus::failed;
  both.message = "too stiff";
  both.cvodes_rms = both.difference_rms = nan;
  EXPECT_THAT(told(checked), HasSubstr("CVODES: no check, failed: too stiff."));
  EXPECT_THAT(conclude(checked), Not(HasSubstr("CVODES")));
  EXPECT_TRUE(json_of(checked).at("integrators").at("ratio_1").is_null());
}

TEST(TimeDomain, ConcludesWhatTheLinearFigureIsWorth) {
  const std::string text = conclude(section());
  EXPECT_THAT(text, HasSubstr("has 0.600 mdeg rms in one record of 10 m/s, linear prediction "
                              "0.500; friction alone adds 0.080."));
  EXPECT_THAT(text, HasSubstr("Nonlinearities add 20 %: a linear prediction needs 20 % margin."));
  EXPECT_THAT(text, HasSubstr("At rest it has a limit cycle of +-0.29 mdeg in 2 of 3 runs."));
  EXPECT_THAT(text, Not(HasSubstr("At the tracking rate it has")));
  EXPECT_THAT(text, HasSubstr("Peak error at a velocity reversal at tracking rate: 5.0 mdeg."));
  auto throttled = section();
  auto orifice = throttled.result.wind.influences.front();
  orifice.influence = design::Influence::orifice;
  orifice.difference = 0.3 * mdeg;
  throttled.result.wind.influences.push_back(orifice);
  EXPECT_THAT(conclude(throttled),
              HasSubstr("; the flow through the valve's orifices alone adds 0.300."));
  auto twice = section();
  twice.result.wind.boresight_rms = 1.06 * mdeg;
  EXPECT_THAT(conclude(twice), AllOf(HasSubstr("Simulated/linear rms ratio 2.12: a linear "
                                               "prediction needs this margin to its budget."),
                                     Not(HasSubstr("% margin"))));
  auto calm = section();
  calm.result.wind.boresight_rms = 0.49 * mdeg;
  EXPECT_THAT(conclude(calm), Not(HasSubstr("% margin")));
  auto lost = section();
  lost.result.wind.status = design::RunStatus::lost;
  EXPECT_THAT(conclude(lost), HasSubstr("in 10 m/s of wind did not complete (lost)"));
}

TEST(TimeDomain, SaysWhyAnotherControllerThanTheLinearlyBestIsChosen) {
  auto chosen = section();
  chosen.candidates = {{chosen.controller, chosen.result}, {"quick", chosen.result}};
  EXPECT_THAT(conclude(chosen), Not(HasSubstr("lowest linear rms")));
  auto& quick = chosen.candidates[1].result;
  quick.wind.predicted_rms = 0.3 * mdeg;
  quick.wind.boresight_rms = 0.7 * mdeg;
  EXPECT_THAT(conclude(chosen),
              HasSubstr("quick has the lowest linear rms (0.300 mdeg); on the nonlinear antenna it "
                        "has 0.700 with a limit cycle of +-0.29: " +
                        chosen.controller + " is better. "));
  quick.wind.status = design::RunStatus::lost;
  EXPECT_THAT(conclude(chosen), HasSubstr("its run did not complete (lost)"));
  EXPECT_THAT(to_text(chosen), HasSubstr("quick"));
  const auto json = json_of(chosen);
  ASSERT_EQ(json.at("candidates").size(), 2U);
  EXPECT_DOUBLE_EQ(json.at("candidates")[1].at("predicted_rms_mdeg").get<double>(), 0.3);
}

// Controllers of so much rms by the linear plant, simulated, and limit-cycling at rest, all in
// mdeg; the last is the one chosen, by a budget of 0.527 mdeg rms, which is a limit cycle of
// +-0.745.
struct ControllerInWind {
  double linear, simulated, limit_cycles;
};

TimeDomainSection chosen_of(const std::vector<ControllerInWind>& controllers) {
  auto chosen = section();
  for (const auto& controller : controllers) {
    auto result = section().result;
    result.wind.predicted_rms = controller.linear * mdeg;
    result.wind.boresight_rms = controller.simulated * mdeg;
    if (std::isnan(controller.simulated)) result.wind.status = design::RunStatus::lost;
    result.limit_cycles[0].limit_cycle = controller.limit_cycles > 0.0;
    result.limit_cycles[0].boresight_amplitude = controller.limit_cycles * mdeg;
    chosen.candidates.push_back(
        {fmt::format("controller {}", chosen.candidates.size() + 1), result});
  }
  chosen.controller = chosen.candidates.back().controller;
  chosen.result = chosen.candidates.back().result;
  return chosen;
}

TEST(TimeDomain, SaysByWhatRuleAControllerWasChosen) {
  const auto told = [](const std::vector<ControllerInWind>& controllers) {
    return on_one_line(to_text(chosen_of(controllers)));
  };
  const std::string minimum =
      "the one above meets most budgets and then has the least simulated rms, limit cycle added in "
      "quadrature, or fewer gains in a tie with it (2 %, or the 95 % interval of the difference "
      "over "
      "the same winds).";
  const std::string limit = "beyond the allowed amplitude (+-0.7453 mdeg)";
  const std::string some = "Of the controllers free of limit cycles " + limit + ", " + minimum;
  for (const double limit_cycles : {0.0, 0.3, 5.0}) {
    EXPECT_THAT(told({{0.3, 0.4, limit_cycles}, {0.5, 0.6, 0.3}}), HasSubstr(some));
  }
  EXPECT_THAT(told({{0.3, 2.2, 4.8}, {0.5, 1.8, 5.8}}),
              HasSubstr("All limit-cycle " + limit + "; " + minimum));
  // One that has no limit cycle, but not in wind, is none to choose.
  EXPECT_THAT(told({{0.3, nan, 0.0}, {0.5, 1.8, 5.8}}),
              HasSubstr("None completes the run in wind and is shown free of limit cycles " +
                        limit + "; of those that complete it " + minimum));
  EXPECT_THAT(told({{0.3, nan, 4.0}, {0.5, nan, 0.1}}),
              HasSubstr("None completes the run in wind: the one above has the least linear rms."));
}

TEST(TimeDomain, CallsNoControllerBetterThatLimitCyclesToo) {
  const auto told = [](const std::vector<ControllerInWind>& controllers) {
    return conclude(chosen_of(controllers));
  };
  const auto all = told({{0.3, 2.17, 4.8}, {0.5, 1.78, 5.8}});
  EXPECT_THAT(
      all,
      HasSubstr(
          "controller 1 has the lowest linear rms (0.300 mdeg); on the nonlinear antenna it has "
          "2.170 and has a limit cycle of +-4.80 mdeg, beyond the allowed +-0.745 mdeg: "
          "controller 2 has 1.780, but also has one beyond that, +-5.80 mdeg. "));
  EXPECT_THAT(all, HasSubstr("At rest it has a limit cycle of +-5.80 mdeg in 2 of 3 runs, beyond "
                             "the allowed +-0.745 mdeg."));
  EXPECT_THAT(all, Not(HasSubstr("is better")));
  EXPECT_THAT(
      told({{0.3, 1.78, 5.8}, {0.5, 1.79, 4.8}}),
      HasSubstr(": controller 2 has the same rms within 2 % and a smaller limit cycle, but also "
                "has one beyond that, +-4.80 mdeg. "));
  // One that does not is chosen whatever its rms.
  const auto some = told({{0.3, 0.4, 4.8}, {0.5, 0.6, 0.7}});
  EXPECT_THAT(some, HasSubstr("a limit cycle of +-4.80 mdeg, beyond the allowed +-0.745 mdeg: "
                              "controller 2 has no limit cycle beyond the allowed amplitude. "));
  EXPECT_THAT(some, HasSubstr("At rest it has a limit cycle of +-0.70 mdeg in 2 of 3 runs. "));
  // Where none does, rms and limit cycle decide together.
  EXPECT_THAT(told({{0.3, 0.7, 0.0}, {0.5, 0.6, 0.3}}),
              HasSubstr("it has 0.700: controller 2 is better. "));
  EXPECT_THAT(
      told({{0.3, 0.595, 0.6}, {0.5, 0.6, 0.3}}),
      HasSubstr("a limit cycle of +-0.60: controller 2 has the same rms within 2 % and a smaller "
                "limit cycle. "));
  EXPECT_THAT(
      told({{0.3, nan, 0.0}, {0.5, 1.8, 5.8}}),
      HasSubstr("its run did not complete (lost): controller 2 has 1.800, but has a limit cycle "
                "of +-5.80 mdeg, beyond the allowed"));
  EXPECT_THAT(told({{0.3, nan, 4.0}, {0.5, nan, 0.1}}),
              HasSubstr(": the run of controller 2 did not complete either. "));
}

TEST(TimeDomain, SaysOfAControllerAloneOnlyWhatItDoes) {
  auto alone = chosen_of({{0.5, 1.78, 5.8}});
  alone.candidates.clear();
  EXPECT_THAT(decide(alone),
              HasSubstr("On the nonlinear antenna controller 1 has 1.780 mdeg in wind, but "
                        "has a limit cycle of +-5.80 mdeg"));
  EXPECT_THAT(decide(alone), Not(HasSubstr("no controller")));
  alone.result.limit_cycles[0].status = design::RunStatus::failed;
  EXPECT_THAT(conclude(alone),
              HasSubstr("At rest freedom from limit cycles was not shown (failed)."));
}

TEST(TimeDomain, ChoosesTheLeastSimulatedRms) {
  const io::Case antenna = io::read_case(BORESIGHT_SOURCE_DIR "/cases/dss14-70m/case.toml");
  const design::Mission mission = mission_of(antenna);
  const auto problem = tracking_problem(mission);
  const control::LoopStructure& pi = control::LoopStructure::pi_with_lag();
  design::TimeDomainChoice choice(mission, problem, 1, 2);
  EXPECT_THROW(choice.chosen(design::ChoiceDetail::compared), InvalidInput);
  choice.add({"slow", {pi, {0.1, 0.42, 2.6, 3.0, 0.2}}});
  choice.add({"oscillates", {pi, {5.0, 0.42, 2.6, 30.0, 0.2}}});
  EXPECT_EQ(choice.chosen(design::ChoiceDetail::compared).controller, "slow");
  // One that is added after a choice.
  choice.add({"tuned", {pi, {0.15873, 0.42068, 2.6277, 10.257, 0.23532}}});
  const auto chosen = choice.chosen(design::ChoiceDetail::verified);
  EXPECT_EQ(chosen.controller, "tuned");
  ASSERT_EQ(chosen.candidates.size(), 3U);
  EXPECT_LT(chosen.candidates[2].result.wind.boresight_rms,
            chosen.candidates[0].result.wind.boresight_rms);
  EXPECT_EQ(chosen.candidates[2].result.wind.boresight_rms, chosen.result.wind.boresight_rms);
  ASSERT_TRUE(chosen.rms);
  EXPECT_EQ(chosen.candidates[2].simulated_rms(), chosen.rms->rms.value);
  EXPECT_GT(chosen.candidates[1].simulated_rms(), chosen.candidates[2].simulated_rms());
  // One that is far behind is not run in all records.
  EXPECT_EQ(chosen.rms->records, 10);
  EXPECT_EQ(chosen.candidates[1].rms->records, 4);
  // The one that was chosen before has run in all.
  EXPECT_EQ(chosen.candidates[0].rms->records, 10);
  // By the same winds: far apart, and a tie with itself.
  const auto change = figure_change(chosen.candidates[2], chosen.candidates[0]);
  ASSERT_TRUE(change);
  EXPECT_GT(change->lower, 0.02);
  EXPECT_EQ(figure_change(chosen.own(), chosen.candidates[2])->value, 0.0);
  // Nothing is compared with a run that was lost.
  design::SimulatedCandidate lost{"lost", chosen.candidates[1].result};
  lost.result.wind.boresight_rms = nan;
  EXPECT_TRUE(std::isnan(lost.simulated_rms()));
  EXPECT_FALSE(figure_change(chosen.own(), lost));
  EXPECT_FALSE(chosen.result.wind.influences.empty());
  // With other friction only where it is verified: four variations, at rest and tracking.
  EXPECT_EQ(chosen.limit_cycles_by_friction.size(), 8U);
  EXPECT_TRUE(choice.chosen(design::ChoiceDetail::compared).limit_cycles_by_friction.empty());
}

TEST(TimeDomain, SaysWhichOtherFrictionLimitCycles) {
  auto other = section();
  EXPECT_THAT(to_text(other), Not(HasSubstr("other friction")));
  other.limit_cycles_by_friction = {{"torques x 0.7", 0.0, 3, 0, 0.05 * mdeg},
                                    {"torques x 0.7", 4.17 * mdeg, 3, 0, 0.01 * mdeg},
                                    {"torques x 1.3", 0.0, 3, 0, 0.06 * mdeg},
                                    {"torques x 1.3", 4.17 * mdeg, 3, 0, 0.02 * mdeg}};
  EXPECT_THAT(on_one_line(to_text(other)),
              HasSubstr("With other friction (torques x 0.7; torques x 1.3): no limit cycle in 12 "
                        "runs, +-0.0600 mdeg at the encoder at most."));
  other.limit_cycles_by_friction[2].limit_cycles = 2;
  EXPECT_THAT(on_one_line(to_text(other)),
              HasSubstr("limit cycles that last 600 s: torques x 1.3 at rest in 2 of 3 runs, "
                        "+-0.0600 mdeg at the encoder. None with torques x 0.7."));
}

TEST(TimeDomain, JsonAloneGivesTheDifferenceFromThePrediction) {
  const auto json = json_of(section());
  const auto& wind = json.at("wind");
  double sum = wind.at("predicted_rms_mdeg").get<double>() +
               wind.at("realisation_error_mdeg").get<double>() +
               wind.at("sampling_mdeg").get<double>() + wind.at("interaction_mdeg").get<double>();
  for (const auto& one : wind.at("influences")) sum += one.at("difference_mdeg").get<double>();
  EXPECT_NEAR(sum, wind.at("boresight_rms_mdeg").get<double>(), 1e-12);
  EXPECT_NEAR(json.at("slew").at("rate_limit_deg_per_s").get<double>(), 0.1, 1e-12);
  EXPECT_TRUE(json.at("limit_cycles").at(1).at("frequency_Hz").is_null());
  EXPECT_TRUE(wind.at("message").is_null());
  auto bare = section();
  bare.result.reversal.reset();
  bare.result.slew.reset();
  bare.result.wind.boresight_rms = nan;
  EXPECT_TRUE(json_of(bare).at("slew").is_null());
  EXPECT_TRUE(json_of(bare).at("reversal").is_null());
  EXPECT_TRUE(json_of(bare).at("wind").at("boresight_rms_mdeg").is_null());
}

}  // namespace
}  // namespace boresight::app
