#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/crossovers_on_grid.hpp>
#include <boresight/control/analysis/disk_margin.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// Largest magnitude of a response and its frequency.
struct ResponsePeak {
  double frequency = 0.0;  // rad/s; 0 or infinity if only approached there
  double magnitude = 0.0;
};

/// Every crossover found, and the margins nearest to instability. The margins are distances to
/// instability only if the loop is stable.
struct Margins {
  std::vector<GainCrossover> gain_crossovers;    // by rising frequency
  std::vector<PhaseCrossover> phase_crossovers;  // by rising frequency
  std::vector<Tangency> tangencies;
  /// Smallest factor above 1 and largest factor below 1 that make the loop unstable; infinity and 0
  /// if there is none.
  double increasing_gain_margin = 0.0;
  double decreasing_gain_margin = 0.0;
  /// Smallest |phase margin| over the gain crossovers, degrees; 180 if there is none.
  double phase_margin_deg = 180.0;
  /// Smallest extra dead time that makes the loop unstable (s); infinity if there is none.
  double delay_margin = 0.0;
  ResponsePeak sensitivity;    // Ms = sup |S|
  ResponsePeak complementary;  // Mt = sup |T|
  DiskMargin disk;
  /// The frequency range of the search, rad/s; other frequencies are not covered.
  double lowest_frequency = 0.0;
  double highest_frequency = 0.0;
  /// Whether the closed loop is stable; no value if its poles are not known.
  std::optional<bool> closed_loop_stable;

  /// Smallest |1 + L|, at the frequency of Ms.
  double distance_to_minus_one() const { return 1.0 / sensitivity.magnitude; }
};

/// Sets the smallest gain, phase and delay margins from the crossovers listed.
void update_smallest(Margins& margins);

/// Margins from values on a grid; each crossover and each peak is refined on the loop gain itself.
/// @throws InvalidInput for a grid that is empty, not positive or not rising, or a loop gain that
/// is not a number.
Margins margins(const LoopOnGrid& loop, const CrossoverOptions& options = {});

/// `loop_gain`: L(j w), w in rad/s, with S = 1/(1 + L). `frequency`: rising grid (rad/s) fine
/// enough to separate neighbouring crossings. Nothing is extrapolated beyond the grid.
Margins margins(const std::function<std::complex<double>(double)>& loop_gain,
                const Eigen::ArrayXd& frequency, const CrossoverOptions& options = {});

struct MarginOptions {
  CrossoverOptions crossovers = {};
  /// s; an extra exact dead time in the loop.
  double dead_time = 0.0;
  /// Smallest number of grid points per decade. The grid is denser around each lightly damped pole
  /// and zero of L and pole of the closed loop (plant::response_grid).
  int points_per_decade = 40;
  /// Extent of the grid below the slowest and above the fastest of them.
  double decades_beyond = 3.0;
  /// With a dead time L crosses the axis infinitely often; the search ends where |L| stays below
  /// this.
  double lowest_gain = 1e-3;
};

/// Margins of a single-input, single-output state space, continuous or sampled. They cover all
/// frequencies from 0 to infinity, or to the Nyquist frequency, by a grid and the values at both
/// ends, where L is real. Accurate to 1e-9 where the poles are (plant::DenseResponse).
/// @throws InvalidInput as validate(loop), unless it has one input and one output, for a negative
/// dead time, one that asks for more than four million points, or one with a feedthrough of 1 or
/// more (no finite number of such crossovers decides).
Margins margins(const plant::StateSpace& loop, const MarginOptions& options = {});

}  // namespace boresight::control
