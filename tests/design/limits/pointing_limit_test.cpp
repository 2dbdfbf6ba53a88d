#include <cmath>
#include <functional>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/reference_problem.hpp"
#include "lag_loops.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/loops/antenna_in_wind.hpp>
#include <boresight/design/limits/parallel_sections.hpp>
#include <boresight/design/limits/pointing_limit.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::design {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TrackingProblem problem_with_torque_noise() {
  TrackingProblem problem = reference::tracking_problem();
  problem.noise.torque_rms = 0.5;
  return problem;
}

// The best known controller of each structure under the default goals.
std::vector<DescribedController> tuned_controllers() {
  const auto controller = [](const char* name, std::vector<double> gains) {
    return DescribedController{name, {control::LoopStructure::named(name), std::move(gains)}};
  };
  return {
      controller("PI", {0.158735, 0.420689, 2.62766, 10.2563, 0.235307}),
      controller("DPF", {3.12006, 0.117998, 300.0, 0.31395, 10.4535, 1.20058, 2.18349}),
      controller("LL", {0.367233, 0.196983, 3.05841, 47.1871, 2.63446, 3.0}),
      controller("FULL", {1.41584, 3.6698, 3.66983, 19.5576, 0.464795, 27.7097, 1.36296, 0.516357}),
      controller("PI+C", {0.737111, 0.01, 0.974395, 3.74484, 0.0001, 0.0172099, 4.30494}),
      controller("DPF+C",
                 {2.95643, 0.01, 300.0, 0.305674, 9.69483, 1.27419, 2.70872, 0.0105829, 0.822072})};
}

plant::AntennaPlant with_structure_frequencies(double factor) {
  plant::AntennaPlant plant = reference::antenna();
  plant.structure.gear_stiffness *= factor * factor;
  for (auto& mode : plant.structure.modes) mode.stiffness *= factor * factor;
  return plant;
}

const PointingLimit& nominal_limit() {
  static const PointingLimit limit =
      pointing_limit(problem_with_torque_noise(), {}, {}, tuned_controllers());
  return limit;
}

plant::StateSpace antenna_in_its_wind() {
  const TrackingProblem problem = problem_with_torque_noise();
  return control::antenna_in_wind(problem.plant, fit_wind_filter(problem));
}

TEST(PointingLimit, LiesBelowEveryTunedStructureOfTheSameEffort) {
  const PointingLimit& limit = nominal_limit();
  EXPECT_GT(limit.min_rms, 0.05 * reference::mdeg);
  ASSERT_EQ(limit.controllers.size(), 6U);
  for (const ControllerAgainstLimit& controller : limit.controllers) {
    const SampledResult& found = controller.design.nominal;
    EXPECT_TRUE(found.stable()) << controller.name;
    EXPECT_GT(controller.min_rms, 0.0);
    EXPECT_LT(controller.min_rms, found.boresight_rms) << controller.name;
    EXPECT_LT(limit.unconstrained.nominal.boresight_rms, found.boresight_rms) << controller.name;
    EXPECT_FALSE(controller.to_robustified);
  }
}

TEST(PointingLimit, IsReachedByTheUnconstrainedController) {
  const PointingLimit& limit = nominal_limit();
  const SampledResult& found = limit.unconstrained.nominal;
  EXPECT_TRUE(found.stable());
  EXPECT_NEAR(found.control_effort / limit.effort_limit, 1.0, 1e-5);
  EXPECT_NEAR(found.boresight_rms / limit.min_rms, 1.0, 5e-5);
  EXPECT_GT(found.peak.magnitude, 5.0);  // and by a controller that nobody should build
  // It agrees with the covariance of the loop as it is put together elsewhere, to what rounding
  // leaves of slow wind in it.
  const auto other = control::sampled_pointing(
      {antenna_in_its_wind(), limit.unconstrained.controller, limit.computation_delay},
      problem_with_torque_noise().noise);
  const double ratio = reference::gear_ratio();
  EXPECT_NEAR(other.boresight_rms / ratio / found.boresight_rms, 1.0, 2e-5);
  EXPECT_NEAR(other.wind_rms / ratio / found.wind_rms, 1.0, 2e-5);
  EXPECT_NEAR(other.noise_rms / ratio / found.noise_rms, 1.0, 1e-6);
  EXPECT_NEAR(other.control_effort / found.control_effort, 1.0, 1e-6);
}

