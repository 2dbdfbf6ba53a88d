#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/figures/drawn_controller.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::app {

/// Open loop (Bode, Nyquist, Nichols) and sensitivity at the three breaks with margins, disks and
/// limits; wind torque to boresight with the loops open and closed; spectrum of the boresight error
/// with its rms from the lowest frequency on, each on a grid that resolves the poles of plant and
/// closed loop; and the ensemble_figures.
std::vector<Figure> controller_figures(const DrawnController& drawn);

/// One of several controllers drawn side by side.
struct ComparedController {
  std::string name;
  control::Controller controller;
  double noise_variance = 0.0;  // rad^2 of motor
  /// Of its simulation, which the rms against wind has; of one that was lost the linear rms.
  design::NonlinearEffect effect = {};
  bool simulated() const { return effect.factor != 1.0 || effect.amplitude > 0.0; }
  design::NonlinearEffect drawn() const {
    return std::isfinite(effect.factor) ? effect.for_budgets() : design::NonlinearEffect{};
  }
};

/// Boresight rms of controllers with fixed gains against mean wind speed, with the budgets as lines
/// and marks where the first controller meets them. `curves`: of the first controller; draws its
/// range over the ensemble.
Figure rms_against_wind(const std::string& id, const std::string& section,
                        const design::TrackingProblem& problem,
                        const std::vector<ComparedController>& controllers,
                        const std::vector<design::PointingBudget>& budgets,
                        const std::optional<design::EnsembleCurves>& curves = std::nullopt);

/// Magnitude of the controllers' sensitivities at one loop break, with its constraint.
Figure compared_sensitivities(const std::string& id, const std::string& section,
                              const design::TrackingProblem& problem,
                              const std::vector<ComparedController>& controllers,
                              control::LoopBreak loop_break, double goal);

}  // namespace boresight::app
