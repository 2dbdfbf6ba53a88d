#include "peer_family.hpp"

#include <gtest/gtest.h>

#include "random_numbers.hpp"
#include "reference_values.hpp"
#include <boresight/control/equations/lyapunov.hpp>
#include <boresight/numerics/eigenvalues.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::control {
namespace {

using reference::relative_error;

double peer_value(std::string_view item, int modes, std::size_t i) {
  static const nlohmann::json values = reference::peer_values();
  return values.at(std::string(item)).at(std::to_string(modes)).at("val").at(i);
}

TEST(PeerFamily, HasThePointingErrorThatOthersCompute) {
  for (const int modes : {5, 50}) {
    const auto system = reference::channel(reference::peer_closed_loop(modes), "n", "y");
    const auto solution = solve_lyapunov(system.a, system.b * system.b.transpose());
    const double variance = (system.c * solution.covariance * system.c.transpose())(0, 0);
    EXPECT_LT(relative_error(std::sqrt(variance), peer_value("h2", modes, 0)), 1e-9) << modes;
  }
}

TEST(PeerFamily, HasTheFrequencyResponseThatOthersCompute) {
  const auto system = reference::channel(reference::peer_closed_loop(5), "t", "y");
  double highest = 0.0;
  std::complex<double> sum = 0.0;
  for (const double w : reference::peer_frequencies()) {
    const auto response = plant::frequency_response(system, w)(0, 0);
    highest = std::max(highest, std::abs(response));
    sum += response;
  }
  EXPECT_LT(relative_error(highest, peer_value("fr", 5, 0)), 1e-10);
  EXPECT_LT(relative_error(sum.real(), peer_value("fr", 5, 1)), 1e-10);
  EXPECT_LT(relative_error(sum.imag(), peer_value("fr", 5, 2)), 1e-10);
}

TEST(PeerFamily, OpensAndClosesAtTheValveCommand) {
  const auto closed = reference::channel(reference::peer_closed_loop(5), "d", "u");
  const auto open = reference::peer_open_loop(5);
  EXPECT_LT(numerics::spectral_abscissa(closed.a), 0.0);
  for (const double w : {0.01, 0.3, 1.7, 6.36, 11.0, 200.0}) {
    const auto sensitivity = plant::frequency_response(closed, w)(0, 0);
    const auto loop = plant::frequency_response(open, w)(0, 0);
    EXPECT_LT(relative_error(sensitivity, 1.0 / (1.0 + loop)), 1e-9) << w;
  }
}

TEST(PeerFamily, IsTheSameAsModesAroundACore) {
  const auto dense = reference::peer_closed_loop(5);
  const auto modal = reference::peer_modal_system(5);
  const auto assembled = plant::to_state_space(modal);
  for (const auto& input : dense.inputs) {
    for (const auto& output : dense.outputs) {
      const plant::ModalResponse by_modes(modal, input, output);
      for (const double w : {0.02, 1.3, 6.3, 11.0, 44.0, 300.0}) {
        const auto expected =
            plant::frequency_response(reference::channel(dense, input, output), w)(0, 0);
        EXPECT_LT(std::abs(by_modes.at(w) - expected), 1e-10 * std::abs(expected) + 1e-12)
            << input << " to " << output << " at " << w;
        const auto whole =
            plant::frequency_response(reference::channel(assembled, input, output), w)(0, 0);
        EXPECT_LT(std::abs(whole - expected), 1e-10 * std::abs(expected) + 1e-12)
            << input << " to " << output << " at " << w;
      }
    }
  }
}

}  // namespace
}  // namespace boresight::control
