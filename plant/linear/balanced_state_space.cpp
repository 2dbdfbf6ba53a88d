#include <boresight/numerics/balance.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>

namespace boresight::plant {

StateSpace balanced(const StateSpace& system) {
  validate(system);
  const Eigen::VectorXd scale = numerics::balancing_scale(system.a);
  StateSpace result = system;
  result.a = scale.cwiseInverse().asDiagonal() * system.a * scale.asDiagonal();
  result.b = scale.cwiseInverse().asDiagonal() * system.b;
  result.c = system.c * scale.asDiagonal();
  return result;
}

}  // namespace boresight::plant
