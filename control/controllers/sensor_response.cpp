#include <algorithm>
#include <cmath>

#include <boresight/control/controllers/sensor_response.hpp>
#include <boresight/numerics/real_schur.hpp>

namespace boresight::control {

using Complex = std::complex<double>;

double hold_amplitude(double frequency, double sample_time) {
  const double half = 0.5 * frequency * sample_time;
  return half < 1e-8 ? 1.0 : std::sin(half) / half;
}

SensorResponse::SensorResponse(const plant::StateSpace& controller)
    : sample_time_(controller.sample_time) {
  const Eigen::Index states = controller.a.rows();
  // In z - 1, so that slow poles next to z = 1 keep their digits.
  const auto identity = Eigen::MatrixXd::Identity(states, states);
  auto [t, u] = numerics::complex_schur(numerics::real_schur(controller.a - identity));
  schur_ = std::move(t);
  output_ = controller.c.row(0) * u;
  input_ = Eigen::MatrixXcd::Zero(states, static_cast<Eigen::Index>(sensor_names.size()));
  for (std::size_t k = 0; k < sensor_names.size(); ++k) {
    const auto found = std::ranges::find(controller.inputs, sensor_names.at(k));
    if (found == controller.inputs.end()) continue;
    const auto column = static_cast<Eigen::Index>(found - controller.inputs.begin());
    input_.col(static_cast<Eigen::Index>(k)) = u.adjoint() * controller.b.col(column);
    feedthrough_.at(k) = controller.d(0, column);
  }
}

std::array<Complex, 3> SensorResponse::at(double frequency) const {
  const double half = 0.5 * frequency * sample_time_;
  const double sine = std::sin(half);
  const Complex z_less_one{-2.0 * sine * sine, std::sin(2.0 * half)};
  const double hold = hold_amplitude(frequency, sample_time_);
  // y (z - 1 - T) = C U, from the first state on: y times the inputs is the response.
  const Eigen::Index states = schur_.rows();
  Eigen::RowVectorXcd y = output_;
  std::array<Complex, 3> response{feedthrough_[0], feedthrough_[1], feedthrough_[2]};
  for (Eigen::Index i = 0; i < states; ++i) {
    y[i] /= z_less_one - schur_(i, i);
    for (Eigen::Index j = i + 1; j < states; ++j) y[j] += y[i] * schur_(i, j);
    for (std::size_t k = 0; k < response.size(); ++k) {
      response.at(k) += y[i] * input_(i, static_cast<Eigen::Index>(k));
    }
  }
  for (Complex& value : response) value *= hold;
  return response;
}

}  // namespace boresight::control
