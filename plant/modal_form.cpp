#include <vector>

#include <boresight/plant/balance.hpp>
#include <boresight/plant/eigenvalues.hpp>
#include <boresight/plant/modal_form.hpp>

namespace boresight::plant {

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
  const EigenDecomposition eigen = eigen_decomposition(even.a);
  form.condition = 1.0 / eigen.reciprocal_condition;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < eigen.values.size(); ++i) {
    if (eigen.values[i].imag() >= 0.0) kept.push_back(i);
  }
  form.poles = eigen.values(kept);
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
