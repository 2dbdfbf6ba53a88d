#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/nonlinear_effect.hpp>
#include <boresight/design/problem/pointing_budget.hpp>
#include <boresight/design/problem/tracking_problem.hpp>

namespace boresight::app {

/// A law on a plant, as its figures are to show it.
struct DrawnLaw {
  std::string id;       // what the figures' ids begin with
  std::string section;  // heading under which they stand
  std::string name;     // of the law, in captions: "PI with lag"
  design::TrackingProblem problem;
  control::ControlLaw law;
  std::array<control::Margins, 3> margins;  // by control::loop_breaks
  design::HardGoals goals;
  double noise_variance = 0.0;  // of the beam, rad^2 of motor
};

/// Open loop (Bode and Nyquist) and sensitivity at the three breaks with crossovers, disks and
/// goals; wind torque to beam with the loops open and closed; spectrum of the beam's error with its
/// rms from the lowest frequency on. Each on a grid that resolves the poles of plant and closed
/// loop.
std::vector<Figure> law_figures(const DrawnLaw& drawn);

/// One of several laws that are drawn side by side.
struct ComparedLaw {
  std::string name;
  control::ControlLaw law;
  double noise_variance = 0.0;  // rad^2 of motor
  /// Of its simulation, which the rms against wind has; of one that was lost the linear rms.
  design::NonlinearEffect effect = {};
  bool simulated() const { return effect.factor != 1.0 || effect.amplitude > 0.0; }
  design::NonlinearEffect drawn() const {
    return std::isfinite(effect.factor) ? effect.for_budgets() : design::NonlinearEffect{};
  }
};

/// Beam rms of laws with their gains held against mean wind speed, with the budgets as lines and
/// marks where the first law meets them.
Figure rms_against_wind(const std::string& id, const std::string& section,
                        const design::TrackingProblem& problem,
                        const std::vector<ComparedLaw>& laws,
                        const std::vector<design::PointingBudget>& budgets);

/// Magnitudes of the sensitivity of laws at one break, with its goal.
Figure compared_sensitivities(const std::string& id, const std::string& section,
                              const design::TrackingProblem& problem,
                              const std::vector<ComparedLaw>& laws, control::LoopBreak loop_break,
                              double goal);

}  // namespace boresight::app
