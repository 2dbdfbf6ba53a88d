#pragma once

#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// A crossing of the unit circle by the loop gain L, with S = 1/(1 + L).
struct GainCrossover {
  double frequency = 0.0;         // rad/s
  double phase_margin_deg = 0.0;  // angle of -L, in (-180, 180]
  /// Delay margin (s): the phase margin, taken between 0 and 360 degrees, over the frequency. This
  /// extra dead time moves the point to -1.
  double delay_margin = 0.0;
};

/// A crossing of the negative real axis by L.
struct PhaseCrossover {
  /// rad/s. Frequency 0, and the Nyquist frequency of a sampled loop, count if L is finite and
  /// negative there. L is real at both, and a real closed-loop pole crosses the boundary there at
  /// that gain. Infinity counts likewise if the loop has a negative feedthrough.
  double frequency = 0.0;
  double gain_margin = 0.0;  // the factor 1/|L| that brings L to -1
};

enum class CrossoverKind { gain, phase };

/// Behaviour of L near the unit circle or the negative real axis where it is nearly tangent: it
/// crosses and returns, touches to within rounding, or turns back before.
enum class Approach { crosses, touches, misses };

/// A local extremum of ln|L| or of the angle of L to the negative real axis next to zero.
struct Tangency {
  double frequency = 0.0;  // rad/s
  CrossoverKind kind = CrossoverKind::gain;
  Approach approach = Approach::misses;
  /// Distance beyond, or short of, the circle or axis: of ln|L|, or the sine of the angle.
  double distance = 0.0;
};

/// Crossovers, rising in frequency. A touch is listed as one crossover.
struct Crossovers {
  std::vector<GainCrossover> gain;
  std::vector<PhaseCrossover> phase;
  std::vector<Tangency> tangencies;
};

struct CrossoverOptions {
  /// Extrema of ln|L|, or of the sine of the angle to the axis, nearer to zero than this are listed
  /// as tangencies. Default: within 1 % of gain and 0.6 degrees.
  double near_tangent = 0.01;
  /// Extrema this near to zero count as touching, because rounding could make them cross or miss.
  double touch = 1e-11;
};

/// Every crossover of a single-input, single-output loop, continuous or sampled, from eigenvalues
/// instead of a frequency scan. Gain crossovers are the zeros of 1 - L(s) L(-s) on the imaginary
/// axis, phase crossovers those of L(s) - L(-s) (S. Boyd, V. Balakrishnan, P. Kabamba, Math.
/// Control Signals Systems 2, 1989). Both are transmission zeros of systems of twice the order.
/// They are computed also for L(1/s), which keeps the digits of slow ones, and for a sampled loop
/// through the bilinear map z = (1 + s)/(1 - s). The zeros next to the axis (damping ratio below
/// 0.3) only divide the frequencies into intervals with at most one crossover. Each crossover is
/// located to 1e-15 where the response itself changes sides. A zero without a change of sides is
/// rejected or listed as a tangency. O(order^3): the independent check of margins().
/// @throws InvalidInput as validate(loop), or unless it has one input and one output;
/// NumericalFailure for a sampled loop with a state of eigenvalue -1 that input or output do not
/// reach.
Crossovers crossovers(const plant::StateSpace& loop, const CrossoverOptions& options = {});

}  // namespace boresight::control
