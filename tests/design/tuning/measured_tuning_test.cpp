#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measured_reference.hpp"
#include "reference_nonlinear_antenna.hpp"
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/measured/measured_confidence.hpp>
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/design/tuning/measured_tuning.hpp>
#include <boresight/identification/signals/local_polynomial_response.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/plant/nonlinear/operating_point.hpp>
#include <boresight/plant/nonlinear/simulation.hpp>

namespace boresight::design {
namespace {

using control::LoopStructure;
using reference::bins;
using ::testing::HasSubstr;

MeasuredProblem problem_of(control::MeasuredChannels channels) {
  const TrackingProblem reference = reference::tracking_problem();
  return {std::move(channels),
          reference.gear_ratio,
          reference.delay,
          reference.noise,
          reference.wind,
          reference.rms_band,
          300};
}

MeasuredProblem measured_problem(double coherence, std::uint64_t seed = 1, double lowest = 0.02,
                                 double highest = 25.0, double averages = 9.0) {
  const auto plant = reference::antenna();
  return problem_of(
      {reference::measured_plant(plant, bins(120.0, lowest, highest), coherence, averages, seed),
       reference::oil_spring(plant), plant.drive.tachometer_corner});
}

// The model the measurement was made of.
control::LoopEvaluator model_evaluator(const MeasuredProblem& problem) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd grid = measured_grid(problem, 300, false);
  return {control::sampled_on(
              grid, [plant](double w) { return reference::with_wind_at_motor(plant, w); }),
          {.delay = problem.delay,
           .noise = problem.noise,
           .wind_spectrum = motor_wind_spectrum(problem.wind, problem.gear_ratio, grid),
           .band = problem.rms_band}};
}

// The same goals on the model, by nothing of the measured tuner's but FeasibleSearch.
std::vector<double> tuned_on_model(const MeasuredProblem& problem, const LoopStructure& structure,
                                   const std::vector<double>& start) {
  auto evaluator = model_evaluator(problem);
  ConstrainedProblem search;
  for (const auto& gain : gain_descriptions(structure)) {
    search.lower.push_back(std::log(gain.lower));
    search.upper.push_back(std::log(gain.upper));
  }
  search.constraints = 10;
  search.evaluate = [&](const std::vector<double>& point, ConstrainedValues& values) {
    control::Controller controller{structure, point};
    for (double& gain : controller.gains) gain = std::exp(gain);
    const auto evaluation = evaluator.evaluate(controller, true);
    if (!evaluation.stable()) return false;
    const std::size_t size = point.size();
    std::ranges::fill(values.constraints, -1.0);
    std::ranges::fill(values.constraint_gradients, 0.0);
    values.objectives[0] = std::log(evaluation.boresight_variance());
    values.constraints[9] = std::log(evaluation.effort_variance / 0.36);
    for (std::size_t k = 0; k < size; ++k) {
      values.objective_gradients[k] =
          (evaluation.wind_log_gradient[k] + evaluation.noise_log_gradient[k]) /
          evaluation.boresight_variance();
      values.constraint_gradients[9 * size + k] =
          evaluation.effort_log_gradient[k] / evaluation.effort_variance;
    }
    for (std::size_t b = 0; b < 3; ++b) {
      for (std::size_t j = 0; j < evaluation.peaks[b].size(); ++j) {
        const auto& peak = evaluation.peaks[b][j];
        values.constraints[3 * b + j] = std::log(peak.magnitude / 2.0);
        std::copy_n(
            peak.log_gradient.begin(), size,
            values.constraint_gradients.begin() + static_cast<std::ptrdiff_t>((3 * b + j) * size));
      }
    }
    return true;
  };
  FeasibleSearch feasible(search);
  std::vector<double> point(start.size());
  std::ranges::transform(start, point.begin(), [](double gain) { return std::log(0.8 * gain); });
  for (std::size_t k = 0; k < point.size(); ++k) {
    point[k] = std::clamp(point[k], search.lower[k], search.upper[k]);
  }
  feasible.search_from(point);
  if (!feasible.best()) return {};
  point = feasible.best()->point;
  for (double& gain : point) gain = std::exp(gain);
  return point;
}

TEST(MeasuredTuning, IsTheModelsTuningWhereTheMeasurementIsGood) {
  const auto& structure = LoopStructure::pi_with_lag();
  const MeasuredProblem problem = measured_problem(0.9999, 1, 0.02, 25.0, 1000.0);
  MeasuredTuningOptions options;
  options.confidence = 0.0;
  options.starts = 12;
  const auto result = tune(problem, structure, {}, options);
  EXPECT_EQ(result.status, MeasuredTuningStatus::confident);
  EXPECT_TRUE(result.verification.passed) << result.verification.failure;
  const auto gains = tuned_on_model(problem, structure, result.controller.gains);
  ASSERT_EQ(gains.size(), result.controller.gains.size());
  for (std::size_t k = 0; k < gains.size(); ++k) {
    EXPECT_NEAR(result.controller.gains[k], gains[k], 0.01 * gains[k]) << structure.gains()[k].name;
  }
  auto model = model_evaluator(problem);
  const double rms = std::sqrt(model.evaluate({structure, gains}, false).boresight_variance());
  EXPECT_NEAR(result.rms, rms, 0.005 * rms);
  // Where the tuner says that the rms stands on what was not measured.
  EXPECT_GT(result.wind_fraction.below, 0.01);
  EXPECT_LT(result.wind_fraction.total(), 0.1);
  EXPECT_NEAR(result.by_stiffness, -1.07, 0.05);
}

// Goals that hold within the confidence hold for the truth, at a price.
TEST(MeasuredTuning, KeepsItsGoalsOnTheTruePlant) {
  for (const std::uint64_t seed : {1, 2}) {
    const MeasuredProblem problem = measured_problem(0.99, seed, 0.05, 10.0);
    MeasuredTuningOptions options;
    options.starts = 4;
    const auto result = tune(problem, LoopStructure::pi_with_lag(), {}, options);
    EXPECT_EQ(result.status, MeasuredTuningStatus::confident) << result.verification.failure;
    EXPECT_GT(result.rms, result.nominal_rms);
    EXPECT_LT(result.rms, 1.3 * result.nominal_rms);
    EXPECT_LT(result.verification.largest_error, 0.5);
    for (const auto& peak : result.verification.peaks) {
      EXPECT_GT(peak.within_confidence.magnitude, peak.measured.magnitude);
      EXPECT_LE(peak.within_confidence.magnitude, 2.004);
    }
    auto model = model_evaluator(problem);
    const auto truth = model.evaluate(result.controller, false);
    EXPECT_TRUE(control::stability(reference::antenna(), result.controller, problem.delay,
                                   model.response().frequency)
                    .stable());
    for (const auto loop_break : control::loop_breaks) {
      EXPECT_LT(truth.highest_peak(loop_break), 2.0) << to_string(loop_break);
    }
    EXPECT_NEAR(std::sqrt(truth.boresight_variance()), result.rms, 0.05 * result.rms);
  }
}

TEST(MeasuredTuning, KnowsNoUnitsOfTorque) {
  const auto plant = reference::antenna();
  auto measured = reference::measured_plant(plant, bins(60.0, 0.05, 10.0), 0.999, 9.0);
  const auto oil = reference::oil_spring(plant);
  MeasuredTuningOptions options;
  options.starts = 2;
  const auto tuned = [&](const control::MeasuredPlant& plant_measured, double unit) {
    MeasuredProblem problem = problem_of(
        {plant_measured, {oil.stiffness * unit, oil.loss_rate}, plant.drive.tachometer_corner});
    problem.gear_ratio /= unit;  // the wind's torque at the shaft in that unit
    return tune(problem, LoopStructure::pi_with_lag(), {}, options);
  };
  const auto result = tuned(measured, 1.0);
  constexpr double unit = 8.0;
  measured.motor_torque *= unit;
  for (auto& covariance : measured.covariance) {
    covariance.row(1) *= unit;
    covariance.col(1) *= unit;
  }
  const auto scaled = tuned(measured, unit);
  EXPECT_NEAR(scaled.rms, result.rms, 1e-9 * result.rms);
  for (std::size_t k = 0; k < result.controller.gains.size(); ++k) {
    EXPECT_NEAR(scaled.controller.gains[k], result.controller.gains[k],
                1e-4 * result.controller.gains[k]);
  }
}

// From a chirp of the nonlinear antenna in motion, noise and all, to a controller that holds on its
// small-signal model there.
TEST(MeasuredTuning, TunesFromAChirpOfTheNonlinearAntenna) {
  const auto antenna = reference::nonlinear_antenna();
  const auto system = plant::to_feedback_system(antenna);
  const auto point = plant::trim(antenna, {14.0, 0.0, {}});
  constexpr double step = 0.01, settle = 8.0, length = 90.0, lowest = 0.05, highest = 10.0;
  const auto samples = static_cast<Eigen::Index>((settle + length + 2.0) / step) + 1;
  plant::SimulationPlan plan;
  plan.interval = step;
  plan.state = point.state;
  plan.signals = {"valve_command"};
  plan.values.resize(samples, 1);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double into = std::clamp(step * static_cast<double>(k) - settle, 0.0, length);
    const double octaves = std::log(highest / lowest);
    const double cycles = lowest * length / octaves * std::expm1(octaves * into / length);
    const bool on = into > 0.0 && into < length;
    plan.values(k, 0) = point.input[0] + (on ? 3.0 * std::sin(two_pi * cycles) : 0.0);
  }
  const auto run = plant::simulate(system, plan);
  Eigen::MatrixXd recorded(samples, 3);
  recorded << column(run, "tachometer"), column(run, "motor_torque"), column(run, "encoder");
  const TrackingProblem reference = reference::tracking_problem();
  const numerics::NormalNumbers numbers(5);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const auto first = numbers.pair(static_cast<std::uint64_t>(2 * k));
    recorded(k, 0) += reference.noise.tachometer_rms * first.real();
    recorded(k, 1) += 0.5 * first.imag();
    recorded(k, 2) +=
        reference.noise.encoder_rms * numbers.pair(static_cast<std::uint64_t>(2 * k + 1)).real();
  }
  const auto estimate = identification::local_polynomial_response(plan.values.col(0), recorded,
                                                                  step, {lowest, highest});
  control::MeasuredPlant measured;
  measured.frequency = two_pi * estimate.frequency.array();
  measured.tachometer = estimate.response.col(0);
  measured.motor_torque = estimate.response.col(1);
  measured.encoder = estimate.response.col(2);
  for (const auto& covariance : estimate.covariance) measured.covariance.emplace_back(covariance);
  measured.degrees_of_freedom = static_cast<double>(estimate.degrees_of_freedom);
  measured.coherence = estimate.coherence;
  const MeasuredProblem problem = problem_of(
      {measured, reference::oil_spring(reference.plant), reference.plant.drive.tachometer_corner});
  // Slope of the friction curve at that speed; the whole's inertia.
  EXPECT_NEAR(problem.channels.low_end_friction(), 2.075, 0.1);
  EXPECT_NEAR(problem.channels.low_end_inertia(), plant::reflected_inertia(reference.plant), 0.05);
  EXPECT_FALSE(problem.channels.encoder_assumed().empty());

  const auto truth = plant::linearise(system, point.state, point.input);
  const auto response = [&](double w) {
    const auto all = numerics::transfer_matrix(truth.a, truth.b, truth.c, truth.d, {0.0, w});
    const auto output = [&](const char* name) { return all(plant::output_index(truth, name), 0); };
    plant::ResponsePoint found;
    found.tachometer_command = output("tachometer");
    found.torque_command = output("motor_torque");
    found.encoder_command = output("encoder");
    return found;
  };
  for (const auto* structure :
       {&LoopStructure::pi_with_lag(), &LoopStructure::pressure_feedback()}) {
    MeasuredTuningOptions options;
    options.starts = 4;
    options.rounds = 4;
    const auto result = tune(problem, *structure, {}, options);
    EXPECT_EQ(result.status, MeasuredTuningStatus::confident) << result.verification.failure;
    // Peaks and encirclements on the truth, from far below to far above what was measured.
    const Eigen::ArrayXd grid = measured_grid(problem, 100, false);
    control::LoopEvaluator exact(control::sampled_on(grid, response),
                                 {.delay = problem.delay,
                                  .noise = problem.noise,
                                  .wind_spectrum = Eigen::ArrayXd::Zero(grid.size())});
    const auto evaluation = exact.evaluate(result.controller, false);
    EXPECT_TRUE(evaluation.stable());
    for (const auto loop_break : control::loop_breaks) {
      EXPECT_LT(evaluation.highest_peak(loop_break), 2.1) << to_string(loop_break);
    }
  }
}