TEST(PointingLimit, LimitsThePeakAtTheValveAtAPrice) {
  const PointingLimit& limit = nominal_limit();
  ASSERT_TRUE(limit.margin_limited);
  const SampledDesign& design = limit.margin_limited->design;
  EXPECT_TRUE(design.nominal.stable());
  EXPECT_LE(design.nominal.control_effort, limit.effort_limit);
  EXPECT_GT(design.nominal.boresight_rms, limit.min_rms);
  EXPECT_LT(design.nominal.boresight_rms, 1.2 * limit.min_rms);
  // The peak over all frequencies, by bounds instead of a grid.
  const auto open = control::sampled_open_loop(
      {antenna_in_its_wind(), design.controller, limit.computation_delay}, "valve_command");
  const auto returned = plant::static_gain(Eigen::MatrixXd::Ones(1, 1), {"valve_command_returned"},
                                           {"valve_command"});
  plant::FeedbackOptions options;
  options.total_inputs = {"entering"};
  const auto closed = plant::feedback(open, returned, options);
  const auto peak = control::peak_gain(plant::subsystem(closed, {"valve_command"}, {"entering"}),
                                       {.relative_tolerance = 1e-4});
  EXPECT_LE(peak.upper, 2.0 * (1.0 + 2e-4));
  EXPECT_NEAR(design.nominal.peak.magnitude / peak.lower, 1.0, 1e-3);
  EXPECT_NEAR(design.nominal.peak.frequency / peak.frequency, 1.0, 0.02);
}

TEST(PointingLimit, GivesEveryNumberItsRatiosAreMadeOf) {
  const PointingLimit& limit = nominal_limit();
  for (const ControllerAgainstLimit& controller : limit.controllers) {
    const SampledResult& found = controller.design.nominal;
    double minimum = 0.0;
    for (const auto& point : limit.bound.points) {
      minimum = std::max(minimum, point.cost - point.weight * std::pow(found.control_effort, 2));
    }
    EXPECT_DOUBLE_EQ(*controller.to_min, found.boresight_rms / std::sqrt(minimum));
    EXPECT_DOUBLE_EQ(*controller.to_margin_limited,
                     found.boresight_rms / limit.margin_limited->design.nominal.boresight_rms);
    EXPECT_DOUBLE_EQ(*controller.to_flexure, found.boresight_rms / limit.flexure_rms);
    EXPECT_DOUBLE_EQ(*controller.to_full_information,
                     found.boresight_rms / limit.full_information_rms);
  }
  EXPECT_LT(limit.full_information_rms, limit.min_rms);
}

TEST(PointingLimit, BoundsLessTheMoreEffortThereIs) {
  const EffortBound& bound = nominal_limit().bound;
  double last = 1.0;
  for (const double effort : {0.05, 0.2, 0.4, 0.6, 1.0}) {
    const double minimum = bound.min_rms(effort);
    EXPECT_LT(minimum, last);
    last = minimum;
  }
  EXPECT_EQ(bound.min_rms(100.0), 0.0);
}

// The bending alone is a resonator on the wind's spectrum; with rigid springs nothing is left.
TEST(PointingLimit, SeesTheBendingThatNoEncoderSees) {
  TrackingProblem problem = problem_with_torque_noise();
  const double held = flexure_rms(problem);
  EXPECT_NEAR(held / nominal_limit().flexure_rms, 1.0, 1e-12);
  // Static bending under the rms of the gusts, and what the resonances add.
  double compliance = 0.0;
  for (const auto& mode : problem.plant.structure.modes) {
    compliance += mode.wind_fraction * mode.beam_weight / mode.stiffness;
  }
  const double gusts = 13.9;  // N m rms at the motor
  const double of_static = held * problem.gear_ratio / (std::abs(compliance) * gusts);
  EXPECT_GT(of_static, 1.0);
  EXPECT_LT(of_static, 1.4);
  for (auto& mode : problem.plant.structure.modes) mode.stiffness *= 100.0;
  EXPECT_LT(flexure_rms(problem), 0.02 * held);
}

