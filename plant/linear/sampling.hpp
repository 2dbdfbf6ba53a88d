#pragma once

#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

enum class SamplingMethod {
  /// Exact for an input held from sample to sample.
  zero_order_hold,
  /// Exact for an input that is straight from sample to sample. The states become
  /// x - (integral of exp(A (T - s)) s/T ds B) u, in which no future input is needed (G. F.
  /// Franklin, J. D. Powell, M. Workman, Digital Control of Dynamic Systems, 3rd ed., 6.3.2).
  first_order_hold,
  /// s = (2/T) (z - 1)/(z + 1), the trapezoidal rule: the frequency axis maps onto the unit circle.
  tustin
};

struct SamplingOptions {
  /// rad/s, below pi/T; 0 for none. With Tustin: the frequency at which the sampled response is
  /// the continuous one.
  double prewarp_frequency = 0.0;
  /// s, one for each input in their order, or empty for none. With the zero-order hold: dead times
  /// by which the held inputs arrive late, any multiple or fraction of T, exact. Each becomes
  /// states `input`_held_1, `input`_held_2, ... (the input one, two, ... samples ago).
  std::vector<double> dead_times;
};

/// A dead time as whole samples and a rest, 0 <= rest < T: an input held from sample to sample acts
/// `samples` samples late, and until `rest` after each sample the one before it still does. A rest
/// within 1e-9 T of 0 or T counts as none.
struct DeadTimeInSamples {
  Eigen::Index samples = 0;
  double rest = 0.0;  // s
};
DeadTimeInSamples dead_time_in_samples(double dead_time, double sample_time);

/// The sampled system y[k] = y(k T) of a continuous one, T in s. Zero-order and first-order hold
/// and Tustin's method keep the names and order of the states (held inputs follow them).
/// @throws InvalidInput unless T > 0 and the system is continuous, for an option that its method
/// does not have or a value out of range, and as validate(system); NumericalFailure for Tustin's
/// method where the system has a pole at 2/T (s = 2/T maps to infinity), and if exp(A T) overflows.
StateSpace sample(const StateSpace& system, double sample_time,
                  SamplingMethod method = SamplingMethod::zero_order_hold,
                  const SamplingOptions& options = {});

}  // namespace boresight::plant