TEST(MeasuredTuning, SaysWhereTheMeasurementEndsTooEarly) {
  // The gain of this controller is still above 1 at 0.5 Hz.
  const MeasuredProblem problem = measured_problem(0.9999, 1, 0.02, 0.5);
  control::Controller controller{LoopStructure::pi(), {}};
  for (const auto& gain : controller.structure.gains()) controller.gains.push_back(gain.lower);
  controller.gains[0] = 2.0;
  const auto verification = verify(problem, controller, {}, 1.0);
  EXPECT_FALSE(verification.passed);
  EXPECT_THAT(verification.failure, HasSubstr("lies beyond it"));
  EXPECT_GT(verification.gain_at_highest[0], 1.0);
}

TEST(MeasuredTuning, FindsUnstableLoopsUnstableAsEigenvaluesDo) {
  const MeasuredProblem problem = measured_problem(1.0, 1, 0.02, 25.0);
  const Eigen::ArrayXd grid = measured_grid(problem, 100, false);
  reference::RandomNumbers random(3);
  const auto& structure = LoopStructure::pressure_feedback();
  int stable = 0, seen = 0;
  for (int trial = 0; trial < 30; ++trial) {
    control::Controller controller{structure, {}};
    for (const auto& gain : structure.gains()) {
      controller.gains.push_back(random.log_uniform(gain.lower, gain.upper));
    }
    const auto verdict = control::stability(reference::antenna(), controller, problem.delay, grid);
    const auto verification = verify(problem, controller, {{100.0, 100.0, 100.0}, 1.0}, 0.0);
    const double top = std::max(verification.gain_at_highest[0], verification.gain_at_highest[1]);
    if (top > 0.9 || !verification.open_steps.empty() || verdict.dead_time_residue > 0.9) continue;
    ++seen;
    stable += verdict.stable() ? 1 : 0;
    EXPECT_EQ(verification.unstable[0] == 0, verdict.rate_loop_abscissa < 0.0) << trial;
    EXPECT_EQ(verification.unstable[1] == 0, verdict.closed_loop_abscissa < 0.0) << trial;
  }
  EXPECT_GT(stable, 2);
  EXPECT_LT(stable, seen - 2);
}

