#include "accuracy_table.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/control/equations/riccati.hpp>
#include <boresight/control/reduction/balanced_truncation.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/numerics/linear_solve.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/dense_response.hpp>

namespace boresight::reference {

namespace {

void matrix_exponential_rows(AccuracySection& section) {
  SlicotData data("MB05ND.dat");
  const auto n = static_cast<Eigen::Index>(data.scalar(0));
  const Eigen::MatrixXd a = data.next_matrix(n, n);
  const auto moved = numerics::held_transition(a, Eigen::MatrixXd::Identity(n, n), data.scalar(1));
  section.printed("MB05ND", "exp(A t)", flattened(moved.state),
                  flattened(slicot_result("MB05ND.res", "exp(A*DELTA)")));
  section.printed("MB05ND", "its integral", flattened(moved.step),
                  flattened(slicot_result("MB05ND.res", "its integral")));
}

void lyapunov_rows(AccuracySection& section) {
  SlicotData data("SB03OD.dat");
  const auto n = static_cast<Eigen::Index>(data.scalar(0));
  const auto m = static_cast<Eigen::Index>(data.scalar(1));
  const Eigen::MatrixXd a = data.next_matrix(n, n);
  const Eigen::MatrixXd b = data.next_matrix(m, n);
  // A'X + X A = -B'B, and the columns of the Cholesky factor of X.
  const Eigen::MatrixXd x = control::solve_lyapunov(a.transpose(), b.transpose() * b).covariance;
  section.printed("SB03OD", "X", flattened(x),
                  flattened(slicot_result("SB03OD.res", "X = op(U)'*op(U)")));
}

/// The reduced system is printed in states of its own: the Hankel singular values and how many of
/// them are kept do not depend on these.
void truncation_rows(AccuracySection& section) {
  SlicotData data("AB09AD.dat");
  const Eigen::MatrixXd a = data.next_matrix(7, 7), b = data.next_matrix(7, 2),
                        c = data.next_matrix(3, 7);
  const auto reduced = control::truncate_balanced(state_space(a, b, c, Eigen::MatrixXd::Zero(3, 2)),
                                                  {.singular_value_above = data.scalar(4)});
  section.printed("AB09AD", "Hankel singular values",
                  flattened(Eigen::MatrixXd(reduced.hankel_singular_values)),
                  flattened(slicot_result("AB09AD.res", "Hankel singular values HSV are")));
  section.printed("AB09AD", "order", {static_cast<double>(reduced.system.a.rows())},
                  flattened(slicot_result("AB09AD.res", "order of reduced model =")));
}

void riccati_rows(AccuracySection& section) {
  SlicotData data("SB02MD.dat");
  const auto n = static_cast<Eigen::Index>(data.scalar(0));
  const Eigen::MatrixXd a = data.next_matrix(n, n), q = data.next_matrix(n, n),
                        g = data.next_matrix(n, n);
  // G = B R^-1 B' of the example has a one in its last element only.
  const Eigen::MatrixXd b = g.rightCols(1);
  const auto x = control::solve_riccati({a, b, q, Eigen::MatrixXd::Identity(1, 1), {}}).x;
  section.printed("SB02MD", "X", flattened(x),
                  flattened(slicot_result("SB02MD.res", "solution matrix X is")));
}

void response_rows(AccuracySection& section) {
  SlicotData data("TB05AD.dat");
  const auto n = static_cast<Eigen::Index>(data.scalar(0));
  const auto m = static_cast<Eigen::Index>(data.scalar(1));
  const auto p = static_cast<Eigen::Index>(data.scalar(2));
  const std::complex<double> s(data.scalar(3), data.scalar(4));
  const Eigen::MatrixXd a = data.next_matrix(n, n), b = data.next_matrix(n, m),
                        c = data.next_matrix(p, n);
  const auto parts = [](const Eigen::MatrixXcd& gains) {
    std::vector<double> result;
    for (Eigen::Index i = 0; i < gains.rows(); ++i) {
      result.push_back(gains(i, 0).real());
      result.push_back(gains(i, 0).imag());
    }
    return result;
  };
  const auto at_s = [&](const Eigen::MatrixXd& output) {
    return plant::DenseResponse(state_space(a, b, output, Eigen::MatrixXd::Zero(output.rows(), m)))
        .at(s);
  };
  section.printed("TB05AD", "C (sI - A)^-1 B", parts(at_s(c)),
                  flattened(slicot_result("TB05AD.res", "response matrix G(freq)")));
  section.printed("TB05AD", "(sI - A)^-1 B", parts(at_s(Eigen::MatrixXd::Identity(n, n))),
                  flattened(slicot_result("TB05AD.res", "H(inverse)*B")));
  std::vector<double> eigenvalues;
  for (const auto value : numerics::eigenvalues(a)) eigenvalues.push_back(std::abs(value));
  std::vector<PrintedNumber> printed;
  for (const auto& row : slicot_result("TB05AD.res", "Eigenvalues of the state")) {
    printed.push_back({std::abs(row.front().value), row.front().half_unit});
  }
  std::sort(eigenvalues.begin(), eigenvalues.end());
  std::sort(printed.begin(), printed.end(),
            [](const auto& one, const auto& other) { return one.value < other.value; });
  section.printed("TB05AD", "moduli of the eigenvalues", eigenvalues, printed);
}

/// A, B, C, D as the examples give them, one after the other.
plant::StateSpace next_system(SlicotData& data, double n, double m, double p) {
  const auto states = static_cast<Eigen::Index>(n), inputs = static_cast<Eigen::Index>(m),
             outputs = static_cast<Eigen::Index>(p);
  const Eigen::MatrixXd a = data.next_matrix(states, states), b = data.next_matrix(states, inputs),
                        c = data.next_matrix(outputs, states);
  return state_space(a, b, c, data.next_matrix(outputs, inputs));
}

void norm_rows(AccuracySection& section) {
  SlicotData l2("AB13BD.dat");
  const auto unstable = next_system(l2, l2.scalar(0), l2.scalar(1), l2.scalar(2));
  section.printed("AB13BD", "L2 norm", {control::l2_norm(unstable).value},
                  flattened(slicot_result("AB13BD.res", "L2-norm of the system =")));
  SlicotData peaked("AB13DD.dat");
  const auto resonant = next_system(peaked, peaked.scalar(0), peaked.scalar(1), peaked.scalar(2));
  const auto peak = control::peak_gain(resonant);
  section.printed("AB13DD", "peak gain", {peak.lower},
                  flattened(slicot_result("AB13DD.res", "L_infty norm of the system is")));
  section.printed("AB13DD", "peak frequency", {peak.frequency},
                  flattened(slicot_result("AB13DD.res", "peak frequency is")));
}

}  // namespace

AccuracySection slicot_accuracy() {
  AccuracySection section(
      "SLICOT's examples",
      "`slicot/`: the printed results of seven example programs. Where a result depends on the "
      "choice of states, what does not is compared.");
  matrix_exponential_rows(section);
  lyapunov_rows(section);
  truncation_rows(section);
  riccati_rows(section);
  response_rows(section);
  norm_rows(section);
  return section;
}

}  // namespace boresight::reference
