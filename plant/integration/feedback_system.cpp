#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/plant/integration/feedback_system.hpp>

namespace boresight::plant {

FeedbackMatrices feedback_matrices(const FeedbackSystem& system) {
  const StateSpace& linear = system.linear;
  validate(linear);
  if (linear.sample_time != 0.0) {
    throw InvalidInput(
        fmt::format("feedback_matrices: expected a continuous linear system, found one with a "
                    "sample time of {} s",
                    linear.sample_time));
  }
  const Eigen::Index q = system.channel_outputs, p = system.channel_inputs;
  const Eigen::Index inputs = linear.b.cols(), outputs = linear.c.rows();
  if (q < 0 || p < 0 || q > inputs || p > outputs) {
    throw InvalidInput(
        fmt::format("feedback_matrices: expected at most {} channel outputs and {} channel inputs "
                    "(the inputs and outputs of the linear system), found {} and {}",
                    inputs, outputs, q, p));
  }
  if (!system.channels && (q > 0 || p > 0)) {
    throw InvalidInput(fmt::format(
        "feedback_matrices: expected channels for {} outputs and {} inputs, found none", q, p));
  }
  if (system.channels && (system.channels->outputs() != q || system.channels->inputs() != p)) {
    throw InvalidInput(
        fmt::format("feedback_matrices: expected channels with {} outputs and {} inputs, found "
                    "{} and {}",
                    q, p, system.channels->outputs(), system.channels->inputs()));
  }
  const Eigen::Index driven = inputs - q, observed = outputs - p;
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = 0; j < q; ++j) {
      if (linear.d(i, driven + j) != 0.0) {
        throw InvalidInput(fmt::format(
            "feedback_matrices: expected every path from a channel's output to a channel's input "
            "to pass a state, found '{}' = {} '{}' + ...; put a lag between them",
            linear.outputs[static_cast<std::size_t>(i)], linear.d(i, driven + j),
            linear.inputs[static_cast<std::size_t>(driven + j)]));
      }
    }
  }
  return {linear.a,
          linear.b.leftCols(driven),
          linear.b.rightCols(q),
          linear.c.topRows(p),
          linear.d.topLeftCorner(p, driven),
          linear.c.bottomRows(observed),
          linear.d.bottomLeftCorner(observed, driven),
          linear.d.bottomRightCorner(observed, q)};
}

}  // namespace boresight::plant
