#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <boresight/numerics/balance.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/integration/exponential_collocation.hpp>

namespace boresight::plant {

namespace {

using Complex = std::complex<double>;
constexpr int powers = collocation_stages + 1;
constexpr std::array<double, powers + 1> factorial{1.0, 1.0, 2.0, 6.0, 24.0};

// The states as inputs and outputs as well, so that the modal form tells how to get from states to
// modes and back.
StateSpace with_states_seen(const FeedbackSystem& system) {
  StateSpace result = system.linear;
  const Eigen::Index n = result.a.rows(), inputs = result.b.cols(), outputs = result.c.rows();
  result.b.conservativeResize(n, inputs + n);
  result.b.rightCols(n).setIdentity();
  result.c.conservativeResize(outputs + n, n);
  result.c.bottomRows(n).setIdentity();
  result.d = Eigen::MatrixXd::Zero(outputs + n, inputs + n);
  result.inputs.clear();
  result.outputs.clear();
  for (Eigen::Index i = 0; i < inputs + n; ++i) result.inputs.push_back(std::to_string(i));
  for (Eigen::Index i = 0; i < outputs + n; ++i) result.outputs.push_back(std::to_string(i));
  return result;
}

// What complex mode shapes of a real signal are to the coordinates v: rows of outputs ...
Eigen::MatrixXd real_output(const Eigen::MatrixXcd& output, Eigen::Index pairs) {
  Eigen::MatrixXd result(output.rows(), output.cols() + pairs);
  result << 2.0 * output.leftCols(pairs).real(), output.rightCols(output.cols() - pairs).real(),
      -2.0 * output.leftCols(pairs).imag();
  return result;
}

// ... and columns of inputs.
Eigen::MatrixXd real_input(const Eigen::MatrixXcd& input, Eigen::Index pairs) {
  Eigen::MatrixXd result(input.rows() + pairs, input.cols());
  result << input.real(), input.topRows(pairs).imag();
  return result;
}

// None where the eigenvectors are too nearly dependent.
std::optional<ModalForm> modes_of(const FeedbackSystem& system, double largest_condition) {
  try {
    ModalForm form = modal_form(with_states_seen(system));
    if (form.condition <= largest_condition) return form;
  } catch (const NumericalFailure&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::array<Complex, 5> phi_functions(Complex z) {
  std::array<Complex, 5> phi;
  if (std::abs(z) < 4.0) {
    Complex term = 1.0 / factorial[4];
    phi[4] = term;
    for (int i = 1; i <= 40; ++i) {
      term *= z / static_cast<double>(i + 4);
      phi[4] += term;
    }
    for (std::size_t k = 4; k > 0; --k) phi[k - 1] = z * phi[k] + 1.0 / factorial[k - 1];
    phi[0] = std::exp(z);
    return phi;
  }
  phi[0] = std::exp(z);
  for (std::size_t k = 1; k <= 4; ++k) phi[k] = (phi[k - 1] - 1.0 / factorial[k - 1]) / z;
  return phi;
}

Eigen::Matrix4d collocation_polynomials() {
  Eigen::Matrix4d result = Eigen::Matrix4d::Zero();
  // Row k: product of (s - node)/(place - node) over all nodes but the k-th; the nodes are the
  // collocation points and 0, which the Lagrange polynomials leave out.
  for (int k = 0; k <= collocation_stages; ++k) {
    const double place =
        k < collocation_stages ? collocation_points[static_cast<std::size_t>(k)] : 0.0;
    Eigen::RowVector4d polynomial(1.0, 0.0, 0.0, 0.0);
    for (int j = 0; j < collocation_stages; ++j) {
      if (j == k) continue;
      const double node = collocation_points[static_cast<std::size_t>(j)];
      Eigen::RowVector4d next = -node * polynomial;
      next.tail<3>() += polynomial.head<3>();
      polynomial = next / (place - node);
    }
    result.row(k) = polynomial;
  }
  return result;
}

void CollocationStep::propagate(Eigen::Ref<Eigen::VectorXd> v,
                                Eigen::Ref<Eigen::VectorXd> scratch) const {
  if (transition.size() > 0) {
    scratch.noalias() = transition * v;
    v = scratch;
    return;
  }
  const Eigen::Index modes = factor_real.size(), pairs = factor_imaginary.size();
  auto real = v.head(pairs), imaginary = v.tail(pairs);
  auto turned = scratch.head(pairs);
  turned = factor_imaginary.cwiseProduct(real);
  real = factor_real.head(pairs).cwiseProduct(real) - factor_imaginary.cwiseProduct(imaginary);
  imaginary = factor_real.head(pairs).cwiseProduct(imaginary) + turned;
  v.segment(pairs, modes - pairs).array() *= factor_real.tail(modes - pairs).array();
}

ExponentialCollocation::ExponentialCollocation(const FeedbackSystem& system,
                                               double largest_condition, double horizon)
    : matrices_(feedback_matrices(system)),
      channel_output_(matrices_.channel_output),
      output_(matrices_.output) {
  if (!(horizon >= 0.0) || !std::isfinite(horizon)) {
    throw InvalidInput(fmt::format(
        "ExponentialCollocation: expected a horizon of 0 or more, found {} s", horizon));
  }
  form_ = modes_of(system, largest_condition);
  if (form_) {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(form_->poles.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    const auto real_ones = std::stable_partition(
        order.begin(), order.end(), [&](Eigen::Index i) { return form_->poles[i].imag() > 0.0; });
    pairs_ = real_ones - order.begin();
    form_->poles = form_->poles(order).eval();
    form_->input = form_->input(order, Eigen::all).eval();
    form_->output = form_->output(Eigen::all, order).eval();
    const Eigen::Index n = matrices_.a.rows();
    to_coordinates_ = real_input(form_->input.rightCols(n), pairs_);
    to_state_ = real_output(form_->output.bottomRows(n), pairs_);
    channel_output_ = real_output(form_->output.topRows(channel_output_.rows()), pairs_);
    output_ = real_output(form_->output.middleRows(channel_output_.rows(), output_.rows()), pairs_);
  }
  look_later(horizon);
}

void ExponentialCollocation::look_later(double horizon) {
  const Eigen::Index p = channel_output_.rows();
  later_output_.resize(2 * p, channel_output_.cols());
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double time = i == 0 ? horizon / 3.0 : horizon;
    later_output_.middleRows(i * p, p) =
        form_ ? real_output(form_->output.topRows(p) *
                                (time * form_->poles).array().exp().matrix().asDiagonal(),
                            pairs_)
              : Eigen::MatrixXd(channel_output_ * numerics::matrix_exponential(time * matrices_.a));
  }
  if (!later_output_.allFinite()) {
    throw NumericalFailure(fmt::format(
        "ExponentialCollocation: an unstable linear part overflows within {} s", horizon));
  }
}

Eigen::VectorXd ExponentialCollocation::to_coordinates(const Eigen::VectorXd& state) const {
  return form_ ? to_coordinates_ * state : state;
}

Eigen::VectorXd ExponentialCollocation::to_state(const Eigen::VectorXd& coordinates) const {
  return form_ ? to_state_ * coordinates : coordinates;
}

CollocationStep ExponentialCollocation::step(double length) const {
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw InvalidInput(
        fmt::format("ExponentialCollocation: expected a step above 0, found {} s", length));
  }
  const Eigen::Index n = matrices_.a.rows(), m = matrices_.input.cols(),
                     q = matrices_.channel_input.cols(), p = channel_output_.rows();
  CollocationStep result;
  result.length = length;
  result.start_to_stages.setZero(collocation_stages * p, n + 2 * m);
  result.channels_to_stages.setZero(collocation_stages * p, collocation_stages * q);
  result.drive_to_end.setZero(n, 2 * m + collocation_stages * q);
  result.error_to_stages.setZero(collocation_stages * p, 2 * q);
  result.channels_to_later.setZero(2 * p, collocation_stages * q);
  result.error_to_later.setZero(2 * p, 2 * q);
  if (form_) {
    modal_step(*form_, result);
  } else {
    dense_step(result);
  }
  // The inputs act at once as well.
  for (int j = 0; j < collocation_stages; ++j) {
    const double c = collocation_points[static_cast<std::size_t>(j)];
    auto rows = result.start_to_stages.middleRows(j * p, p);
    rows.middleCols(n, m) += (1.0 - c) * matrices_.input_to_channels;
    rows.rightCols(m) += c * matrices_.input_to_channels;
  }
  if (!result.start_to_stages.allFinite() || !result.drive_to_end.allFinite() ||
      !result.channels_to_stages.allFinite()) {
    throw NumericalFailure(fmt::format(
        "ExponentialCollocation: an unstable linear part overflows within {} s; shorten the step",
        length));
  }
  return result;
}

// Writes what follows at one stage from the integrals over u, n times powers of s = t/h.
// integrals[k]: coordinates x (inputs, then channels).
void ExponentialCollocation::write_stage(
    CollocationStep& step, int stage, const std::array<Eigen::MatrixXd, powers>& integrals) const {
  static const Eigen::Matrix4d polynomials = collocation_polynomials();
  const Eigen::Index n = matrices_.a.rows(), m = matrices_.input.cols(),
                     q = matrices_.channel_input.cols(), p = channel_output_.rows();
  const Eigen::MatrixXd ramp = integrals[1].leftCols(m);
  const Eigen::MatrixXd fall = integrals[0].leftCols(m) - ramp;
  auto from_start = step.start_to_stages.middleRows(stage * p, p);
  from_start.middleCols(n, m) = channel_output_ * fall;
  from_start.rightCols(m) = channel_output_ * ramp;
  const bool end = stage == collocation_stages - 1;
  if (end) step.drive_to_end.leftCols(2 * m) << fall, ramp;
  for (int k = 0; k <= collocation_stages; ++k) {
    Eigen::MatrixXd driven = Eigen::MatrixXd::Zero(n, q);
    for (std::size_t power = 0; power < powers; ++power) {
      driven += polynomials(k, static_cast<Eigen::Index>(power)) * integrals[power].rightCols(q);
    }
    if (k == collocation_stages) {
      step.error_to_stages.block(stage * p, 0, p, q) = channel_output_ * driven;
      if (end) step.error_to_later.leftCols(q) = later_output_ * driven;
    } else {
      step.channels_to_stages.block(stage * p, k * q, p, q) = channel_output_ * driven;
      if (end) {
        step.drive_to_end.middleCols(2 * m + k * q, q) = driven;
        step.channels_to_later.middleCols(k * q, q) = later_output_ * driven;
      }
    }
  }
  step.error_to_stages.block(stage * p, q, p, q) = channel_output_ * integrals[0].rightCols(q);
  if (end) step.error_to_later.rightCols(q) = later_output_ * integrals[0].rightCols(q);
}

void ExponentialCollocation::modal_step(const ModalForm& form, CollocationStep& result) const {
  const Eigen::Index n = matrices_.a.rows(), m = matrices_.input.cols(),
                     q = matrices_.channel_input.cols(), p = channel_output_.rows();
  const Eigen::Index modes = form.poles.size();
  for (int j = 0; j < collocation_stages; ++j) {
    const double time = collocation_points[static_cast<std::size_t>(j)] * result.length;
    Eigen::VectorXcd factor(modes);
    std::array<Eigen::MatrixXcd, powers> integrals;
    integrals.fill(form.input.leftCols(m + q));
    for (Eigen::Index i = 0; i < modes; ++i) {
      const auto phi = phi_functions(form.poles[i] * time);
      factor[i] = phi[0];
      double weight = time;
      for (std::size_t power = 0; power < powers; ++power) {
        integrals[power].row(i) *= weight * factorial[power] * phi[power + 1];
        weight *= collocation_points[static_cast<std::size_t>(j)];
      }
    }
    std::array<Eigen::MatrixXd, powers> real_integrals;
    for (std::size_t power = 0; power < powers; ++power) {
      real_integrals[power] = real_input(integrals[power], pairs_);
    }
    result.start_to_stages.block(j * p, 0, p, n) =
        real_output(form.output.topRows(p) * factor.asDiagonal(), pairs_);
    write_stage(result, j, real_integrals);
    result.factor_real = factor.real();
    result.factor_imaginary = factor.head(pairs_).imag();
  }
}

void ExponentialCollocation::dense_step(CollocationStep& result) const {
  const Eigen::Index n = matrices_.a.rows(), m = matrices_.input.cols(),
                     q = matrices_.channel_input.cols(), p = channel_output_.rows();
  const Eigen::VectorXd scale = numerics::balancing_scale(matrices_.a);
  const Eigen::MatrixXd even = scale.cwiseInverse().asDiagonal() * matrices_.a * scale.asDiagonal();
  Eigen::MatrixXd drive(n, m + q);
  drive << matrices_.input, matrices_.channel_input;
  drive = (scale.cwiseInverse().asDiagonal() * drive).eval();
  // The result is linear in each column: a large one must not add squarings to the exponential.
  Eigen::VectorXd unit = Eigen::VectorXd::Ones(m + q);
  for (Eigen::Index i = 0; i < m + q; ++i) {
    const double size = drive.col(i).lpNorm<1>();
    if (size > 0.0) unit[i] = std::exp2(std::round(std::log2(size)));
    drive.col(i) /= unit[i];
  }
  for (int j = 0; j < collocation_stages; ++j) {
    // exp of [A t, B, 0, 0, 0; 0, 0, I, 0, 0; ...] holds the integrals of exp(A t (1 - s)) B s^k/k!
    // over 0..1 (C. F. Van Loan, IEEE Trans. Automatic Control 23(3), 1978).
    const double c = collocation_points[static_cast<std::size_t>(j)];
    const double time = c * result.length;
    Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(n + powers * (m + q), n + powers * (m + q));
    blocks.topLeftCorner(n, n) = time * even;
    blocks.block(0, n, n, m + q) = drive;
    for (Eigen::Index i = n; i < n + (powers - 1) * (m + q); ++i) blocks(i, i + m + q) = 1.0;
    const Eigen::MatrixXd exponential = numerics::matrix_exponential(blocks);
    std::array<Eigen::MatrixXd, powers> integrals;
    double weight = time;
    for (std::size_t power = 0; power < powers; ++power) {
      const Eigen::Index column = n + static_cast<Eigen::Index>(power) * (m + q);
      integrals[power] =
          weight * factorial[power] *
          (scale.asDiagonal() * exponential.block(0, column, n, m + q) * unit.asDiagonal());
      weight *= c;
    }
    result.transition =
        scale.asDiagonal() * exponential.topLeftCorner(n, n) * scale.cwiseInverse().asDiagonal();
    result.start_to_stages.block(j * p, 0, p, n) = channel_output_ * result.transition;
    write_stage(result, j, integrals);
  }
}

}  // namespace boresight::plant
