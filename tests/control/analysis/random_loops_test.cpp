#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/loop_response.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/numerics/bracketed_search.hpp>
#include <boresight/plant/linear/response_grid.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/transfer_function.hpp>

// Ten thousand loops: what the scan of frequencies, the eigenvalues and a plain product of zeros
// and poles say of each must be the same.
namespace boresight::control {
namespace {

using Complex = std::complex<double>;
using reference::RandomNumbers;
using reference::relative_error;

struct Loop {
  std::vector<Complex> zeros, poles;
  double gain = 1.0;

  Complex operator()(double w) const {
    Complex value = gain;
    for (const Complex pole : poles) value /= Complex{0.0, w} - pole;
    for (const Complex zero : zeros) value *= Complex{0.0, w} - zero;
    return value;
  }
  plant::StateSpace state_space() const {
    return plant::zeros_poles_gain(zeros, poles, gain, "u", "y", "x");
  }
};

constexpr double slowest = 0.1, fastest = 30.0;  // rad/s

// A real root or a pair, in the left half plane but for one in eight.
void add_root(RandomNumbers& random, std::vector<Complex>& roots, int count, double min_damping) {
  const double w = random.log_uniform(slowest, fastest);
  const double side = random.integer(0, 7) == 0 ? 1.0 : -1.0;
  if (static_cast<int>(roots.size()) + 2 > count || random.integer(0, 1) == 0) {
    roots.emplace_back(side * w);
    return;
  }
  const double damping = random.log_uniform(min_damping, 0.9);
  roots.emplace_back(side * damping * w, w * std::sqrt(1.0 - damping * damping));
  roots.push_back(std::conj(roots.back()));
}

double rounded_to_decimals(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2.0);
  return std::round(value / unit) * unit;
}

Loop random_loop(RandomNumbers& random) {
  Loop loop;
  const int order = random.integer(1, 8);
  for (int i = random.integer(0, std::min(2, order)); i > 0; --i) loop.poles.emplace_back(0.0);
  while (static_cast<int>(loop.poles.size()) < order) add_root(random, loop.poles, order, 1e-3);
  const int zeros = random.integer(0, order);
  while (static_cast<int>(loop.zeros.size()) < zeros) add_root(random, loop.zeros, zeros, 1e-2);
  // A gain of about 1 somewhere in the middle.
  const double wanted = random.log_uniform(0.3, 3.0);
  loop.gain = wanted / std::abs(loop(random.log_uniform(slowest, fastest)));
  loop.gain = rounded_to_decimals(loop.gain);
  if (random.integer(0, 6) == 0) loop.gain = -loop.gain;
  return loop;
}

Eigen::ArrayXd grid_of(const Loop& loop) {
  Eigen::VectorXcd features(static_cast<Eigen::Index>(loop.poles.size() + loop.zeros.size()));
  std::copy(loop.poles.begin(), loop.poles.end(), features.begin());
  std::copy(loop.zeros.begin(), loop.zeros.end(),
            features.begin() + static_cast<Eigen::Index>(loop.poles.size()));
  return plant::response_grid(features, 0.0,
                              {.lowest = 1e-6, .highest = 1e6, .points_per_decade = 40});
}

// Brings the gain to where an extremum of |L| lies at exp(offset); false if it has none.
bool make_nearly_tangent(Loop& loop, double offset) {
  const Eigen::ArrayXd frequency =
      Eigen::ArrayXd::LinSpaced(120, std::log(slowest), std::log(fastest));
  const auto log_gain = [&](double x) { return std::log(std::abs(loop(std::exp(x)))); };
  for (Eigen::Index i = 1; i + 1 < frequency.size(); ++i) {
    const double before = log_gain(frequency[i - 1]), here = log_gain(frequency[i]),
                 after = log_gain(frequency[i + 1]);
    const double side = here > before ? 1.0 : -1.0;
    if (side * (here - before) < 1e-4 || side * (here - after) < 1e-4) continue;
    const double x = numerics::bracketed_maximum([&](double y) { return side * log_gain(y); },
                                                 frequency[i - 1], frequency[i + 1]);
    loop.gain *= std::exp(offset - log_gain(x));
    return true;
  }
  return false;
}

// How far a state space lets a crossover be known: relative error of its response next to it
// against the product of zeros and poles, over the slope of what is zero there.
struct Conditioning {
  double response = 0.0;    // relative error of L
  double gain_slope = 0.0;  // d ln|L| / d ln w
  double turn = 0.0;        // d angle / d ln w

