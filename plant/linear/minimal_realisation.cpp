#include <algorithm>

#include <fmt/format.h>

#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/plant/linear/minimal_realisation.hpp>
#include <boresight/plant/linear/orthogonal_reduction.hpp>

namespace boresight::plant {
namespace {

struct Couplings {
  double tolerance = 0.0;
  double smallest_kept = 0.0;
  double largest_neglected = 0.0;
};

// Turns the states so that the first `reached` ones are those that the inputs reach, stair by
// stair; returns `reached`.
Eigen::Index reach(Eigen::MatrixXd& a, Eigen::MatrixXd& b, Eigen::MatrixXd& c,
                   Couplings& couplings) {
  const Eigen::Index n = a.rows();
  Eigen::Index reached = 0;
  Eigen::MatrixXd drive = b;  // how what is reached drives the rest
  while (reached < n) {
    const Eigen::Index rest = n - reached;
    const auto stair = compress_rows(drive, couplings.tolerance);
    couplings.smallest_kept = std::min(couplings.smallest_kept, stair.smallest_kept);
    couplings.largest_neglected = std::max(couplings.largest_neglected, stair.largest_neglected);
    if (stair.rank == 0) break;
    a.bottomRows(rest) = stair.q.transpose() * a.bottomRows(rest).eval();
    a.rightCols(rest) = a.rightCols(rest).eval() * stair.q;
    b.bottomRows(rest) = stair.q.transpose() * b.bottomRows(rest).eval();
    c.rightCols(rest) = c.rightCols(rest).eval() * stair.q;
    drive = a.block(reached + stair.rank, reached, rest - stair.rank, stair.rank);
    reached += stair.rank;
  }
  return reached;
}

}  // namespace

MinimalRealisation minimal_realisation(const StateSpace& system,
                                       const MinimalRealisationOptions& options) {
  if (!(options.tolerance >= 0.0) || !(options.tolerance < 1.0)) {
    throw InvalidInput(fmt::format(
        "minimal_realisation: expected a tolerance between 0 and 1, found {}", options.tolerance));
  }
  StateSpace coupled = system;
  coupled.d.setZero();  // feedthrough says nothing about states
  const EvenUnits even = even_units(coupled);
  Eigen::MatrixXd a = even.system.a, b = even.system.b, c = even.system.c;
  Couplings couplings{options.tolerance * even.size, even.size};

  MinimalRealisation result;
  const Eigen::Index n = a.rows();
  const Eigen::Index controllable = reach(a, b, c, couplings);
  result.uncontrollable =
      numerics::eigenvalues(a.bottomRightCorner(n - controllable, n - controllable));
  // Observability is the controllability of the transposed system.
  Eigen::MatrixXd turned = a.topLeftCorner(controllable, controllable).transpose();
  Eigen::MatrixXd from_outputs = c.leftCols(controllable).transpose();
  Eigen::MatrixXd to_inputs = b.topRows(controllable).transpose();
  const Eigen::Index order = reach(turned, from_outputs, to_inputs, couplings);
  const Eigen::Index unseen = controllable - order;
  result.unobservable = numerics::eigenvalues(turned.bottomRightCorner(unseen, unseen));

  result.smallest_kept = couplings.smallest_kept / even.size;
  result.largest_neglected = couplings.largest_neglected / even.size;
  result.system = system;
  if (order == n) return result;
  result.system.a = turned.topLeftCorner(order, order).transpose();
  result.system.b =
      to_inputs.leftCols(order).transpose() * even.input_unit.cwiseInverse().asDiagonal();
  result.system.c =
      even.output_unit.cwiseInverse().asDiagonal() * from_outputs.topRows(order).transpose();
  result.system.states.clear();
  for (Eigen::Index i = 0; i < order; ++i) {
    result.system.states.push_back(fmt::format("{}_{}", options.states, i + 1));
  }
  return result;
}

}  // namespace boresight::plant
