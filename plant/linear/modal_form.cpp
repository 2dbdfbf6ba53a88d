#include <algorithm>
#include <limits>
#include <vector>

#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/plant/linear/balanced_state_space.hpp>
#include <boresight/plant/linear/modal_form.hpp>

namespace boresight::plant {
namespace {

// left^H A right/left^H right - pole.
std::complex<double> rayleigh_correction(const Eigen::MatrixXd& a,
                                         const Eigen::Ref<const Eigen::VectorXcd>& left,
                                         const Eigen::Ref<const Eigen::VectorXcd>& right,
                                         std::complex<double> pole) {
  using Wide = std::complex<long double>;
  Wide quotient = 0.0L, scale = 0.0L;
  for (Eigen::Index row = 0; row < a.rows(); ++row) {
    Wide product = -Wide(pole) * Wide(right[row]);
    for (Eigen::Index column = 0; column < a.cols(); ++column) {
      product += static_cast<long double>(a(row, column)) * Wide(right[column]);
    }
    quotient += std::conj(Wide(left[row])) * product;
    scale += std::conj(Wide(left[row])) * Wide(right[row]);
  }
  const std::complex<double> correction(quotient / scale);
  return pole.imag() > 0.0 ? correction : correction.real();
}

}  // namespace

ModalForm modal_form(const StateSpace& system) {
  const StateSpace even = balanced(system);
  ModalForm form;
  form.feedthrough = system.d;
  form.sample_time = system.sample_time;
  if (system.states.empty()) {
    form.input.resize(0, system.d.cols());
    form.output.resize(system.d.rows(), 0);
    return form;
  }
  const numerics::EigenDecomposition eigen = numerics::eigen_decomposition(even.a);
  form.condition = 1.0 / eigen.reciprocal_condition;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    if (eigen.values[i].imag() >= 0.0) kept.push_back(i);
  }
  const auto count = static_cast<Eigen::Index>(kept.size());
  form.poles = eigen.values(kept);
  form.pole_correction.resize(count);
  form.pole_error.resize(count);
  form.vector_error.resize(count);
  const Eigen::MatrixXd magnitude = even.a.cwiseAbs();
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr auto fine = static_cast<double>(std::numeric_limits<long double>::epsilon());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Index from = kept[static_cast<std::size_t>(i)];
    const auto right = eigen.right.col(from), left = eigen.left.col(from);
    form.pole_correction[i] = rayleigh_correction(even.a, left, right, form.poles[i]);
    const double size = left.cwiseAbs().dot(magnitude * right.cwiseAbs());
    double gap = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
      if (k != from) gap = std::min(gap, std::abs(eigen.values[k] - eigen.values[from]));
    }
    form.vector_error[i] = 4.0 * epsilon * (1.0 + size / gap);
    form.pole_error[i] = 4.0 * fine * size + form.vector_error[i] * 4.0 * epsilon * size;
  }
  form.input = eigen.left(Eigen::all, kept).adjoint() * even.b;
  form.output = even.c * eigen.right(Eigen::all, kept);
  return form;
}

Eigen::MatrixXcd modal_response(const ModalForm& form, std::complex<double> s) {
  Eigen::MatrixXcd response = form.feedthrough.cast<std::complex<double>>();
  for (Eigen::Index i = 0; i < form.poles.size(); ++i) {
    const Eigen::MatrixXcd residue = form.output.col(i) * form.input.row(i);
    response += residue / (s - form.poles[i]);
    if (form.poles[i].imag() > 0.0) {
      response += residue.conjugate() / (s - std::conj(form.poles[i]));
    }
  }
  return response;
}

}  // namespace boresight::plant
