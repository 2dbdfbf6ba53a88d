// The evaluator on frequencies of its own choice: accurate for every controller, whatever its
// damping.
#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include "peer_loop.hpp"
#include "refused_call.hpp"
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/vector_clones.hpp>

namespace boresight::control {
namespace {

using reference::PeerGains;
using reference::relative_error;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Eigen::Index modes = 5;

PeerGains random_gains(reference::RandomNumbers& random) {
  const auto near = [&](double gain) { return random.log_uniform(0.1 * gain, 10.0 * gain); };
  const double rate = near(0.2), rate_integral = near(1.2), position = near(0.3);
  return {rate, rate_integral, position, near(0.03)};
}

PeerGains stable_gains(reference::RandomNumbers& random) {
  while (true) {
    const PeerGains gains = random_gains(random);
    if (numerics::spectral_abscissa(reference::peer_closed_loop(modes, gains).a) < 0.0)
      return gains;
  }
}

// The first mode, 1.75 Hz, which wind, motor and beam all see.
constexpr Eigen::Index light_mode = 0;
constexpr double light_damping = 1e-3;

double exact_rms(const PeerGains& gains, bool light) {
  auto system = reference::peer_modal_system(modes, gains);
  if (light) system.modes.damping_ratio[light_mode] = light_damping;
  SpectralRmsOptions options;
  options.relative_tolerance = 1e-12;
  return spectral_rms(plant::ModalResponse(system, "n", "y"), options).rms;
}

LoopEvaluator evaluator_of(bool light) {
  auto shape = reference::peer_modes(modes);
  if (light) shape.damping_ratio[light_mode] = light_damping;
  return {
      reference::PeerChannels(shape),
      {.wind_spectrum = reference::peer_wind_spectrum, .quadrature = reference::peer_quadrature()}};
}

TEST(LoopPanels, HaveTheRmsOfFortyStableControllersToAMillionth) {
  for (const bool light : {false, true}) {
    reference::RandomNumbers random(211);
    LoopEvaluator evaluator = evaluator_of(light);
    int compared = 0;
    double largest_fraction = 0.0;
    while (compared < 40) {
      const PeerGains gains = stable_gains(random);
      const auto found = evaluator.evaluate(reference::peer_controller(gains), false);
      if (light && found.unstable_closed_loop != 0) continue;
      ASSERT_EQ(found.unstable_closed_loop, 0);
      const double rms = exact_rms(gains, light);
      EXPECT_LT(relative_error(reference::peer_rms(found.wind_variance), rms), 1e-7);
      if (light) largest_fraction = std::max(largest_fraction, rms / exact_rms(gains, false) - 1.0);
      ++compared;
    }
    EXPECT_EQ(largest_fraction > 0.01, light);  // it is excited
  }
}

TEST(LoopPanels, HaveTheRmsOfLyapunovsEquation) {
  reference::RandomNumbers random(212);
  LoopEvaluator evaluator = evaluator_of(false);
  for (int trial = 0; trial < 10; ++trial) {
    const PeerGains gains = stable_gains(random);
    const auto closed = reference::channel(reference::peer_closed_loop(modes, gains), "n", "y");
    const auto solution = solve_lyapunov(closed.a, closed.b * closed.b.transpose());
    const double rms = std::sqrt((closed.c * solution.covariance * closed.c.transpose())(0, 0));
    const auto found = evaluator.evaluate(reference::peer_controller(gains), false);
    EXPECT_LT(relative_error(reference::peer_rms(found.wind_variance), rms), 1e-7);
  }
}

TEST(LoopPanels, HaveTheGradientsOfTheExactRms) {
  for (const bool light : {false, true}) {
    reference::RandomNumbers random(213);
    LoopEvaluator evaluator = evaluator_of(light);
    for (int trial = 0; trial < 8; ++trial) {
      const PeerGains gains = stable_gains(random);
      const Controller controller = reference::peer_controller(gains);
      const auto found = evaluator.evaluate(controller, true);
      if (found.unstable_closed_loop != 0) continue;
      for (std::size_t k = 0; k < controller.gains.size(); ++k) {
        const auto by = [&](double step) {
          const auto log_variance = [&](double shift) {
            std::vector<double> g = controller.gains;
            g[k] *= std::exp(shift);
            return 2.0 * std::log(exact_rms({g[0], g[0] * g[1], g[2], g[2] * g[3]}, light));
          };
          return (log_variance(step) - log_variance(-step)) / (2.0 * step);
        };
        // Extrapolated to no step from three.
        const double one = by(4e-3), half = by(2e-3), quarter = by(1e-3);
        const double slope =
            (16.0 * (4.0 * quarter - half) / 3.0 - (4.0 * half - one) / 3.0) / 15.0;
        EXPECT_NEAR(found.wind_log_gradient[k] / found.wind_variance, slope, 1e-6);
      }
    }
  }
}

TEST(LoopPanels, CountTheUnstablePolesThatEigenvaluesFind) {
  reference::RandomNumbers random(214);
  LoopEvaluator evaluator = evaluator_of(false);
  int unstable = 0;
  for (int trial = 0; trial < 200; ++trial) {
    PeerGains gains = random_gains(random);
    const auto eigenvalues = numerics::eigenvalues(reference::peer_closed_loop(modes, gains).a);
    int expected = 0;
    for (const auto pole : eigenvalues) expected += pole.real() > 0.0 ? 1 : 0;
    EXPECT_EQ(evaluator.evaluate(reference::peer_controller(gains), false).unstable_closed_loop,
              expected);
    unstable += expected > 0 ? 1 : 0;
  }
  EXPECT_GT(unstable, 20);
  EXPECT_LT(unstable, 180);
}

TEST(LoopPanels, SeePolesThatBarelyCrossTheAxis) {
  // The rate gain at which the first poles cross, from eigenvalues, and a millionth to either side.
  const auto abscissa = [](double rate) {
    return numerics::spectral_abscissa(
        reference::peer_closed_loop(modes, {rate, 1.8, 0.45, 0.06}).a);
  };
  double stable = 0.3, unstable = 30.0;
  ASSERT_LT(abscissa(stable), 0.0);
  ASSERT_GT(abscissa(unstable), 0.0);
  while (unstable / stable > 1.0 + 1e-12) {
    const double middle = std::sqrt(stable * unstable);
    (abscissa(middle) < 0.0 ? stable : unstable) = middle;
  }
  LoopEvaluator evaluator = evaluator_of(false);
  const auto count = [&](double rate) {
    return evaluator.evaluate(reference::peer_controller({rate, 1.8, 0.45, 0.06}), false)
        .unstable_closed_loop;
  };
  EXPECT_EQ(count(stable * (1.0 - 1e-6)), 0);
  EXPECT_EQ(count(stable * (1.0 + 1e-6)), 2);
}

TEST(LoopPanels, HaveThePeakOfTheHamiltonian) {
  reference::RandomNumbers random(215);
  LoopEvaluator evaluator = evaluator_of(false);
  for (int trial = 0; trial < 20; ++trial) {
    const PeerGains gains = stable_gains(random);
    const auto peak =
        peak_gain(reference::channel(reference::peer_closed_loop(modes, gains), "d", "u"));
    const auto found = evaluator.evaluate(reference::peer_controller(gains), false);
    EXPECT_LT(relative_error(found.highest_peak(LoopBreak::valve_command), peak.lower), 1e-7);
  }
}

LoopQuadrature reference_quadrature() {
  LoopQuadrature quadrature;
  quadrature.analysis = {1e-4, 100.0};
  quadrature.band = {1e-4, 25.0};
  return quadrature;
}

LoopEvaluator antenna_evaluator(const LoopQuadrature& quadrature) {
  return {plant::PointResponse(reference::antenna()),
          {.delay = reference::delay,
           .noise = reference::sensor_noise(),
           .wind_spectrum = reference::motor_wind_spectrum,
           .quadrature = quadrature}};
}

TEST(LoopPanels, OfTheReferenceAntennaAgreeWithMuchFinerOnes) {
  LoopEvaluator evaluator = antenna_evaluator(reference_quadrature());
  LoopQuadrature fine_quadrature = reference_quadrature();
  fine_quadrature.tolerance = 1e-14;
  fine_quadrature.channel_tolerance = 1e-4;
  fine_quadrature.widest_panel = 0.7;
  LoopEvaluator fine = antenna_evaluator(fine_quadrature);
  evaluator.look_at_gusts(true);
  fine.look_at_gusts(true);
  reference::RandomNumbers random(216);
  for (const auto& structure : reference::loop_structures()) {
    for (int trial = 0; trial < 6; ++trial) {
      Controller controller;
      LoopEvaluation expected;
      do {
        controller = reference::random_controller(random, structure);
        expected = fine.evaluate(controller, true);
      } while (!expected.stable());
      const auto found = evaluator.evaluate(controller, true);
      EXPECT_TRUE(found.stable());
      // Of a variance to 2e-6, of the rms to 1e-6.
      EXPECT_LT(relative_error(found.boresight_variance(), expected.boresight_variance()), 1e-7);
      EXPECT_LT(relative_error(found.wind_variance, expected.wind_variance), 2e-6);
      EXPECT_LT(relative_error(found.noise_variance, expected.noise_variance), 2e-6);
      EXPECT_LT(relative_error(found.effort_variance, expected.effort_variance), 2e-6);
      EXPECT_LT(relative_error(found.wind_demand_variance, expected.wind_demand_variance), 2e-6);
      EXPECT_LT(relative_error(found.wind_torque_variance, expected.wind_torque_variance), 2e-6);
      for (std::size_t k = 0; k < controller.gains.size(); ++k) {
        const double boresight = found.wind_log_gradient[k] + found.noise_log_gradient[k];
        EXPECT_NEAR(boresight, expected.wind_log_gradient[k] + expected.noise_log_gradient[k],
                    1e-6 * expected.boresight_variance());
        EXPECT_NEAR(found.effort_log_gradient[k], expected.effort_log_gradient[k],
                    1e-6 * expected.effort_variance);
      }
      for (const LoopBreak loop_break : loop_breaks) {
        EXPECT_LT(relative_error(found.highest_peak(loop_break), expected.highest_peak(loop_break)),
                  1e-6);
      }
    }
  }
}

std::vector<double> numbers(const LoopEvaluation& evaluation) {
  std::vector<double> all{evaluation.wind_variance,
                          evaluation.noise_variance,
                          evaluation.effort_variance,
                          evaluation.wind_demand_variance,
                          evaluation.wind_torque_variance,
                          static_cast<double>(evaluation.unstable_rate_loop),
                          static_cast<double>(evaluation.unstable_closed_loop)};
  for (const auto* gradient :
       {&evaluation.wind_log_gradient, &evaluation.noise_log_gradient,
        &evaluation.effort_log_gradient, &evaluation.wind_demand_log_gradient,
        &evaluation.wind_torque_log_gradient}) {
    all.insert(all.end(), gradient->begin(), gradient->end());
  }
  for (const PeakList& peaks : evaluation.peaks) {
    for (const SensitivityPeak& peak : peaks) {
      all.insert(all.end(), {peak.frequency, peak.magnitude});
      all.insert(all.end(), peak.log_gradient.begin(), peak.log_gradient.end());
    }
  }
  return all;
}

TEST(LoopPanels, HaveTheSameBitsInRegistersOfEveryWidth) {
  reference::RandomNumbers random(223);
  for (const auto& structure : reference::loop_structures()) {
    for (int i = 0; i < 5; ++i) {
      const Controller controller = reference::random_controller(random, structure);
      std::vector<std::vector<double>> found;
      for (const std::size_t lanes : {2U, 4U, 8U}) {
        const numerics::NarrowRegisters narrow(lanes);
        LoopEvaluator evaluator = antenna_evaluator(reference_quadrature());
        evaluator.look_at_gusts(true);
        found.push_back(numbers(evaluator.evaluate(controller, true)));
      }
      EXPECT_EQ(found[1], found[0]) << structure.name();
      EXPECT_EQ(found[2], found[0]) << structure.name();
    }
  }
}

TEST(LoopPanels, AgreeWithTheTrapezoidRuleOnAGridOfThousands) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-4, 25.0, 6000);
  LoopEvaluator trapezoid(plant, w,
                          {.delay = reference::delay,
                           .noise = reference::sensor_noise(),
                           .wind_spectrum = (w / two_pi).unaryExpr([](double f) {
                             return reference::motor_wind_spectrum(f);
                           })});
  LoopEvaluator panels = antenna_evaluator(reference_quadrature());
  reference::RandomNumbers random(217);
  for (const auto& structure : reference::loop_structures()) {
    const Controller controller = reference::sound_controller(random, panels, structure, 2.5);
    const auto found = panels.evaluate(controller, false),
               expected = trapezoid.evaluate(controller, false);
    EXPECT_LT(relative_error(found.wind_variance, expected.wind_variance), 1e-5);
    EXPECT_LT(relative_error(found.noise_variance, expected.noise_variance), 1e-5);
    EXPECT_LT(relative_error(found.effort_variance, expected.effort_variance), 1e-5);
  }
}

