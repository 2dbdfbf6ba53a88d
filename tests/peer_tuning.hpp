#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "peer_loop.hpp"
#include <boresight/control/analysis/h2_norm.hpp>
#include <boresight/control/analysis/peak_gain.hpp>
#include <boresight/control/analysis/spectral_rms.hpp>
#include <boresight/design/tuning/feasible_search.hpp>
#include <boresight/numerics/eigenvalues.hpp>

/// The peers' tuning: least rms of the pointing error with the Ms at the valve at most 2,
/// over the logarithms of four gains within the peers' bounds.
namespace boresight::reference {

/// Where the peers start.
inline constexpr PeerGains peer_tuning_start{0.2, 1.2, 0.3, 0.03};
/// What two of them agree on with five modes, arcsec. It is a local optimum: with the rate integral
/// at its lower bound 2.44083 is reached, krp 0.531, kpp 3.75, kpi 17.2, but a pole at -0.002 1/s.
inline constexpr double peer_tuned_rms = 2.94252786;
inline constexpr double peer_peak_limit = 2.0;

struct PeerTuning {
  PeerGains gains;
  double rms = 0.0;   // arcsec, as the search saw it
  double peak = 0.0;  // likewise
  long evaluations = 0;
};

inline std::vector<double> logarithms(const PeerGains& gains) {
  return {std::log(gains.rate_gain), std::log(gains.rate_integral), std::log(gains.position_gain),
          std::log(gains.position_integral)};
}

inline PeerGains peer_gains(const std::vector<double>& logarithm) {
  return {std::exp(logarithm[0]), std::exp(logarithm[1]), std::exp(logarithm[2]),
          std::exp(logarithm[3])};
}

/// From the logarithms of the controller's gains, kr, kri/kr, kp, kpi/kp, to those of the peers'.
inline void to_peer_gradient(const std::array<double, control::max_gains>& by_controller,
                             double factor, double* by_peer_gain) {
  by_peer_gain[0] = factor * (by_controller[0] - by_controller[1]);
  by_peer_gain[1] = factor * by_controller[1];
  by_peer_gain[2] = factor * (by_controller[2] - by_controller[3]);
  by_peer_gain[3] = factor * by_controller[3];
}

inline design::ConstrainedProblem peer_tuning_problem(control::LoopEvaluator& evaluator) {
  constexpr std::size_t gains = 4, peaks = control::PeakList::maximum;
  design::ConstrainedProblem problem;
  problem.lower.assign(gains, std::log(1e-3));
  problem.upper.assign(gains, std::log(1e2));
  problem.constraints = peaks;
  problem.evaluate = [&evaluator](const std::vector<double>& point,
                                  design::ConstrainedValues& values) {
    const auto found = evaluator.evaluate(peer_controller(peer_gains(point)), true);
    if (found.unstable_closed_loop != 0) return false;
    values.objectives[0] = 0.5 * std::log(found.wind_variance);
    to_peer_gradient(found.wind_log_gradient, 0.5 / found.wind_variance,
                     values.objective_gradients.data());
    const auto& list = found.peaks[static_cast<std::size_t>(control::LoopBreak::valve_command)];
    std::ranges::fill(values.constraints, -1.0);
    std::ranges::fill(values.constraint_gradients, 0.0);
    for (std::size_t i = 0; i < list.size(); ++i) {
      values.constraints[i] = std::log(list[i].magnitude / peer_peak_limit);
      to_peer_gradient(list[i].log_gradient, 1.0, values.constraint_gradients.data() + gains * i);
    }
    return true;
  };
  return problem;
}

/// One tuning with its set-up; nothing where no controller within the limit was met.
inline std::optional<PeerTuning> tune_peer(Eigen::Index modes,
                                           const PeerGains& start = peer_tuning_start) {
  control::LoopEvaluator evaluator = peer_evaluator(modes);
  evaluator.look_at({false, true, false});
  design::FeasibleSearch search(peer_tuning_problem(evaluator));
  const auto best =
      search.search_from(search.backtrack(logarithms(start), logarithms(peer_tuning_start)));
  if (!best) return std::nullopt;
  return PeerTuning{peer_gains(best->point), peer_rms(1.0) * std::exp(best->cost),
                    peer_peak_limit * std::exp(best->violation), search.evaluations()};
}

/// The same controller evaluated on the dense state space: eigenvalues, Lyapunov's equation,
/// Hamiltonian.
struct PeerEvaluation {
  double abscissa = 0.0;  // 1/s
  double rms = 0.0;       // arcsec
  double peak = 0.0;      // upper end of its bracket
};

inline PeerEvaluation evaluate_peer(Eigen::Index modes, const PeerGains& gains) {
  const plant::StateSpace closed = peer_closed_loop(modes, gains);
  PeerEvaluation plant_evaluation;
  plant_evaluation.abscissa = numerics::spectral_abscissa(closed.a);
  if (!(plant_evaluation.abscissa < 0.0)) return plant_evaluation;
  plant_evaluation.rms = control::h2_norm(channel(closed, "n", "y")).value;
  plant_evaluation.peak = control::peak_gain(channel(closed, "d", "u")).upper;
  return plant_evaluation;
}

/// rms and peak without dense matrices; the abscissa is left out.
inline PeerEvaluation evaluate_peer_by_modes(Eigen::Index modes, const PeerGains& gains) {
  const auto closed = peer_modal_system(modes, gains);
  PeerEvaluation plant_evaluation;
  plant_evaluation.rms = control::spectral_rms(plant::ModalResponse(closed, "n", "y")).rms;
  plant_evaluation.peak = control::peak_gain(closed, "d", "u").upper;
  return plant_evaluation;
}

}  // namespace boresight::reference
