#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/reference_loop.hpp"
#include "refused_call.hpp"
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/loop_evaluator.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control {
namespace {

using reference::relative_error;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;

const std::vector<LoopStructure> structures = reference::loop_structures();

TEST(LoopGain, OfTheBreaksIsOneLoopCutAtThreePlaces) {
  reference::RandomNumbers random(121);
  const auto plant = reference::antenna();
  for (const auto& structure : structures) {
    const Controller controller = reference::random_controller(random, structure);
    const double w = random.log_uniform(0.01, 100.0);
    const plant::PointResponse response(plant);
    const auto at = [&](LoopBreak loop_break) {
      return loop_gain(response(w), w, controller, reference::delay, loop_break);
    };
    const auto compensator = compensator_response(controller, w);
    const Complex dead_time = std::exp(Complex{0.0, -w * reference::delay});
    const Complex rate = dead_time * (compensator.rate * response(w).tachometer_command +
                                      compensator.pressure * response(w).torque_command);
    EXPECT_LT(relative_error(at(LoopBreak::rate_loop_alone), rate), 1e-13);
    // 1 + L_valve = (1 + L_rate)(1 + L_position).
    EXPECT_LT(relative_error(1.0 + at(LoopBreak::valve_command),
                             (1.0 + rate) * (1.0 + at(LoopBreak::position_loop))),
              1e-12);
  }
}

TEST(LoopGain, TakesDeadTimeExactly) {
  // Each further second of dead time turns the loop by w and changes no gain.
  const auto plant = reference::antenna();
  const Controller controller{LoopStructure::pi(), {0.5, 1.0, 0.4, 0.06}};
  for (const double w : {0.1, 5.0, 150.0}) {
    const plant::PointResponse response(plant);
    const auto loop_break = LoopBreak::rate_loop_alone;
    const Complex without = loop_gain(response(w), w, controller, 0.0, loop_break);
    const Complex with = loop_gain(response(w), w, controller, 0.7, loop_break);
    EXPECT_LT(relative_error(with / without, std::exp(Complex{0.0, -0.7 * w})), 1e-12);
  }
}

TEST(WindTransmission, IsThatOfTheClosedLoopsStateSpace) {
  reference::RandomNumbers random(122);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant, 20);
  for (const auto& structure : structures) {
    const Controller controller = reference::sound_controller(random, evaluator, structure, 2.5);
    const auto loop = closed_loop(plant, controller, reference::delay);
    const Eigen::ArrayXd found = evaluator.wind_transmission(controller);
    const Eigen::ArrayXd& w = evaluator.response().frequency;
    for (Eigen::Index i = 0; i < w.size(); i += 7) {
      if (w[i] > 60.0) break;  // where the rational dead time is exact to 1e-10
      const Complex wind = plant::frequency_response(loop, w[i])(
          plant::output_index(loop, "beam"), plant::input_index(loop, "wind_torque"));
      EXPECT_LT(relative_error(found[i], std::norm(wind)), 1e-7) << w[i];
    }
  }
}

TEST(LoopEvaluation, HasTheVariancesOfABruteForceIntegral) {
  reference::RandomNumbers random(123);
  const auto plant = reference::antenna();
  auto coarse = reference::loop_evaluator(plant, 300);
  auto fine = reference::loop_evaluator(plant, 6000);
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 10; ++trial) {
      const Controller controller = reference::sound_controller(random, coarse, structure, 3.0);
      const auto found = coarse.evaluate(controller, false),
                 expected = fine.evaluate(controller, false);
      ASSERT_TRUE(found.stable());
      EXPECT_LT(relative_error(found.wind_variance, expected.wind_variance), 1e-4);
      EXPECT_LT(relative_error(found.noise_variance, expected.noise_variance), 1e-4);
      EXPECT_LT(relative_error(found.effort_variance, expected.effort_variance), 1e-4);
    }
  }
}

TEST(LoopEvaluation, HasTheVariancesOfLyapunovEquations) {
  reference::RandomNumbers random(124);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant);
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 5; ++trial) {
      const Controller controller = reference::sound_controller(random, evaluator, structure, 2.5);
      const auto found = evaluator.evaluate(controller, false);
      const auto expected = lyapunov_rms(plant, controller, reference::delay,
                                         reference::wind_filter(6), reference::sensor_noise());
      EXPECT_LT(relative_error(std::sqrt(found.wind_variance), expected.wind), 5e-3);
      EXPECT_LT(relative_error(std::sqrt(found.noise_variance), expected.noise), 5e-3);
      EXPECT_LT(relative_error(std::sqrt(found.boresight_variance()), expected.total), 5e-3);
    }
  }
}