TEST(LoopPanels, StandOnTheTopOfEveryPeak) {
  LoopEvaluator evaluator = antenna_evaluator(reference_quadrature());
  const plant::PointResponse exact(reference::antenna());
  reference::RandomNumbers random(220);
  for (const auto& structure : reference::loop_structures()) {
    for (int trial = 0; trial < 40; ++trial) {
      const Controller controller = reference::sound_controller(random, evaluator, structure, 3.0);
      const auto found = evaluator.evaluate(controller, false);
      for (std::size_t b = 0; b < loop_breaks.size(); ++b) {
        if (found.peaks[b].empty()) continue;
        const SensitivityPeak& peak = found.peaks[b].front();
        double highest = 0.0;
        for (int k = -40; k <= 40; ++k) {
          const double w = peak.frequency * std::exp(2.5e-4 * k);
          const auto gain = loop_gain(exact(w), w, controller, reference::delay, loop_breaks[b]);
          highest = std::max(highest, 1.0 / std::abs(1.0 + gain));
        }
        EXPECT_LT(highest, peak.magnitude * (1.0 + 5e-9))
            << to_string(structure) << ", " << to_string(loop_breaks[b]);
      }
    }
  }
}

TEST(LoopPanels, GiveTheSameWhateverWasEvaluatedBefore) {
  reference::RandomNumbers random(218);
  LoopEvaluator evaluator = antenna_evaluator(reference_quadrature());
  const Controller controller = reference::random_controller(random, LoopStructure::full());
  const auto first = evaluator.evaluate(controller, true);
  const std::size_t frequencies = evaluator.frequencies_used();
  for (int i = 0; i < 1500; ++i) {
    evaluator.evaluate(reference::random_controller(random, LoopStructure::pressure_feedback()),
                       false);
  }
  const auto again = evaluator.evaluate(controller, true);
  EXPECT_EQ(first.boresight_variance(), again.boresight_variance());
  EXPECT_EQ(first.wind_log_gradient, again.wind_log_gradient);
  EXPECT_EQ(first.effort_log_gradient, again.effort_log_gradient);
  EXPECT_EQ(first.highest_peak(LoopBreak::position_loop),
            again.highest_peak(LoopBreak::position_loop));
  EXPECT_EQ(evaluator.frequencies_used(), frequencies);
}