TEST(PointingLimit, IsRobustOnEveryMemberOnceRobustified) {
  const std::vector<EnsembleMember> members{{"slow structure", with_structure_frequencies(0.95)},
                                            {"fast structure", with_structure_frequencies(1.05)}};
  const PointingLimit limit = pointing_limit(problem_with_torque_noise(), {}, members,
                                             {tuned_controllers().back()}, {.threads = 2});
  EXPECT_LT(limit.unconstrained.stable_members, 2);  // it leans on what it believes
  EXPECT_TRUE(std::isnan(limit.unconstrained.worst_rms));
  ASSERT_TRUE(limit.robustified);
  const SampledDesign& design = limit.robustified->design;
  EXPECT_EQ(design.stable_members, 2);
  for (const SampledResult& member : design.members) {
    EXPECT_TRUE(member.stable()) << member.plant;
    EXPECT_LE(member.peak.magnitude, 2.0) << member.plant;
    EXPECT_LE(member.control_effort, 0.6) << member.plant;
    EXPECT_LE(member.boresight_rms, design.worst_rms);
  }
  EXPECT_GT(design.nominal.boresight_rms, limit.margin_limited->design.nominal.boresight_rms);
  EXPECT_LT(design.worst_rms, 3.0 * limit.min_rms);
  const ControllerAgainstLimit& controller = limit.controllers.front();
  EXPECT_DOUBLE_EQ(*controller.to_robustified,
                   controller.design.nominal.boresight_rms / design.nominal.boresight_rms);
  EXPECT_DOUBLE_EQ(*controller.worst_to_robustified,
                   controller.design.worst_rms / design.worst_rms);
  EXPECT_EQ(design.members.front().plant, "slow structure");
  ASSERT_TRUE(limit.refined);
  EXPECT_EQ(limit.refined_from, "robust LQG");
  EXPECT_LT(limit.refined->worst_rms, 0.99 * design.worst_rms);
  EXPECT_EQ(limit.refined->controller.a.rows(), design.controller.a.rows());
  for (const SampledResult& member : limit.refined->members) {
    EXPECT_TRUE(member.stable()) << member.plant;
    EXPECT_LE(member.peak.magnitude, 2.0) << member.plant;
    EXPECT_LE(member.control_effort, 0.6) << member.plant;
  }
}

// Loops without integrals are a start for the refinement, others are not.
TEST(PointingLimit, RefinesFromTheLoopsItIsGiven) {
  const std::vector<EnsembleMember> members{{"fast structure", with_structure_frequencies(1.05)}};
  const TrackingProblem problem = problem_with_torque_noise();
  const DescribedController loops{"lags", reference::lag_loops()};
  std::optional<plant::StateSpace> evaluated;
  const auto from = [&](const DescribedController& start) {
    return pointing_limit(
        problem, {}, members, {loops},
        {.threads = 2, .start = start, .violations = [&](const plant::StateSpace& one, int) {
           evaluated = one;
           return 0;
         }});
  };
  const PointingLimit limit = from(loops);
  ASSERT_TRUE(limit.robustified && limit.refined);
  EXPECT_EQ(limit.refined_from, "lags");
  // Five pairs of poles are added to the two lags.
  EXPECT_EQ(limit.refined->controller.a.rows(), 2 + 2 * 5);
  EXPECT_LT(limit.refined->worst_rms, 0.9 * limit.controllers.front().design.worst_rms);
  EXPECT_EQ(limit.refined->stable_members, 1);
  // Violations are counted for the result.
  ASSERT_TRUE(evaluated);
  EXPECT_EQ(limit.refined->controller.b, evaluated->b);
  EXPECT_EQ(from(tuned_controllers().front()).refined_from, "robust LQG");
}

