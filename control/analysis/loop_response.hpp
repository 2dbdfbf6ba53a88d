#pragma once

#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <boresight/control/analysis/crossovers.hpp>
#include <boresight/control/analysis/crossovers_on_grid.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::control {

/// The frequency response of a single-input, single-output open loop with an extra exact dead time,
/// L(j w) e^(-j w dead_time), with the data for a search along it. Use one object per thread.
class LoopResponse {
 public:
  /// `function` is named in errors.
  /// @throws InvalidInput as validate(loop), unless it has one input and one output, or for a
  /// negative dead time.
  LoopResponse(const char* function, const plant::StateSpace& loop, double dead_time = 0.0);

  std::complex<double> at(double angular_frequency);
  Eigen::ArrayXcd at(const Eigen::ArrayXd& angular_frequency);

  /// L at a grid of frequencies, and its estimated relative errors. The estimate is the difference
  /// between reductions from the input and from the output, which round differently. It also shows
  /// where L is lost in rounding (below poles that ought to be 0).
  LoopOnGrid on_grid(Eigen::ArrayXd angular_frequency);

  /// Poles and zeros of L and poles of the closed loop, in s or z: the frequencies where L and 1 +
  /// L vary.
  const Eigen::VectorXcd& features() const { return features_; }
  /// The same in s, as ln(z)/T for a sampled loop.
  Eigen::VectorXcd continuous_features() const;
  /// Whether all poles of the closed loop are inside the stability boundary. No value for a loop
  /// without solution (1 + L(infinity) = 0), or with a dead time.
  std::optional<bool> closed_loop_stable() const { return closed_loop_stable_; }

  double sample_time() const { return response_.sample_time(); }
  /// pi/T; infinite for continuous time.
  double nyquist_frequency() const;
  /// L at w = 0; infinite for an integrator.
  std::complex<double> at_zero() const { return at_zero_; }
  /// L without the dead time at the Nyquist frequency, infinite for a pole there. In continuous
  /// time the feedthrough, L at infinite frequency.
  std::complex<double> at_highest() const { return at_highest_; }
  double dead_time() const { return dead_time_; }

  /// Adds the phase crossovers at frequency 0 and at the highest frequency (PhaseCrossover), before
  /// and after the given ones.
  void add_real_ends(std::vector<PhaseCrossover>& crossovers) const;

 private:
  std::complex<double> solved(std::complex<double> s) const;
  std::complex<double> real_end(double s);
  double error_at(double angular_frequency);

  plant::StateSpace scaled_;  // balanced; A - I instead of A if sampled
  plant::DenseResponse response_, other_;
  double dead_time_;
  Eigen::VectorXcd features_;
  std::optional<bool> closed_loop_stable_;
  std::complex<double> at_zero_, at_highest_;
};

}  // namespace boresight::control
