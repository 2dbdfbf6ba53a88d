#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "design/studies/demo_mission.hpp"
#include "limit_cycles/random_loops.hpp"
#include <boresight/design/problem/drive_capability.hpp>
#include <boresight/design/verification/limit_cycle_prediction.hpp>
#include <boresight/design/verification/limit_cycle_search.hpp>
#include <boresight/numerics/parallel_loop.hpp>

namespace boresight::design {
namespace {

struct Outcome {
  LimitCycleResult simulated;
  double predicted = 0.0;  // by harmonic balance, amplitude at the encoder, rad at the sky
  double confirmed = 0.0;  // by simulation of the reduced antenna
  double step = 0.0;
};

// `./dev limit-cycles` counts a thousand on the 70-m antenna.
TEST(LimitCyclePrediction, MissesFewOfRandomLoops) {
  const Mission mission = reference::demo_mission();
  constexpr std::size_t frictions = 4, controllers = 15;
  const auto loops = limit_cycles::random_loops(mission, frictions, controllers, 1, 2);
  std::vector<Outcome> outcomes(frictions * controllers);
  numerics::for_each_index(loops.size(), 2, [&](std::size_t i) {
    SimulatedLoop loop = loops[i].antenna;
    const LimitCyclePrediction prediction(loop, 1);
    NonlinearVerificationOptions options;
    options.limits = {mission.antenna.drive.slew_rate, slew_acceleration};
    for (std::size_t k = 0; k < controllers; ++k) {
      loop.controller = loops[i].controllers[k];
      Outcome& outcome = outcomes[i * controllers + k];
      outcome.step = loop.encoder_resolution / loop.gear_ratio;
      const auto predicted = prediction.of(loop.controller);
      const auto one = largest_stable(predicted, min_limit_cycle_amplitude(loop));
      if (one) outcome.predicted = one->encoder_amplitude;
      constexpr std::size_t largest_start = 2;
      outcome.simulated = confirmed_limit_cycle_run(loop, options, 0.0, largest_start);
      const auto reduced = reduced_limit_cycle_run(loop, options, largest_start);
      if (reduced.limit_cycle) outcome.confirmed = reduced.encoder_amplitude;
    }
  });
  int cycles = 0, missed = 0, large = 0, near = 0, resting = 0, false_alarms = 0;
  int confirmed_cycles = 0, confirmed_near = 0, falsely_confirmed = 0;
  for (const auto& [simulated, predicted, confirmed, step] : outcomes) {
    if (simulated.status != RunStatus::complete) continue;
    if (!simulated.limit_cycle) {
      ++resting;
      false_alarms += predicted > step ? 1 : 0;
      falsely_confirmed += confirmed > 0.0 ? 1 : 0;
      continue;
    }
    ++cycles;
    missed += predicted == 0.0 && confirmed == 0.0 ? 1 : 0;
    confirmed_cycles += confirmed > 0.0 ? 1 : 0;
    confirmed_near += std::abs(confirmed / simulated.encoder_amplitude - 1.0) <= 0.3 ? 1 : 0;
    if (simulated.encoder_amplitude < 3.0 * step) continue;
    ++large;
    near += std::abs(predicted / simulated.encoder_amplitude - 1.0) < 0.3 ? 1 : 0;
  }
  RecordProperty("cycles", cycles);
  RecordProperty("missed", missed);
  RecordProperty("large", large);
  RecordProperty("near", near);
  RecordProperty("resting", resting);
  RecordProperty("false_alarms", false_alarms);
  RecordProperty("confirmed_cycles", confirmed_cycles);
  RecordProperty("confirmed_near", confirmed_near);
  RecordProperty("falsely_confirmed", falsely_confirmed);
  EXPECT_GE(cycles, 10);
  EXPECT_GE(resting, 10);
  EXPECT_LE(missed, 1);
  EXPECT_GE(large, 5);
  EXPECT_GE(near, 0.7 * large);
  EXPECT_LE(false_alarms, 0.4 * resting);
  EXPECT_GE(confirmed_cycles, 0.8 * cycles);
  EXPECT_GE(confirmed_near, 0.8 * confirmed_cycles);
  EXPECT_LE(falsely_confirmed, 0.25 * resting);
}

}  // namespace
}  // namespace boresight::design