TEST(LoopPanels, StateTheirFrequenciesAndWeights) {
  LoopEvaluator evaluator = antenna_evaluator(reference_quadrature());
  const Eigen::ArrayXd& w = evaluator.response().frequency;
  ASSERT_EQ(w.size(), evaluator.integration_weight().size());
  EXPECT_TRUE((w.tail(w.size() - 1) > w.head(w.size() - 1)).all());
  // The weights add to the band in Hz, and integrate what the loop lets through.
  EXPECT_LT(relative_error(evaluator.integration_weight().sum(), 25.0 - 1e-4), 1e-6);
  const plant::PointResponse exact(reference::antenna());
  EXPECT_LT(
      relative_error(evaluator.response().boresight_command[40], exact(w[40]).boresight_command),
      1e-12);
  reference::RandomNumbers random(219);
  const Controller controller =
      reference::sound_controller(random, evaluator, LoopStructure::pi_with_lag(), 2.0);
  const double variance =
      (evaluator.integration_weight() * evaluator.wind_transmission(controller) *
       (w / two_pi).unaryExpr([](double f) {
         return reference::motor_wind_spectrum(f);
       })).sum();
  EXPECT_LT(relative_error(variance, evaluator.evaluate(controller, false).wind_variance), 1e-3);
}

TEST(LoopPanels, IntegrateOverTheirBandOnlyAndBandsAdd) {
  const Controller controller{LoopStructure::pi(), {0.25, 1.0, 0.4, 0.06}};
  const auto over = [&](FrequencyBand band) {
    LoopQuadrature quadrature = reference_quadrature();
    quadrature.band = band;
    return antenna_evaluator(quadrature).evaluate(controller, false);
  };
  const auto all = over({1e-4, 25.0}), low = over({1e-4, 0.3}), high = over({0.3, 25.0});
  EXPECT_LT(relative_error(low.wind_variance + high.wind_variance, all.wind_variance), 1e-9);
  EXPECT_LT(relative_error(low.noise_variance + high.noise_variance, all.noise_variance), 1e-9);
}

