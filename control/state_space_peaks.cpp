#include <algorithm>
#include <cmath>
#include <numbers>

#include <boresight/control/closed_loop.hpp>
#include <boresight/control/golden_section.hpp>
#include <boresight/control/state_space_peaks.hpp>
#include <boresight/plant/eigenvalues.hpp>
#include <boresight/plant/linear_solve.hpp>

namespace boresight::control {
namespace {

using Complex = std::complex<double>;

// Poles and residues from the valve command to tachometer and encoder.
class PlantExpansion {
 public:
  explicit PlantExpansion(const plant::AntennaPlant& antenna) {
    const auto system = plant::to_state_space(antenna);
    const auto eigen = plant::eigen_decomposition(system.a);
    poles_ = eigen.values;
    const Eigen::VectorXcd drive =
        eigen.left.adjoint() * system.b.col(plant::input_index(system, "valve_command"));
    const auto residues = [&](const char* output) -> Eigen::VectorXcd {
      const Eigen::RowVectorXcd row =
          system.c.row(plant::output_index(system, output)) * eigen.right;
      return row.transpose().cwiseProduct(drive);
    };
    tachometer_ = residues("tachometer");
    encoder_ = residues("encoder");
  }
  std::array<Complex, 2> at(Complex s) const {
    const Eigen::ArrayXcd inverse = (s - poles_.array()).inverse();
    return {(tachometer_.array() * inverse).sum(), (encoder_.array() * inverse).sum()};
  }

 private:
  Eigen::VectorXcd poles_, tachometer_, encoder_;
};

}  // namespace

std::array<SensitivityPeak, 3> state_space_peaks(const plant::AntennaPlant& antenna,
                                                 const ControlLaw& law, double delay,
                                                 double lowest_frequency,
                                                 double highest_frequency) {
  constexpr double two_pi = 2.0 * std::numbers::pi;
  const PlantExpansion expansion(antenna);
  const auto controller = to_state_space(law);
  const Eigen::Index tachometer = plant::input_index(controller, "tachometer");
  const Eigen::Index encoder = plant::input_index(controller, "encoder");
  const Eigen::Index demand = plant::output_index(controller, "valve_demand");

  const auto sensitivity = [&](double log_frequency) {
    const double w = std::exp(log_frequency);
    const auto [to_tachometer, to_encoder] = expansion.at({0.0, w});
    const Eigen::MatrixXcd response = plant::frequency_response(controller, w);
    const Complex dead_time = std::polar(1.0, -w * delay);
    const Complex rate_return = 1.0 - response(demand, tachometer) * dead_time * to_tachometer;
    const Complex both_return = rate_return - response(demand, encoder) * dead_time * to_encoder;
    return std::array{1.0 / std::abs(rate_return), 1.0 / std::abs(both_return),
                      std::abs(rate_return / both_return)};
  };

  std::vector<double> grid;
  constexpr int points_per_decade = 150;
  const double low = std::log(two_pi * lowest_frequency);
  const double high = std::log(two_pi * highest_frequency);
  const int count =
      static_cast<int>(std::ceil((high - low) / std::numbers::ln10 * points_per_decade));
  for (int i = 0; i <= count; ++i) grid.push_back(low + (high - low) * i / count);
  for (const Complex pole : plant::eigenvalues(closed_loop(antenna, law, delay).a)) {
    if (pole.imag() <= 0.0 || std::abs(pole.real()) > 0.3 * std::abs(pole)) continue;
    for (int k = -10; k <= 10; ++k) {
      const double w = pole.imag() + 0.4 * k * std::abs(pole.real());
      if (w > 0.0 && std::log(w) > low && std::log(w) < high) grid.push_back(std::log(w));
    }
  }
  std::sort(grid.begin(), grid.end());

  std::vector<std::array<double, 3>> values;
  values.reserve(grid.size());
  for (const double x : grid) values.push_back(sensitivity(x));
  std::array<SensitivityPeak, 3> peaks;
  for (std::size_t b = 0; b < 3; ++b) {
    peaks[b].magnitude = 1.0;
    for (std::size_t i = 1; i + 1 < grid.size(); ++i) {
      const double here = values[i][b];
      if (here < values[i - 1][b] || here <= values[i + 1][b] || here < 0.98 * peaks[b].magnitude) {
        continue;
      }
      const double at = golden_section_maximum([&](double x) { return sensitivity(x)[b]; },
                                               grid[i - 1], grid[i + 1], 1e-9);
      const double magnitude = sensitivity(at)[b];
      if (magnitude > peaks[b].magnitude) peaks[b] = {std::exp(at), magnitude, {}};
    }
  }
  return peaks;
}

}  // namespace boresight::control