// Ms with a reserve for other plants, Ms of the position loop, and at edges of the encoder.
TEST(PointingLimit, TheRefinedKeepsItsMarginsAtTheEncoderToo) {
  const std::vector<EnsembleMember> members{{"fast structure", with_structure_frequencies(1.05)}};
  const TrackingProblem problem = problem_with_torque_noise();
  const DescribedController loops{"lags", reference::lag_loops()};
  Constraints standing;
  standing.standstill = Standstill{3.0, {100.0}, {{60.0, 2.0}, {120.0, 2.0}}};
  const PointingLimit limit =
      pointing_limit(problem, standing, members, {},
                     {.threads = 2,
                      .start = loops,
                      .corners = {{"slow structure", with_structure_frequencies(0.95)}}});
  ASSERT_TRUE(limit.refined);
  const plant::StateSpace& controller = limit.refined->controller;
  const auto filter = fit_wind_filter(problem);
  const auto setting = [&](plant::AntennaPlant plant, double friction, double encoder_gain) {
    plant.drive.viscous_friction = friction;
    return SampledSetting("plant", plant, filter, problem.noise, limit.sample_time,
                          plant::frequency_grid(plant, 1e-3, 24.9, 1000), encoder_gain);
  };
  const auto expect_peaks = [&](const SampledSetting& one, double at_valve, double of_position,
                                double missed = 2e-4) {
    const auto response = SampledSetting::controller_response(controller, one.frequency());
    EXPECT_LT(one.spectral_radius(controller), 1.0);
    EXPECT_LE(one.highest_peak(response).magnitude, (1.0 + missed) * at_valve);
    EXPECT_LE(one.highest_position_peak(response).magnitude, (1.0 + missed) * of_position);
  };
  const double friction = problem.plant.drive.viscous_friction;
  expect_peaks(setting(problem.plant, friction, 1.0), 1.7, 2.0);
  expect_peaks(setting(members.front().plant, friction, 1.0), 1.7, 2.0);
  expect_peaks(setting(with_structure_frequencies(0.95), friction, 1.0), 1.7, HUGE_VAL);
  expect_peaks(setting(problem.plant, 100.0, 1.0), 3.0, 3.0);
  for (const Standstill::Edge& edge : standing.standstill->edges) {
    // Here a pole of the controller makes the peak, which the grid of the search does not follow.
    expect_peaks(setting(problem.plant, edge.friction, edge.encoder_gain), 2.5, HUGE_VAL, 3e-3);
  }
  const PoleBounds poles = bounds_of(controller);
  EXPECT_GT(poles.slowest, 0.245);
  EXPECT_GT(poles.damping, 0.048);
}

double locked_motor_gain(const SampledSetting& locked, const plant::StateSpace& controller) {
  const auto response = SampledSetting::controller_response(controller, locked.frequency());
  return locked.highest_locked_motor_gain(response).magnitude;
}

// To less where violations remain, and not at all where they still do.
TEST(PointingLimit, TheRefinedLimitsTheGainOnALockedMotor) {
  const std::vector<EnsembleMember> members{{"fast structure", with_structure_frequencies(1.05)}};
  const TrackingProblem problem = problem_with_torque_noise();
  const DescribedController loops{"lags", reference::lag_loops()};
  plant::AntennaPlant plant = problem.plant;
  plant.drive.viscous_friction = 1e7;
  const SampledSetting locked("locked", plant, fit_wind_filter(problem), problem.noise, 0.02,
                              plant::frequency_grid(plant, 1e-3, 24.9, 100));
  const auto gain = [&](const plant::StateSpace& controller) {
    return locked_motor_gain(locked, controller);
  };
  const plant::StateSpace start =
      control::sampled_loop(locked.problem().plant, loops.controller, 0.02).controller;
  const double stiffness = 0.9 * gain(start) / 5.0;
  Constraints standing;
  standing.standstill = Standstill{3.0, {100.0}, {}, stiffness};
  // The gain of the result, over the stiffness, where these gains count as a violation.
  const auto refined = [&](const std::function<bool(double)>& violates) {
    const auto violations = [&](const plant::StateSpace& one, int) {
      return violates(gain(one) / stiffness) ? 1 : 0;
    };
    const auto limit = pointing_limit(problem, standing, members, {},
                                      {.threads = 2, .start = loops, .violations = violations});
    EXPECT_EQ(limit.refined_from, "lags");
    return limit.refined ? gain(limit.refined->controller) / stiffness : 0.0;
  };
  const double first = refined([](double) { return false; });
  EXPECT_LT(first, 1.002 * 5.0);
  EXPECT_GT(first, 1.01 * 4.0);
  const double second = refined([](double found) { return found > 1.003 * 4.0; });
  EXPECT_LT(second, 1.002 * 4.0);
  EXPECT_GT(second, 0.0);
  EXPECT_GT(refined([](double found) { return found < 1.01 * 5.0; }), 1.01 * 5.0);
}

