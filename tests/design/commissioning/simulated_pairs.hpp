// Pairs of 20 records before and after a change of the controller, at different winds.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "design/commissioning/simulated_errors.hpp"
#include "random_numbers.hpp"

namespace boresight::reference {

class SimulatedPairs {
 public:
  static constexpr int records = 20;
  /// PI at a third of its position gain, and a pressure feedback loop, of
  /// docs/reference-designs.md.
  const control::Controller old_controller{
      control::LoopStructure::named("PI"),
      {0.158727318, 0.420686147, 2.62771508, 3.4, 0.235314779}};
  const control::Controller new_controller{
      control::LoopStructure::named("DPF"),
      {3.12002617, 0.118067662, 300.0, 0.313948912, 10.4533087, 1.20055056, 2.18379195}};

  struct Counts {
    int better = 0;  // the change called better
    int held = 0;    // the interval holds the computed ratio
    int change_without_change = 0;
    double log_error = 0.0, log_square = 0.0;  // mean of ln(ratio/computed), and of its square
    double half_width = 0.0;                   // mean, of the logarithm
  };

  /// Repetitions with a change of the controller, and as many without. Records before
  /// are at 4 to 9 m/s, those after at 6 to 12 m/s; gusts scatter from record to record by
  /// `gustiness` (standard deviation of the logarithm of their speed).
  Counts count(int repetitions, double gustiness = 0.1) {
    Counts counts;
    for (int r = 0; r < repetitions; ++r) {
      const auto before = draw(old_, 4.0, 9.0, gustiness);
      const auto after = draw(new_, 6.0, 12.0, gustiness);
      const auto same = draw(old_, 6.0, 12.0, gustiness);
      const auto changed = design::compare_in_wind(before, after);
      const auto unchanged = design::compare_in_wind(before, same);
      const auto& at = *changed.at_reference;
      const double expected =
          new_.expected_rms(new_controller, at.speed, changed.lowest, changed.highest) /
          old_.expected_rms(old_controller, at.speed, changed.lowest, changed.highest);
      const auto holds = [](const design::RatioBand& ratio, double value) {
        return ratio.lower <= value && value <= ratio.upper ? 1 : 0;
      };
      counts.better += at.change == design::Change::better ? 1 : 0;
      counts.held += holds(at.ratio, expected);
      counts.change_without_change +=
          unchanged.at_reference->change != design::Change::none ? 1 : 0;
      const double error = std::log(at.ratio.value / expected);
      counts.log_error += error / repetitions;
      counts.log_square += error * error / repetitions;
      counts.half_width += 0.5 * std::log(at.ratio.upper / at.ratio.lower) / repetitions;
    }
    return counts;
  }

 private:
  std::vector<design::WindyRecord> draw(SimulatedErrors& errors, double slowest, double fastest,
                                        double gustiness) {
    std::vector<design::WindyRecord> result;
    for (int i = 0; i < records; ++i) {
      // Steps of half a metre per second: every wind is prepared once.
      const double speed = 0.5 * std::round(2.0 * random_.uniform(slowest, fastest));
      const double gusts = std::exp(gustiness * numerics::NormalNumbers(seed_, 9).pair(0).real());
      result.push_back(errors.record(speed, seed_++, gusts));
    }
    return result;
  }

  SimulatedErrors old_{old_controller}, new_{new_controller};
  RandomNumbers random_{1};
  std::uint64_t seed_ = 1;
};

}  // namespace boresight::reference