TEST(MeasuredTuning, StatesGoalsThatCannotBeMet) {
  const MeasuredProblem problem = measured_problem(0.9999, 1, 0.05, 10.0);
  MeasuredConstraints goals;
  goals.sensitivity_peak = {1.01, 1.01, 1.01};
  MeasuredTuningOptions options;
  options.starts = 2;
  const auto result = tune(problem, LoopStructure::pi(), goals, options);
  EXPECT_EQ(result.status, MeasuredTuningStatus::infeasible);
  EXPECT_FALSE(result.verification.passed);
  EXPECT_FALSE(result.active_constraints.empty());
}

TEST(MeasuredTuning, RefusesWhatMakesNoSense) {
  const MeasuredProblem problem = measured_problem(0.9999, 1, 0.05, 10.0);
  const auto message = [&](const MeasuredConstraints& goals, const MeasuredTuningOptions& options) {
    try {
      tune(problem, LoopStructure::pi(), goals, options);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  MeasuredTuningOptions none;
  none.starts = 0;
  EXPECT_THAT(message({}, none), HasSubstr("at least 1 start"));
  EXPECT_THAT(message({{2.0, 1.0, 2.0}, 0.6}, {}), HasSubstr("sensitivity peaks above 1"));
  MeasuredTuningOptions sure;
  sure.confidence = 1.0;
  EXPECT_THAT(message({}, sure), HasSubstr("confidence from 0 to below 1"));
}

}  // namespace
}  // namespace boresight::design
