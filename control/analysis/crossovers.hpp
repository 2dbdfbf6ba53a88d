#pragma once

#include <vector>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// The loop gain L, with S = 1/(1 + L), crosses the unit circle.
struct GainCrossover {
  double frequency = 0.0;         // rad/s
  double phase_margin_deg = 0.0;  // angle of -L, in (-180, 180]
  /// s; the phase margin, taken between 0 and 360 degrees, over the frequency: the extra dead time
  /// that turns this point to -1.
  double delay_margin = 0.0;
};

/// L crosses the negative real axis.
struct PhaseCrossover {
  /// rad/s. 0, and the Nyquist frequency of a sampled loop, count where L is finite and negative
  /// there: L is real at both, and a real closed-loop pole passes there at that gain. So does
  /// infinity, where the loop has a negative feedthrough.
  double frequency = 0.0;
  double gain_margin = 0.0;  // the factor 1/|L| that brings L to -1
};

enum class CrossoverKind { gain, phase };

/// What L does near the unit circle or the negative real axis where it nearly runs along it: it
/// crosses and comes back, touches to within rounding, or turns back before.
enum class Approach { crosses, touches, misses };

/// A local extremum of ln|L| or of the angle of L to the negative real axis next to zero.
struct Tangency {
  double frequency = 0.0;  // rad/s
  CrossoverKind kind = CrossoverKind::gain;
  Approach approach = Approach::misses;
  /// By how much it goes beyond, or misses: of ln|L|, or the sine of the angle.
  double distance = 0.0;
};

/// Crossovers by rising frequency. A touch is listed as one crossover.
struct Crossovers {
  std::vector<GainCrossover> gain;
  std::vector<PhaseCrossover> phase;
  std::vector<Tangency> tangencies;
};

struct CrossoverOptions {
  /// Extrema of ln|L|, or of the sine of the angle to the axis, nearer to zero than this are listed
  /// as tangencies: by default within 1 % of gain and 0.6 degrees.
  double near_tangent = 0.01;
  /// Extrema this near to zero touch: rounding could make them cross or miss.
  double touch = 1e-11;
};

/// Every crossover of a single-input, single-output loop, continuous or sampled, from eigenvalues
/// instead of a scan of frequencies: gain crossovers lie at those zeros of 1 - L(s) L(-s), phase
/// crossovers at those of L(s) - L(-s) that are on the imaginary axis (S. Boyd, V. Balakrishnan, P.
/// Kabamba, Math. Control Signals Systems 2, 1989). Both are transmission zeros of systems of twice
/// the order; they are taken of L(1/s) besides, which keeps the digits of slow ones, and of a
/// sampled loop through the bilinear map z = (1 + s)/(1 - s). The zeros next to the axis (damping
/// ratio below 0.3) only divide the frequencies into intervals without a second crossover: each
/// crossover is located on the response itself to 1e-15 where that changes sides, and a zero at
/// which it does not is rejected, or listed as a tangency. O(order^3): the independent check of
/// margins().
/// @throws InvalidInput as validate(loop), or unless it has one input and one output;
/// NumericalFailure for a sampled loop with a state of eigenvalue -1 that input or output do not
/// reach.
Crossovers crossovers(const plant::StateSpace& loop, const CrossoverOptions& options = {});

}  // namespace boresight::control