TEST(LoopEvaluation, IntegratesOverItsBandOnlyAndBandsAdd) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-3, 25.0, 60);
  const Eigen::ArrayXd wind = 1.0 / w;
  const Controller controller{LoopStructure::pi(), {0.25, 1.0, 0.4, 0.06}};
  const double middle = w[w.size() / 2] / two_pi;
  const auto over = [&](FrequencyBand band) {
    LoopEvaluator evaluator(plant, w,
                            {.delay = reference::delay,
                             .noise = reference::sensor_noise(),
                             .wind_spectrum = wind,
                             .band = band});
    return evaluator.evaluate(controller, false);
  };
  const auto all = over({}), low = over({0.0, middle}), high = over({middle, 25.0});
  EXPECT_LT(relative_error(low.wind_variance + high.wind_variance, all.wind_variance), 1e-12);
  EXPECT_LT(relative_error(low.noise_variance + high.noise_variance, all.noise_variance), 1e-12);
  EXPECT_GT(low.wind_variance, 0.0);
  EXPECT_GT(high.wind_variance, 0.0);
  // Peaks and stability are the loop's, not the band's.
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(low.highest_peak(loop_breaks[b]), all.highest_peak(loop_breaks[b]));
  }
  EXPECT_EQ(low.unstable_closed_loop, all.unstable_closed_loop);
}

TEST(LoopEvaluation, ScalesWithNoiseAndWind) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = plant::frequency_grid(plant, 1e-3, 25.0, 60);
  const Eigen::ArrayXd wind = 1.0 / w;
  const Controller controller{LoopStructure::pi(), {0.25, 1.0, 0.4, 0.06}};
  const auto noise = reference::sensor_noise();
  const auto with = [&](const SensorNoise& sensors, const Eigen::ArrayXd& spectrum) {
    return LoopEvaluator(plant, w,
                         {.delay = reference::delay, .noise = sensors, .wind_spectrum = spectrum});
  };
  LoopEvaluator one = with(noise, wind);
  LoopEvaluator other = with({3.0 * noise.encoder_rms, 3.0 * noise.tachometer_rms, noise.bandwidth,
                              3.0 * noise.torque_rms},
                             4.0 * wind);
  const auto a = one.evaluate(controller, false), b = other.evaluate(controller, false);
  EXPECT_LT(relative_error(b.wind_variance, 4.0 * a.wind_variance), 1e-13);
  EXPECT_LT(relative_error(b.noise_variance, 9.0 * a.noise_variance), 1e-13);
  EXPECT_LT(relative_error(b.effort_variance, 9.0 * a.effort_variance), 1e-13);
  // Independent noises add.
  LoopEvaluator encoder = with({noise.encoder_rms, 0.0, 25.0}, wind);
  LoopEvaluator tachometer = with({0.0, noise.tachometer_rms, 25.0}, wind);
  EXPECT_LT(relative_error(encoder.evaluate(controller, false).noise_variance +
                               tachometer.evaluate(controller, false).noise_variance,
                           a.noise_variance),
            1e-13);
  // The sum over the grid is the integral: the weights add to the band in Hz.
  EXPECT_LT(relative_error(one.integration_weight().sum(), 25.0 - 1e-3), 1e-4);
  EXPECT_LT(
      relative_error((one.integration_weight() * one.wind_transmission(controller) * wind).sum(),
                     a.wind_variance),
      1e-12);
}

