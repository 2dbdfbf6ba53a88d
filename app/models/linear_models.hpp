#pragma once

#include <functional>
#include <optional>
#include <string>

#include <boresight/app/report/report.hpp>
#include <boresight/plant/linear/state_space.hpp>

namespace boresight::app {

/// A controller in a form for other programs. Inputs and outputs as in docs/benchmark-protocol.md.
struct ControllerModels {
  std::string description;  // the controller, in words
  control::Controller controller;
  double dead_time = 0.0;        // s, of the loop
  plant::StateSpace continuous;  // controller; the dead time is the loop's
  /// In the sampled form that the antenna's computer runs: prewarped, Tustin, its sample time two
  /// thirds of the dead time. Hold and one sample of computing are the loop's.
  plant::StateSpace sampled_controller;
  /// Plant and continuous controller with the dead time as a rational function of order
  /// control::delay_order: control::closed_loop.
  plant::StateSpace closed_loop;
};

/// The linear models behind a report: SI at the motor shaft.
struct LinearModels {
  plant::AntennaPlant antenna;
  plant::StateSpace plant;  // plant::to_state_space(antenna)
  double gear_ratio = 1.0;  // motor turns per turn of the antenna
  std::optional<ControllerModels> loop;
  /// Of a StateSpaceStudy or of the report's controllers, recommended or not: sampled.
  std::optional<plant::StateSpace> state_space_controller = std::nullopt;
};

/// A plant alone.
LinearModels linear_models(const plant::AntennaPlant& antenna, double gear_ratio);
/// Also with a controller on the plant. @throws InvalidInput as control::validate.
LinearModels linear_models(const design::TrackingProblem& problem,
                           const control::Controller& controller, const std::string& description);
/// From a report of model, redesign or tune. The controller is the one that a tune report
/// recommends (shown_controller), or the tuned one of a redesign if it meets its constraints; else
/// the plant alone. Empty for a report without a plant.
std::optional<LinearModels> linear_models(const Report& report);

/// A MAT file of version 5 (docs/formats.md): plant with parameters and frequency responses. With a
/// controller also gains by symbol, both controllers, the closed loop and its frequency responses.
/// `command` and `case_path` are stored as text.
std::string to_mat(const LinearModels& models, const std::string& command,
                   const std::string& case_path);
/// How a report's models are made a MAT file; empty if it has none.
std::function<std::string()> mat_of(const Report& report);

}  // namespace boresight::app