  Conditioning(const Loop& loop, LoopResponse& realised, double w) {
    for (int k = -2; k <= 2; ++k) {
      const double near = w * (1.0 + 1e-9 * k);
      response = std::max(response, relative_error(realised.at(near), loop(near)));
    }
    constexpr double h = 1e-5;
    const Complex slope = std::log(loop(w * std::exp(h)) / loop(w * std::exp(-h))) / (2.0 * h);
    gain_slope = slope.real();
    turn = slope.imag();
  }
  double phase_margin_error_deg() const {
    return 180.0 / std::numbers::pi * response * (1.0 + std::abs(turn / gain_slope));
  }
  double gain_margin_error() const { return response * (1.0 + std::abs(gain_slope / turn)); }
};

struct Counts {
  int gain_crossovers = 0, phase_crossovers = 0;
  std::array<int, 3> gain_tangencies{}, phase_tangencies{};  // by Approach
  int limited_by_response = 0;  // crossovers that the state space does not hold to 1e-8
  int decided_by_rounding = 0;  // tangencies nearer than the state space tells
};

class RandomLoops : public testing::Test {
 protected:
  // Compares a list with the scan's; `tolerance` of the i-th crossover by its conditioning.
  void compare(const Margins& scan, const std::vector<GainCrossover>& gain,
               const std::vector<PhaseCrossover>& phase, const std::vector<double>& gain_errors,
               const std::vector<double>& phase_errors) {
    ASSERT_EQ(gain.size(), scan.gain_crossovers.size());
    for (std::size_t i = 0; i < gain.size(); ++i) {
      EXPECT_NEAR(gain[i].phase_margin_deg, scan.gain_crossovers[i].phase_margin_deg,
                  gain_errors[i]);
      EXPECT_NEAR(gain[i].delay_margin * gain[i].frequency,
                  scan.gain_crossovers[i].delay_margin * scan.gain_crossovers[i].frequency,
                  gain_errors[i]);
    }
    ASSERT_EQ(phase.size(), scan.phase_crossovers.size());
    for (std::size_t i = 0; i < phase.size(); ++i) {
      EXPECT_NEAR(phase[i].gain_margin / scan.phase_crossovers[i].gain_margin, 1.0,
                  phase_errors[i]);
    }
  }

