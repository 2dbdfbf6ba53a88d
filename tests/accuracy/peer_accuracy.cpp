#include <cmath>

#include "../peer_modal_family.hpp"
#include "accuracy_table.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/modal_margins.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/numerics/matrix_exponential.hpp>
#include <boresight/plant/linear/dense_response.hpp>
#include <boresight/plant/linear/sampling.hpp>
#include <boresight/plant/linear/time_response.hpp>
#include <boresight/plant/modal/modal_response.hpp>

namespace boresight::reference {

namespace {

constexpr double step = 1e-3;

/// One number of modes: what the file holds for it, and rows named after it.
class PeerRows {
 public:
  PeerRows(AccuracySection& section, const nlohmann::json& file, int modes)
      : section_(section), file_(file), modes_(modes) {}

  bool has(const std::string& item) const {
    return file_.at(item).contains(std::to_string(modes_));
  }
  void compare(const std::string& item, const std::string& quantity,
               const std::vector<double>& found, double tolerance = 1e-8) const {
    auto reference = entry(item).at("val").get<std::vector<double>>();
    reference.resize(found.size());
    section_.numbers(name(), quantity, found, reference, 16, tolerance);
  }
  /// A peak beside the peers' after refinement by golden section.
  void compare_refined(const std::string& item, const std::string& quantity, double gain,
                       double frequency) const {
    const auto& refined = entry(item).at("refined");
    section_.number(name(), quantity, gain, refined.at(0), 11, 1e-8);
    section_.number(name(), quantity + ": frequency", frequency, refined.at(1), 8, 1e-6);
  }
  const nlohmann::json& entry(const std::string& item) const {
    return file_.at(item).at(std::to_string(modes_));
  }
  std::string name() const { return std::to_string(modes_) + " modes"; }

 private:
  AccuracySection& section_;
  const nlohmann::json& file_;
  int modes_;
};

std::vector<double> summary(const Eigen::ArrayXcd& response) {
  return {response.abs().maxCoeff(), response.real().sum(), response.imag().sum()};
}

void response_rows(const PeerRows& rows, int modes, const plant::StateSpace& closed) {
  const Eigen::ArrayXd w = peer_frequencies();
  Eigen::ArrayXcd response(w.size());
  plant::ModalResponse(peer_modal_system(modes), "t", "y").evaluate(w, response);
  rows.compare("fr", "1000-point response by modes: max, sums", summary(response));
  plant::DenseResponse(channel(closed, "t", "y")).evaluate(w, response);
  rows.compare("fr", "1000-point response, dense: max, sums", summary(response));
}

void rms_rows(const PeerRows& rows, int modes, const plant::StateSpace& noise) {
  const plant::ModalResponse response(peer_modal_system(modes), "n", "y");
  rows.compare("h2", "rms, by spectrum", {control::spectral_rms(response).rms});
  rows.compare("h2", "rms, by covariance", {control::h2_norm(noise).value});
}

void peak_rows(const PeerRows& rows, int modes, const plant::StateSpace& closed) {
  const auto modal = peer_modal_system(modes);
  for (const auto& [item, input, output, text] :
       {std::tuple{"hinf_S", "d", "u", "Ms"}, std::tuple{"hinf_W", "t", "y", "peak of t to y"}}) {
    const auto peak = control::peak_gain(modal, input, output);
    rows.compare_refined(item, text, peak.lower, peak.frequency);
    if (modes > 50) continue;  // minutes
    const auto dense = control::peak_gain(channel(closed, input, output));
    rows.compare_refined(item, std::string(text) + ", dense", dense.lower, dense.frequency);
  }
}

/// Gain margins with their frequencies, phase margin with its, numbers of crossovers.
std::vector<double> summary(const control::Margins& margins) {
  const auto where = [&](double gain_margin) {
    for (const auto& crossover : margins.phase_crossovers) {
      if (crossover.gain_margin == gain_margin) return crossover.frequency;
    }
    return std::nan("");
  };
  return {margins.increasing_gain_margin,
          where(margins.increasing_gain_margin),
          margins.decreasing_gain_margin,
          where(margins.decreasing_gain_margin),
          margins.phase_margin_deg,
          margins.gain_crossovers.at(0).frequency,
          static_cast<double>(margins.phase_crossovers.size()),
          static_cast<double>(margins.gain_crossovers.size())};
}

void margin_rows(const PeerRows& rows, int modes) {
  const plant::ModalResponse loop(peer_modal_open_loop(modes), "d", "loop_gain");
  rows.compare("mar", "margins and numbers of crossovers, by modes",
               summary(control::margins(loop)));
  if (modes > 50) return;  // minutes
  rows.compare("mar", "the same, dense", summary(control::margins(peer_open_loop(modes))));
}

void simulation_rows(const PeerRows& rows, const plant::StateSpace& system) {
  const Eigen::MatrixXd noise = peer_noise(600'000) / std::sqrt(step);
  for (const auto& [item, interpolation, text] :
       {std::tuple{"lsim", plant::Interpolation::zero_order_hold, "held"},
        std::tuple{"lsim_foh", plant::Interpolation::first_order_hold, "straight"}}) {
    if (!rows.has(item)) continue;
    const Eigen::MatrixXd output =
        plant::LinearSimulation(system, step, {.interpolation = interpolation}).simulate(noise);
    const double rms = std::sqrt(output.squaredNorm() / static_cast<double>(output.rows()));
    rows.compare(item, std::string("600 000 steps, ") + text + ": rms, last, max",
                 {rms, output(output.rows() - 1, 0), output.cwiseAbs().maxCoeff()});
  }
}

}  // namespace

AccuracySection peer_accuracy() {
  AccuracySection section(
      "The peers' antenna family",
      "`peers.json`: an antenna servo with 5, 50 and 500 structural modes (20, 110 and 1010 "
      "states), on which at least two of SLICOT, LAPACK, SciPy and Octave agree (at 500 modes some "
      "values are one program's).");
  const auto file = peer_values();
  for (const int modes : {5, 50, 500}) {
    const PeerRows rows(section, file, modes);
    const plant::StateSpace closed = peer_closed_loop(modes);
    const plant::StateSpace noise = channel(closed, "n", "y");
    rms_rows(rows, modes, noise);
    peak_rows(rows, modes, closed);
    margin_rows(rows, modes);
    response_rows(rows, modes, closed);
    simulation_rows(rows, noise);
    const Eigen::MatrixXd moved = numerics::matrix_exponential(noise.a * step);
    rows.compare("expm", "exp(A T): norm, trace", {moved.norm(), moved.trace()});
    const auto held = plant::sample(noise, step);
    rows.compare("c2d", "zero-order hold: norms of A, B", {held.a.norm(), held.b.norm()});
  }
  return section;
}

}  // namespace boresight::reference
