#pragma once

#include <map>
#include <string>
#include <vector>

#include <boresight/plant/linear/state_space.hpp>

/// Systems put together in the usual ways. One name is one signal: ports are matched by name, never
/// by position, and what `connect` refuses is refused here as well (names given twice, different
/// sample times). All states are kept, those of the first system first.
namespace boresight::plant {

/// The system seen through some of its inputs and outputs, in the order given; all states kept.
/// @throws InvalidInput for a name that the system does not have, or one given twice.
StateSpace subsystem(const StateSpace& system, const std::vector<std::string>& inputs,
                     const std::vector<std::string>& outputs);

/// The system with other names: each input, output and state called `first` is called `second`.
/// @throws InvalidInput for a name that the system does not have, or if two come out the same.
StateSpace renamed(const StateSpace& system, const std::map<std::string, std::string>& new_names);

/// `second` driven by `first`: every input of `second` is an output of `first`. The inputs of
/// `first` to the outputs of `second`; outputs of `first` that `second` does not take are dropped.
/// @throws InvalidInput for an input of `second` that is no output of `first`, and as connect.
StateSpace series(const StateSpace& first, const StateSpace& second);

/// The sum of two systems with the same inputs and the same outputs, in the order of `first`.
/// @throws InvalidInput naming an input or output that only one of them has, and as connect.
StateSpace parallel(const StateSpace& first, const StateSpace& second);

struct FeedbackOptions {
  /// -1: what returns is subtracted, +1: added.
  double sign = -1.0;
  /// One name for each output of `forward`, in its order, or none: an input that is added to this
  /// output inside the loop, before `back` sees it (from the first disturbance to the first output:
  /// the sensitivity).
  std::vector<std::string> output_disturbances;
  /// One name for each input of `back`, or none: an input that is added to what `back` takes.
  std::vector<std::string> measurement_noises;
  /// One name for each input of `forward`, or none: an output with the total input of `forward`,
  /// reference plus feedback.
  std::vector<std::string> total_inputs;
};

/// `forward` with its outputs returned to its inputs through `back`: u = r + sign y_back. Every
/// input of `back` is an output of `forward`, every output of `back` has the name of the input of
/// `forward` that it is added to. Inputs of the result: those of `forward` (r), then the
/// disturbances, then the noises; outputs: those of `forward`, then the total inputs.
/// @throws InvalidInput for a port of `back` that `forward` does not have, a sign that is neither
/// 1 nor -1, lists of another length, and as connect; NumericalFailure naming the signals of an
/// algebraic loop without solution (I - sign D_back D_forward singular).
StateSpace feedback(const StateSpace& forward, const StateSpace& back,
                    const FeedbackOptions& options = {});

/// Lower linear fractional transformation: `controller` takes outputs of `system` and drives inputs
/// of it, all by name, nothing is subtracted. The inputs and outputs of `system` that are left over
/// remain, in its order: with [z; y] = P [w; u] and u = K y, the result is
/// z = (P11 + P12 K (I - P22 K)^-1 P21) w (K. Zhou, J. C. Doyle, K. Glover, Robust and Optimal
/// Control, 1996, ch. 10). The upper transformation is the same thing with the uncertainty's
/// signals.
/// @throws InvalidInput for a port of `controller` that `system` does not have, and as connect;
/// NumericalFailure naming the signals of an algebraic loop without solution.
StateSpace lower_fractional_transformation(const StateSpace& system, const StateSpace& controller);

}  // namespace boresight::plant