  void check(const Loop& loop) {
    const plant::StateSpace system = loop.state_space();
    const Margins scan = margins(system);
    const Crossovers found = crossovers(system);
    const Eigen::ArrayXd grid = grid_of(loop);
    const Margins product = margins(loop, grid);
    LoopResponse realised("test", system);
    counts_.gain_crossovers += static_cast<int>(scan.gain_crossovers.size());
    counts_.phase_crossovers += static_cast<int>(scan.phase_crossovers.size());
    count(scan.tangencies);
    for (const auto* tangencies : {&scan.tangencies, &found.tangencies, &product.tangencies}) {
      if (!has_undecided(loop, realised, *tangencies)) continue;
      // A pair of crossovers may or may not be there.
      ++counts_.decided_by_rounding;
      EXPECT_NEAR(static_cast<double>(found.gain.size()),
                  static_cast<double>(scan.gain_crossovers.size()), 2.0);
      EXPECT_NEAR(static_cast<double>(found.phase.size()),
                  static_cast<double>(scan.phase_crossovers.size()), 2.0);
      return;
    }
    check_tangencies(scan.tangencies, found.tangencies);

    constexpr double accuracy = 1e-8, caution = 30.0;
    std::vector<double> gain_errors, phase_errors;
    for (const auto& crossover : scan.gain_crossovers) {
      const Conditioning condition(loop, realised, crossover.frequency);
      const double error = caution * condition.phase_margin_error_deg();
      if (error > 180.0 * accuracy) ++counts_.limited_by_response;
      gain_errors.push_back(180.0 * accuracy + error);
    }
    for (const auto& crossover : scan.phase_crossovers) {
      const bool inside = crossover.frequency > 0.0 && std::isfinite(crossover.frequency);
      const double error =
          inside ? caution * Conditioning(loop, realised, crossover.frequency).gain_margin_error()
                 : 0.0;
      if (error > accuracy) ++counts_.limited_by_response;
      phase_errors.push_back(accuracy + error);
    }
    compare(scan, found.gain, found.phase, gain_errors, phase_errors);

    // The product of zeros and poles, on a grid without the ends.
    const auto erase_outside = [&](auto& crossovers, std::vector<double>& errors) {
      for (std::size_t i = crossovers.size(); i-- > 0;) {
        const double w = crossovers[i].frequency;
        if (w > grid[0] && w < grid[grid.size() - 1]) continue;
        crossovers.erase(crossovers.begin() + static_cast<std::ptrdiff_t>(i));
        errors.erase(errors.begin() + static_cast<std::ptrdiff_t>(i));
      }
    };
    Margins inner = scan;
    erase_outside(inner.gain_crossovers, gain_errors);
    erase_outside(inner.phase_crossovers, phase_errors);
    compare(inner, product.gain_crossovers, product.phase_crossovers, gain_errors, phase_errors);
  }

  // Whether rounding of the state space decides which way a tangency goes.
  static bool has_undecided(const Loop& loop, LoopResponse& realised,
                            const std::vector<Tangency>& tangencies) {
    return std::any_of(tangencies.begin(), tangencies.end(), [&](const Tangency& tangency) {
      return tangency.distance < 1e3 * Conditioning(loop, realised, tangency.frequency).response;
    });
  }

  // What misses by more than 1e-3 may be too wide for eigenvalues near the axis.
  static std::vector<Tangency> narrow(const std::vector<Tangency>& tangencies) {
    std::vector<Tangency> result;
    for (const auto& tangency : tangencies) {
      if (tangency.approach != Approach::misses || tangency.distance < 1e-3) {
        result.push_back(tangency);
      }
    }
    return result;
  }

  static void check_tangencies(const std::vector<Tangency>& by_scan,
                               const std::vector<Tangency>& by_eigenvalues) {
    const auto scan = narrow(by_scan), found = narrow(by_eigenvalues);
    ASSERT_EQ(found.size(), scan.size());
    for (std::size_t i = 0; i < scan.size(); ++i) {
      EXPECT_EQ(found[i].kind, scan[i].kind);
      EXPECT_EQ(found[i].approach, scan[i].approach);
      EXPECT_NEAR(found[i].frequency / scan[i].frequency, 1.0, 1e-4);
      EXPECT_NEAR(found[i].distance / scan[i].distance, 1.0, 1e-2);
    }
  }

  void count(const std::vector<Tangency>& tangencies) {
    for (const auto& tangency : tangencies) {
      auto& counted =
          tangency.kind == CrossoverKind::gain ? counts_.gain_tangencies : counts_.phase_tangencies;
      ++counted[static_cast<std::size_t>(tangency.approach)];
    }
  }