// Freedom from violations that the limited gain has at a high price only counts less than what is
// free of them without that limit.
TEST(PointingLimit, TheRefinedGivesUpAConditionThatCostsTooMuch) {
  const std::vector<EnsembleMember> members{{"fast structure", with_structure_frequencies(1.05)}};
  const TrackingProblem problem = problem_with_torque_noise();
  const auto setting = [&](double friction) {
    plant::AntennaPlant plant = problem.plant;
    plant.drive.viscous_friction = friction;
    return SampledSetting("plant", plant, fit_wind_filter(problem), problem.noise, 0.02,
                          plant::frequency_grid(plant, 1e-3, 24.9, 100));
  };
  const SampledSetting nominal = setting(problem.plant.drive.viscous_friction);
  const SampledSetting locked = setting(1e7);
  const auto gain = [&](const plant::StateSpace& controller) {
    return locked_motor_gain(locked, controller);
  };
  const plant::StateSpace start =
      control::sampled_loop(nominal.problem().plant, reference::lag_loops(), 0.02).controller;
  const double stiffness = 0.9 * gain(start) / 5.0;
  Constraints standing;
  standing.standstill = Standstill{3.0, {100.0}, {}, stiffness};
  const auto refined = [&](const CountViolations& violations) {
    return pointing_limit(problem, standing, members, {},
                          {.threads = 2,
                           .start = DescribedController{"lags", reference::lag_loops()},
                           .violations = violations})
        .refined.value()
        .controller;
  };
  const double least =
      nominal.boresight_rms(refined([](const plant::StateSpace&, int) { return 0; }));
  // With the gain limited, only steps of so much rms are free of violations.
  const auto gain_of_result = [&](double price) {
    int free_at_that_price = 0;
    const auto found = refined([&](const plant::StateSpace& one, int) {
      if (gain(one) > 1.01 * 5.0 * stiffness) return 0;
      if (nominal.boresight_rms(one) < price * least) return 1;
      ++free_at_that_price;
      return 0;
    });
    EXPECT_GT(free_at_that_price, 0) << price;
    return gain(found) / stiffness;
  };
  EXPECT_LT(gain_of_result(1.02), 1.002 * 5.0);
  EXPECT_GT(gain_of_result(1.10), 1.01 * 5.0);
}