TEST(LoopEvaluation, HasDemandAndTorqueByWindOfTheClosedLoop) {
  reference::RandomNumbers random(128);
  const auto plant = reference::antenna();
  auto evaluator = reference::loop_evaluator(plant, 60);
  const Eigen::ArrayXd& w = evaluator.response().frequency;
  const Eigen::ArrayXd weight =
      evaluator.integration_weight() *
      (w / two_pi).unaryExpr([](double f) { return reference::motor_wind_spectrum(f); });
  for (const auto& structure : structures) {
    const Controller controller = reference::sound_controller(random, evaluator, structure, 2.5);
    EXPECT_EQ(evaluator.evaluate(controller, true).wind_demand_variance, 0.0);
    evaluator.look_at_gusts(true);
    const auto found = evaluator.evaluate(controller, true);
    const auto loop = closed_loop(plant, controller, reference::delay);
    const auto wind = plant::input_index(loop, "wind_torque");
    double demand = 0.0, torque = 0.0;
    for (Eigen::Index i = 0; i < w.size(); ++i) {
      if (w[i] > 60.0) break;  // where the rational dead time is exact; the wind is spent there
      const Eigen::MatrixXcd response = plant::frequency_response(loop, w[i]);
      demand += weight[i] * std::norm(response(plant::output_index(loop, "valve_demand"), wind));
      torque += weight[i] * std::norm(response(plant::output_index(loop, "motor_torque"), wind));
    }
    EXPECT_LT(relative_error(found.wind_demand_variance, demand), 1e-5);
    EXPECT_LT(relative_error(found.wind_torque_variance, torque), 1e-5);
    for (std::size_t k = 0; k < controller.gains.size(); ++k) {
      const auto difference = [&](double LoopEvaluation::*value, double step) {
        Controller up = controller, down = controller;
        up.gains[k] *= std::exp(step);
        down.gains[k] *= std::exp(-step);
        return (evaluator.evaluate(up, false).*value - evaluator.evaluate(down, false).*value) /
               (2.0 * step);
      };
      const auto slope = [&](double LoopEvaluation::*value) {
        return (4.0 * difference(value, 1e-4) - difference(value, 2e-4)) / 3.0;
      };
      EXPECT_NEAR(found.wind_demand_log_gradient[k], slope(&LoopEvaluation::wind_demand_variance),
                  1e-6 * found.wind_demand_variance);
      EXPECT_NEAR(found.wind_torque_log_gradient[k], slope(&LoopEvaluation::wind_torque_variance),
                  1e-6 * found.wind_torque_variance);
    }
    evaluator.look_at_gusts(false);
  }
}

TEST(LoopEvaluation, HasTheGradientsOfCentralDifferences) {
  reference::RandomNumbers random(125);
  auto evaluator = reference::loop_evaluator(reference::antenna());
  for (const auto& structure : structures) {
    for (int trial = 0; trial < 5; ++trial) {
      const Controller controller = reference::sound_controller(random, evaluator, structure, 3.0);
      const auto here = evaluator.evaluate(controller, true);
      ASSERT_TRUE(here.stable());
      for (std::size_t k = 0; k < controller.gains.size(); ++k) {
        // Two step widths, extrapolated to none.
        const auto difference = [&](const std::function<double(const Controller&)>& value) {
          const auto by = [&](double step) {
            Controller up = controller, down = controller;
            up.gains[k] *= std::exp(step);
            down.gains[k] *= std::exp(-step);
            return (value(up) - value(down)) / (2.0 * step);
          };
          return (4.0 * by(1e-4) - by(2e-4)) / 3.0;
        };
        const double wind = difference([&](const Controller& changed) {
          return evaluator.evaluate(changed, false).wind_variance;
        });
        const double noise = difference([&](const Controller& changed) {
          return evaluator.evaluate(changed, false).noise_variance;
        });
        const double effort = difference([&](const Controller& changed) {
          return evaluator.evaluate(changed, false).effort_variance;
        });
        EXPECT_NEAR(here.wind_log_gradient[k], wind, 1e-6 * here.wind_variance);
        EXPECT_NEAR(here.noise_log_gradient[k], noise, 1e-6 * here.noise_variance);
        EXPECT_NEAR(here.effort_log_gradient[k], effort, 1e-6 * here.effort_variance);
        for (std::size_t b = 0; b < 3; ++b) {
          for (const auto& peak : here.peaks[b]) {
            // At the peak's frequency: along it the magnitude is stationary.
            const double w = peak.frequency;
            const plant::PointResponse response(reference::antenna());
            const double slope = difference([&](const Controller& changed) {
              return -std::log(std::abs(
                  1.0 + loop_gain(response(w), w, changed, reference::delay, loop_breaks[b])));
            });
            EXPECT_NEAR(peak.log_gradient[k], slope, 1e-6)
                << to_string(loop_breaks[b]) << ", " << peak.frequency << " rad/s, gain " << k;
          }
        }
      }
    }
  }
}