  Counts counts_;
};

TEST_F(RandomLoops, HaveTheSameMarginsByEveryRoute) {
  constexpr int loops = 9000, nearly_tangent = 1000;
  RandomNumbers random(71001);
  for (int i = 0; i < loops; ++i) {
    SCOPED_TRACE(i);
    check(random_loop(random));
    ASSERT_FALSE(HasFailure());
  }
  // And loops brought to within 1e-2 to 1e-9 of a tangency to the unit circle.
  for (int i = 0; i < nearly_tangent;) {
    Loop loop = random_loop(random);
    const double offset = (random.integer(0, 1) == 0 ? 1.0 : -1.0) * random.log_uniform(1e-9, 9e-3);
    if (!make_nearly_tangent(loop, offset)) continue;
    SCOPED_TRACE(loops + i++);
    check(loop);
    ASSERT_FALSE(HasFailure());
  }
  RecordProperty("gain_crossovers", counts_.gain_crossovers);
  RecordProperty("phase_crossovers", counts_.phase_crossovers);
  RecordProperty("gain_crosses", counts_.gain_tangencies[0]);
  RecordProperty("gain_touches", counts_.gain_tangencies[1]);
  RecordProperty("gain_misses", counts_.gain_tangencies[2]);
  RecordProperty("phase_crosses", counts_.phase_tangencies[0]);
  RecordProperty("phase_touches", counts_.phase_tangencies[1]);
  RecordProperty("phase_misses", counts_.phase_tangencies[2]);
  RecordProperty("limited_by_response", counts_.limited_by_response);
  RecordProperty("decided_by_rounding", counts_.decided_by_rounding);
  EXPECT_GT(counts_.gain_crossovers, 12000);
  EXPECT_GT(counts_.phase_crossovers, 8000);
  EXPECT_GT(counts_.gain_tangencies[0], 400);
  EXPECT_GT(counts_.gain_tangencies[2], 400);
  // The rest is exact to 1e-8; these are state spaces of large cancelling parts.
  EXPECT_LT(counts_.limited_by_response, (counts_.gain_crossovers + counts_.phase_crossovers) / 50);
  EXPECT_LT(counts_.decided_by_rounding, nearly_tangent / 10);
}

TEST_F(RandomLoops, SampledEverFinerTendToTheContinuousMargins) {
  // A held input comes T/2 late: phase margins fall by w T/2 to first order, and the extrapolation
  // from T and T/2 is right to second order.
  constexpr int loops = 300;
  RandomNumbers random(71002);
  std::vector<double> reductions;
  for (int i = 0; i < loops; ++i) {
    SCOPED_TRACE(i);
    const Loop loop = random_loop(random);
    if (loop.zeros.size() == loop.poles.size()) continue;  // the feedthrough is not held
    const plant::StateSpace system = loop.state_space();
    const Margins continuous = margins(system);
    // Well below the Nyquist frequency of 785 rad/s.
    const bool slow = std::all_of(
        continuous.gain_crossovers.begin(), continuous.gain_crossovers.end(),
        [](const GainCrossover& x) { return x.frequency > 1e-2 && x.frequency < 50.0; });
    if (!slow || !continuous.tangencies.empty()) continue;
    std::vector<std::vector<GainCrossover>> sampled;
    for (const double sample_time : {4e-3, 2e-3, 1e-3}) {
      sampled.push_back(margins(plant::sample(system, sample_time)).gain_crossovers);
    }
    for (std::size_t k = 0; k < continuous.gain_crossovers.size(); ++k) {
      const auto& exact = continuous.gain_crossovers[k];
      for (const auto& crossovers : sampled) {
        ASSERT_EQ(crossovers.size(), continuous.gain_crossovers.size());
      }
      // Differences in radians, the short way round.
      const auto lag = [&](std::size_t of) {
        const double degrees = exact.phase_margin_deg - sampled[of][k].phase_margin_deg;
        return std::remainder(degrees, 360.0) * std::numbers::pi / 180.0;
      };
      const double coarse = lag(0), middle = lag(1), fine = lag(2);
      const double extrapolated_coarse = 2.0 * middle - coarse, extrapolated = 2.0 * fine - middle;
      // The crossover itself moves as well; both first-order parts fall by two, the rest by four.
      EXPECT_NEAR(fine / middle, 0.5, 0.1);
      EXPECT_LT(std::abs(extrapolated),
                0.5 * std::abs(extrapolated_coarse) + 0.1 * std::pow(exact.frequency * 1e-3, 2));
      if (std::abs(extrapolated) > 1e-8) {
        reductions.push_back(std::abs(extrapolated_coarse / extrapolated));
      }
    }
  }
  std::sort(reductions.begin(), reductions.end());
  ASSERT_GT(reductions.size(), 100u);
  EXPECT_NEAR(reductions[reductions.size() / 2], 4.0, 0.1);
}

}  // namespace
}  // namespace boresight::control
