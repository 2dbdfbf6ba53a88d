#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/app/figures/figure.hpp>
#include <boresight/control/analysis/margins.hpp>
#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/ensembles/ensemble_curves.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/design/problem/tracking_problem.hpp>
#include <boresight/plant/antenna/plant_response.hpp>

namespace boresight::app {

/// A controller on a plant, as its figures are to show it.
struct DrawnController {
  std::string id;       // what the figures' ids begin with
  std::string section;  // heading under which they stand
  std::string name;     // of the controller, in captions: "PI with lag"
  design::TrackingProblem problem;
  control::Controller controller;
  std::array<control::Margins, 3> margins;  // by control::loop_breaks
  design::Constraints goals;
  double noise_variance = 0.0;  // of the boresight, rad^2 of motor
  std::optional<design::EnsembleCurves> curves = std::nullopt;
};

/// The controller on its grid: rad/s, responses, loop gains by break.
struct ControllerResponses {
  Eigen::ArrayXd frequency;
  plant::PlantResponse plant;
  std::array<Eigen::ArrayXcd, 3> gain;
};
ControllerResponses controller_responses(const DrawnController& drawn);

/// Frequencies (rad/s) over the analysis band that resolve the poles of plant and closed loop.
Eigen::ArrayXd controller_grid(const design::TrackingProblem& problem,
                               const control::Controller& controller);

/// From where loops begin to reject wind to the end of the band of the rms.
FigureAxis shown_frequencies(const design::TrackingProblem& problem);

/// A figure without caption and panels, over shown_frequencies.
Figure controller_figure(const DrawnController& drawn, const char* id, const char* title);

/// Controller, wind and plant, in a sentence.
std::string controller_conditions(const DrawnController& drawn);

/// The name of a member of control::loop_breaks.
std::string break_name(std::size_t loop_break);

/// The breaks that the controller has (control::has_break), as places of control::loop_breaks.
std::vector<std::size_t> shown_breaks(const DrawnController& drawn);
/// "at the three breaks", or at the one of a state space.
std::string at_breaks(const DrawnController& drawn);

}  // namespace boresight::app