TEST(LoopEvaluation, WithoutGradientsHasTheSameValues) {
  reference::RandomNumbers random(126);
  auto evaluator = reference::loop_evaluator(reference::antenna(), 60);
  for (const auto& structure : structures) {
    const Controller controller = reference::random_controller(random, structure);
    const auto with = evaluator.evaluate(controller, true),
               without = evaluator.evaluate(controller, false);
    EXPECT_EQ(with.wind_variance, without.wind_variance);
    EXPECT_EQ(with.noise_variance, without.noise_variance);
    EXPECT_EQ(with.effort_variance, without.effort_variance);
    EXPECT_EQ(with.unstable_closed_loop, without.unstable_closed_loop);
  }
}

TEST(LoopEvaluation, ListsThePeaksHighestFirst) {
  reference::RandomNumbers random(127);
  auto evaluator = reference::loop_evaluator(reference::antenna());
  for (int trial = 0; trial < 20; ++trial) {
    const auto evaluation = evaluator.evaluate(
        reference::random_controller(random, LoopStructure::pi_with_lag()), false);
    for (const auto loop_break : loop_breaks) {
      const auto& peaks = evaluation.peaks[static_cast<std::size_t>(loop_break)];
      EXPECT_LE(peaks.size(), 3u);
      for (std::size_t i = 1; i < peaks.size(); ++i) {
        EXPECT_GE(peaks[i - 1].magnitude, peaks[i].magnitude);
      }
      EXPECT_EQ(evaluation.highest_peak(loop_break), peaks.empty() ? 1.0 : peaks[0].magnitude);
    }
  }
  EXPECT_EQ(LoopEvaluation{}.highest_peak(LoopBreak::valve_command), 1.0);
}

TEST(LoopEvaluator, CopiesEvaluateOnTheirOwn) {
  reference::RandomNumbers random(131);
  LoopEvaluator evaluator = reference::loop_evaluator(reference::antenna(), 60);
  const Controller controller =
      reference::sound_controller(random, evaluator, LoopStructure::pi(), 2.5);
  const auto expected = evaluator.evaluate(controller, true);
  LoopEvaluator copy = evaluator;
  copy.look_at_gusts(true);
  const auto found = copy.evaluate(controller, true);
  EXPECT_EQ(found.boresight_variance(), expected.boresight_variance());
  EXPECT_GT(found.wind_demand_variance, 0.0);
  EXPECT_EQ(evaluator.evaluate(controller, true).wind_demand_variance, 0.0);
  evaluator = copy;
  EXPECT_EQ(evaluator.evaluate(controller, true).wind_demand_variance, found.wind_demand_variance);
}

TEST(LoopEvaluator, RefusesGridsThatDoNotFit) {
  const auto plant = reference::antenna();
  const Eigen::ArrayXd w = Eigen::ArrayXd::LinSpaced(5, 1.0, 5.0);
  const auto make = [&](const Eigen::ArrayXd& frequency, const Eigen::ArrayXd& spectrum) {
    return LoopEvaluator(
        plant, frequency,
        {.delay = 0.03, .noise = reference::sensor_noise(), .wind_spectrum = spectrum});
  };
  EXPECT_THAT(reference::Call([&] { make(w, w.head(4)); }),
              ThrowsMessage<InvalidInput>(HasSubstr("as many wind values as frequencies")));
  EXPECT_THROW(make(w.head(2), w.head(2)), InvalidInput);
  EXPECT_THAT(reference::Call([&] { make(w.reverse(), w); }),
              ThrowsMessage<InvalidInput>(HasSubstr("rising frequencies")));
  EXPECT_THROW(make(w - 1.0, w), InvalidInput);
  auto evaluator = make(w, w);
  EXPECT_THROW(evaluator.evaluate({LoopStructure::pi(), {1, 2, 3}}, false), InvalidInput);
  EXPECT_THROW(evaluator.wind_transmission({LoopStructure::pi(), {1, 2, -3, 4}}), InvalidInput);
  EXPECT_THROW(to_string(static_cast<LoopBreak>(9)), InvalidInput);
}

}  // namespace
}  // namespace boresight::control