// Friction slopes of the constraint, and larger ones up to ten times.
TEST(PointingLimit, TheRobustifiedIsStableWhileFrictionHoldsTheMotor) {
  const std::vector<EnsembleMember> members{{"fast structure", with_structure_frequencies(1.05)}};
  const TrackingProblem problem = problem_with_torque_noise();
  Constraints standing;
  standing.standstill = Standstill{3.0, {100.0, 300.0}};
  const auto free = pointing_limit(problem, {}, members, {});
  const auto held = pointing_limit(problem, standing, members, {});
  ASSERT_TRUE(free.robustified && held.robustified);
  EXPECT_GE(held.robustified->design.worst_rms, 0.99 * free.robustified->design.worst_rms);
  const auto filter = fit_wind_filter(problem);
  for (const double friction : {100.0, 300.0, 900.0, 3000.0}) {
    plant::AntennaPlant plant = problem.plant;
    plant.drive.viscous_friction = friction;
    const SampledSetting setting("held", plant, filter, problem.noise, held.sample_time,
                                 plant::frequency_grid(plant, 1e-3, 24.9, 100));
    const auto& controller = held.robustified->design.controller;
    EXPECT_LT(setting.spectral_radius(controller), 1.0) << friction;
    const auto peak =
        setting.highest_peak(SampledSetting::controller_response(controller, setting.frequency()));
    EXPECT_LE(peak.magnitude, 3.0 * (1.0 + 1e-3)) << friction;
  }
  // It can be switched on without its loop, and is of lower order than its design.
  const auto& controller = held.robustified->design.controller;
  EXPECT_LT(numerics::spectral_radius(controller.a), 1.0);
  EXPECT_LT(controller.a.rows(), held.robustified->full_order);
}

TEST(PointingLimit, SaysOfAControllerThatIsUnstableOnlyThat) {
  std::vector<DescribedController> controllers{tuned_controllers().front()};
  controllers.front().controller.gains[0] = 20.0;
  const SampledSetting setting(
      "own", reference::antenna(), fit_wind_filter(problem_with_torque_noise()),
      problem_with_torque_noise().noise, 0.02, Eigen::ArrayXd::LinSpaced(50, 0.1, 150.0));
  const auto evaluated = setting.evaluate(
      control::sampled_loop(setting.problem().plant, controllers.front().controller, 0.02)
          .controller);
  EXPECT_GT(evaluated.spectral_radius, 1.0);
  EXPECT_TRUE(std::isnan(evaluated.boresight_rms));
  EXPECT_TRUE(std::isnan(evaluated.control_effort));
}

TEST(SampledSetting, TakesTorqueWithoutStatedNoiseForNextToExact) {
  TrackingProblem problem = problem_with_torque_noise();
  const auto filter = fit_wind_filter(problem);
  const Eigen::ArrayXd some = Eigen::ArrayXd::LinSpaced(30, 0.1, 150.0);
  const auto variance = [&](double torque_noise) {
    problem.noise.torque_rms = torque_noise;
    return SampledSetting("own", problem.plant, filter, problem.noise, 0.02, some)
        .problem()
        .measurement_variance.at("motor_torque");
  };
  EXPECT_DOUBLE_EQ(variance(0.5), 0.25);
  // The wind: 13.9 N m above 1e-4 Hz, and what its filter adds below.
  EXPECT_GT(std::sqrt(variance(0.0)), 1e-3 * 13.9);
  EXPECT_LT(std::sqrt(variance(0.0)), 1.5e-3 * 13.9);
}

TEST(PointingLimit, RefusesWhatItCannotEvaluate) {
  TrackingProblem problem = problem_with_torque_noise();
  problem.noise.tachometer_rms = 0.0;
  EXPECT_THAT(reference::Call([&] { pointing_limit(problem, {}, {}, {}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected noise of the tachometer above 0")));
  problem = problem_with_torque_noise();
  EXPECT_THAT(reference::Call([&] { pointing_limit(problem, {}, {}, {}, {.sample_time = 0.0}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected a sample time above 0, found 0 s")));
  DescribedController controller = tuned_controllers().front();
  controller.controller.gains.pop_back();
  EXPECT_THAT(reference::Call([&] { pointing_limit(problem, {}, {}, {controller}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("expected 5 gains")));
  const auto filter = fit_wind_filter(problem);
  const Eigen::ArrayXd some = Eigen::ArrayXd::LinSpaced(30, 0.1, 150.0);
  const SampledSetting one("one", problem.plant, filter, problem.noise, 0.02, some);
  EXPECT_THAT(reference::Call([&] { search_limited_lqg(one, {.sensitivity_peak = 1.0}); }),
              ThrowsMessage<InvalidInput>(HasSubstr("maximum sensitivities above 1")));
}

}  // namespace
}  // namespace boresight::design
