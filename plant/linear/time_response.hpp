#pragma once

#include <optional>

#include <Eigen/Core>

#include <boresight/plant/linear/modal_form.hpp>
#include <boresight/plant/linear/modal_recursion.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::plant {

/// What a sampled input does between its samples.
enum class Interpolation { zero_order_hold, first_order_hold };

struct SimulationOptions {
  /// First-order hold: straight from each sample to the next. Only for continuous systems.
  Interpolation interpolation = Interpolation::zero_order_hold;
  /// Above this condition of the eigenvectors the dense route is taken: the default leaves errors
  /// of some 1e-8 of the largest mode.
  double largest_condition = highest_modal_condition;
};

/// The exact response of a linear system to a sampled input, prepared once: by modes, O(n) a
/// sample, or, where the eigenvectors are dependent or nearly so (repeated poles in a chain), by
/// the dense transition matrix, O(n^2) a sample.
class LinearSimulation {
 public:
  /// A continuous system with samples `step` s apart, or a sampled one, whose sample time must be
  /// `step`. At rest.
  /// @throws InvalidInput as validate(system) and sample(), for a step that is not above 0 or not
  /// the sample time, and a first-order hold before a sampled system; NumericalFailure if
  /// exp(A step) overflows.
  LinearSimulation(const StateSpace& system, double step, const SimulationOptions& options = {});

  /// The state x before the next sample; everything simulated before is forgotten.
  /// @throws InvalidInput for a wrong length or elements that are not finite.
  void start_from(const Eigen::VectorXd& state);

  /// y[k] at the samples of u: samples x inputs to samples x outputs. Goes on where the last call
  /// ended, so that a long record can be simulated in pieces. Allocates nothing if the columns of
  /// `input` are contiguous. @throws InvalidInput for shapes that do not fit or inputs that are not
  /// finite; NumericalFailure if an unstable system overflows.
  void simulate(const Eigen::Ref<const Eigen::MatrixXd>& input, Eigen::Ref<Eigen::MatrixXd> output);
  Eigen::MatrixXd simulate(const Eigen::Ref<const Eigen::MatrixXd>& input);

  /// Whether the response is computed by modes.
  bool by_modes() const { return modes_.has_value(); }
  /// Condition of the eigenvectors; infinity if they are dependent.
  double modal_condition() const { return condition_; }

 private:
  void prepare_modes(const StateSpace& system, double step, const SimulationOptions& options);
  void prepare_dense(const StateSpace& system, double step, const SimulationOptions& options);

  StateSpace dense_;  // sampled; without elements where modes do the work
  Eigen::VectorXd dense_state_;
  Eigen::VectorXd next_state_;
  std::optional<ModalRecursion> modes_;
  Eigen::MatrixXcd to_modes_;  // of the state
  double condition_ = 0.0;
  Eigen::Index states_ = 0;
  Eigen::Index inputs_ = 0;
  Eigen::Index outputs_ = 0;
  // With a first-order hold the state carried is x - shift u, with the input of the same sample:
  // the first sample must still take it off.
  Eigen::MatrixXcd modal_shift_;
  Eigen::MatrixXd dense_shift_;
  bool unshifted_ = false;
  bool shifts_ = false;
};

}  // namespace boresight::plant
