#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <boresight/plant/linear/state_space.hpp>

namespace boresight::design {

/// What poles must keep.
struct PoleBounds {
  double slowest = 0.0;  // rad/s: their real parts in delta are beyond
  /// Damping ratio of a pair, (b1 - T b0)/(2 sqrt(b0)) in terms of ParallelSections: that of a
  /// continuous pair where it is slow against the samples, and 0 at the limit of stability. A
  /// sharper resonance of a controller would fit one plant.
  double damping = 0.0;
};

/// A stable sampled controller of tachometer, encoder and motor torque as a sum of sections, in
/// terms of delta = (z - 1)/T, which keeps the digits of poles that are slow against the samples
/// (R. H. Middleton, G. C. Goodwin, Digital Control and Estimation, 1990):
///   K_i = d_i + sum over sections (n1_i delta + n0_i) / (delta^2 + b1 delta + b0),
/// and, where the order is odd, a section n0_i / (delta + b). Its parameters are ln b1, ln b0 (ln
/// b), the numerators and d: as few as any controller of the order and these sensors has, and no
/// pole needs to be real or complex. For searches by gradient.
class ParallelSections {
 public:
  static constexpr Eigen::Index sensors = 3;

  /// The parameters of a controller. Its output is valve_command; a sensor that it does not read
  /// has zeros.
  /// @throws InvalidInput without the output or for a controller that is not sampled or not stable;
  /// NumericalFailure as numerics::eigen_decomposition (repeated poles).
  /// `bounds`: what stability() keeps.
  explicit ParallelSections(const plant::StateSpace& controller, const PoleBounds& bounds = {});

  const Eigen::VectorXd& parameters() const { return parameters_; }
  Eigen::Index order() const { return 2 * pairs_ + singles_; }

  /// Places of the parameters that are logarithms of denominators.
  std::vector<Eigen::Index> logarithms() const;

  /// The controller of other parameters, with all three sensors as inputs. States: of each section
  /// the output and another one of the same size.
  plant::StateSpace state_space(const Eigen::VectorXd& parameters) const;

  /// Places of the parameters that the response to a sensor depends on: its own numerators and all
  /// denominators.
  std::vector<Eigen::Index> parameters_of(Eigen::Index sensor) const;

  struct Response {
    Eigen::ArrayXXcd value;                         // frequencies x sensors
    std::array<Eigen::MatrixXcd, 3> by_parameters;  // per sensor: frequencies x parameters_of(it)
  };
  Response response(const Eigen::VectorXd& parameters, const Eigen::ArrayXd& frequency) const;

  /// Stable, and with all poles within their bounds, where all are negative: conditions on the
  /// sections and their gradients, conditions x parameters.
  struct Stability {
    Eigen::VectorXd conditions;
    Eigen::MatrixXd gradients;
  };
  Stability stability(const Eigen::VectorXd& parameters) const;

 private:
  double sample_time_ = 0.0;
  PoleBounds bounds_;
  Eigen::Index pairs_ = 0, singles_ = 0;  // sections of second and of first order
  Eigen::VectorXd parameters_;
};

/// The bounds that a controller's poles keep. @throws NumericalFailure as
/// numerics::eigen_decomposition.
PoleBounds bounds_of(const plant::StateSpace& controller);

/// A sampled controller, as a function of the three sensors alone, with pairs of poles added that
/// do nothing yet, for a refinement to use: of these frequencies (rad/s, above 0; their magnitude
/// in delta) and this damping ratio (PoleBounds::damping, above 0), with zero numerators. Pairs
/// that are too fast for that damping at the controller's sample time are left out.
/// @throws InvalidInput without the output valve_command.
plant::StateSpace with_idle_pairs(const plant::StateSpace& controller,
                                  std::span<const double> frequencies, double damping);

}  // namespace boresight::design