TEST(LoopPanels, TakeTheDensityBelowTheirBandForConstant) {
  // Where nothing happens any more, another decade of panels makes no difference.
  const PeerGains gains;
  const auto from = [&](double lowest) {
    LoopQuadrature quadrature = reference::peer_quadrature();
    quadrature.analysis.lowest = lowest;
    LoopEvaluator evaluator(
        reference::PeerChannels(modes),
        {.wind_spectrum = reference::peer_wind_spectrum, .quadrature = quadrature});
    const auto found = evaluator.evaluate(reference::peer_controller(gains), true);
    EXPECT_LT(relative_error(evaluator.integration_weight().sum(), quadrature.analysis.highest),
              1e-6);
    return found;
  };
  const auto near = from(1e-5), far = from(1e-6);
  EXPECT_LT(relative_error(near.wind_variance, far.wind_variance), 1e-7);
  EXPECT_NEAR(near.wind_log_gradient[2], far.wind_log_gradient[2], 1e-6 * far.wind_variance);
}

TEST(LoopPanels, RefuseBandsAndTolerancesThatMakeNoSense) {
  const auto made_with = [](const std::function<void(LoopQuadrature&)>& change) {
    LoopQuadrature quadrature = reference_quadrature();
    change(quadrature);
    return antenna_evaluator(quadrature).frequencies_used();
  };
  EXPECT_THAT(reference::Call([&] { made_with([](auto& q) {
                                      q.analysis = {0.0, 1.0};
                                    }); }),
              ThrowsMessage<InvalidInput>(HasSubstr("0 < lowest < highest, found 0 and 1 Hz")));
  EXPECT_THAT(reference::Call([&] { made_with([](auto& q) {
                                      q.analysis = {2.0, 1.0};
                                    }); }),
              ThrowsMessage<InvalidInput>(HasSubstr("analysis band")));
  EXPECT_THAT(reference::Call([&] { made_with([](auto& q) {
                                      q.band = {200.0, 300.0};
                                    }); }),
              ThrowsMessage<InvalidInput>(HasSubstr("meets the analysis band")));
  EXPECT_THAT(reference::Call([&] { made_with([](auto& q) { q.tolerance = 0.0; }); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive tolerances")));
  EXPECT_THAT(reference::Call([&] { made_with([](auto& q) { q.widest_panel = -1.0; }); }),
              ThrowsMessage<InvalidInput>(HasSubstr("positive tolerances")));
  const auto in_no_wind = [] {
    return LoopEvaluator(plant::PointResponse(reference::antenna()),
                         {.delay = reference::delay,
                          .wind_spectrum = [](double) { return std::nan(""); },
                          .quadrature = reference_quadrature()});
  };
  EXPECT_THAT(reference::Call([&] { in_no_wind(); }),
              ThrowsMessage<NumericalFailure>(HasSubstr("not finite at")));
}

}  // namespace
}  // namespace boresight::control
