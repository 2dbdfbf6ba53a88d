#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/time_response.hpp>

namespace boresight::plant {
namespace {

using Complex = std::complex<double>;

Complex exponential_less_one(Complex z) {
  const double half = std::sin(0.5 * z.imag());
  return {std::expm1(z.real()) * std::cos(z.imag()) - 2.0 * half * half,
          std::exp(z.real()) * std::sin(z.imag())};
}

// sum of z^i/(i + k)! over i = 0, 1, ...: (e^z - 1)/z for k = 1, (e^z - 1 - z)/z^2 for k = 2.
Complex phi(int k, Complex z) {
  if (std::abs(z) < 0.5) {
    Complex term = k == 1 ? 1.0 : 0.5;
    Complex sum = term;
    for (int i = 1; i <= 17; ++i) {
      term *= z / static_cast<double>(i + k);
      sum += term;
    }
    return sum;
  }
  const Complex first = exponential_less_one(z) / z;
  return k == 1 ? first : (first - 1.0) / z;
}

// The states as inputs and outputs as well, so that the modal form tells how to get from states to
// modes.
StateSpace with_states_driven(const StateSpace& system) {
  StateSpace result = system;
  const Eigen::Index n = system.a.rows(), m = system.b.cols();
  result.b.conservativeResize(n, m + n);
  result.b.rightCols(n).setIdentity();
  result.d.conservativeResize(system.c.rows(), m + n);
  result.d.rightCols(n).setZero();
  result.inputs.clear();
  for (Eigen::Index i = 0; i < m + n; ++i) result.inputs.push_back(std::to_string(i));
  return result;
}

}  // namespace

LinearSimulation::LinearSimulation(const StateSpace& system, double step,
                                   const SimulationOptions& options)
    : states_(system.a.rows()), inputs_(system.b.cols()), outputs_(system.c.rows()) {
  validate(system);
  if (!(step > 0.0) || !std::isfinite(step)) {
    throw InvalidInput(fmt::format("LinearSimulation: expected a step above 0, found {} s", step));
  }
  const bool sampled = system.sample_time > 0.0;
  if (sampled && step != system.sample_time) {
    throw InvalidInput(fmt::format(
        "LinearSimulation: expected the sample time of the system, {} s, as step, found {} s",
        system.sample_time, step));
  }
  shifts_ = options.interpolation == Interpolation::first_order_hold;
  if (sampled && shifts_) {
    throw InvalidInput(
        "LinearSimulation: a first-order hold is for continuous systems; this one is sampled");
  }
  unshifted_ = shifts_;
  prepare_modes(system, step, options);
  if (!modes_) prepare_dense(system, step, options);
}

void LinearSimulation::prepare_modes(const StateSpace& system, double step,
                                     const SimulationOptions& options) {
  ModalForm form;
  try {
    form = modal_form(with_states_driven(system));
  } catch (const NumericalFailure&) {
    condition_ = std::numeric_limits<double>::infinity();
    return;
  }
  condition_ = form.condition;
  if (!(condition_ <= options.largest_condition)) return;

  const Eigen::Index modes = form.poles.size();
  to_modes_ = form.input.rightCols(states_);
  Eigen::MatrixXcd input = form.input.leftCols(inputs_);
  Eigen::MatrixXcd output = form.output;
  Eigen::MatrixXd feedthrough = system.d;
  Eigen::VectorXcd factor = form.poles;
  modal_shift_.resize(modes, inputs_);
  for (Eigen::Index i = 0; i < modes; ++i) {
    if (form.poles[i].imag() > 0.0) output.col(i) *= 2.0;
    if (system.sample_time > 0.0) continue;
    const Complex z = step * form.poles[i];
    factor[i] = std::exp(z);
    modal_shift_.row(i) = step * phi(2, z) * input.row(i);
    input.row(i) *= step * phi(1, z);
    // x[k+1] = factor x[k] + (input - shift) u[k] + shift u[k+1]
    if (shifts_) input.row(i) += (factor[i] - 1.0) * modal_shift_.row(i);
  }
  if (!factor.allFinite() || !input.allFinite()) {
    throw NumericalFailure(fmt::format(
        "LinearSimulation: an unstable mode overflows within one step of {} s; shorten it", step));
  }
  if (shifts_) feedthrough += (output * modal_shift_).real();
  modes_.emplace(factor, input, output, feedthrough);
}

void LinearSimulation::prepare_dense(const StateSpace& system, double step,
                                     const SimulationOptions& options) {
  dense_ = system;
  if (system.sample_time == 0.0) {
    const auto method = options.interpolation == Interpolation::first_order_hold
                            ? SamplingMethod::first_order_hold
                            : SamplingMethod::zero_order_hold;
    dense_ = sample(system, step, method);
    if (shifts_) dense_shift_ = numerics::held_transition(system.a, system.b, step).ramp;
  }
  dense_state_ = Eigen::VectorXd::Zero(states_);
  next_state_ = dense_state_;
}

void LinearSimulation::start_from(const Eigen::VectorXd& state) {
  if (state.size() != states_ || !state.allFinite()) {
    throw InvalidInput(
        fmt::format("LinearSimulation: expected a state of {} finite elements, found {}{}", states_,
                    state.size(), state.allFinite() ? "" : ", not all finite"));
  }
  unshifted_ = shifts_;
  if (modes_) {
    modes_->set_state(to_modes_ * state);
  } else {
    dense_state_ = state;
  }
}

void LinearSimulation::simulate(const Eigen::Ref<const Eigen::MatrixXd>& input,
                                Eigen::Ref<Eigen::MatrixXd> output) {
  if (input.cols() != inputs_ || output.cols() != outputs_ || output.rows() != input.rows()) {
    throw InvalidInput(fmt::format(
        "LinearSimulation: expected samples x {} inputs and samples x {} outputs, found "
        "{} x {} and {} x {}",
        inputs_, outputs_, input.rows(), input.cols(), output.rows(), output.cols()));
  }
  if (!input.allFinite()) {
    throw InvalidInput("LinearSimulation: the input has elements that are not finite");
  }
  if (input.rows() == 0) return;
  const bool shift = unshifted_;
  unshifted_ = false;
  bool finite = false;
  if (modes_) {
    if (shift) {
      modes_->set_state(modes_->state() - modal_shift_ * input.row(0).transpose());
    }
    modes_->run(input, output);
    finite = modes_->has_finite_state();
  } else {
    if (shift) dense_state_.noalias() -= dense_shift_ * input.row(0).transpose();
    for (Eigen::Index k = 0; k < input.rows(); ++k) {
      const auto u = input.row(k).transpose();
      auto y = output.row(k).transpose();
      y.noalias() = dense_.c * dense_state_;
      y.noalias() += dense_.d * u;
      next_state_.noalias() = dense_.a * dense_state_;
      next_state_.noalias() += dense_.b * u;
      dense_state_.swap(next_state_);
    }
    finite = dense_state_.allFinite();
  }
  if (!finite) {
    throw NumericalFailure(
        "LinearSimulation: the response of this unstable system overflows within the record");
  }
}

Eigen::MatrixXd LinearSimulation::simulate(const Eigen::Ref<const Eigen::MatrixXd>& input) {
  Eigen::MatrixXd output(input.rows(), outputs_);
  simulate(input, output);
  return output;
}

}  // namespace boresight::plant
