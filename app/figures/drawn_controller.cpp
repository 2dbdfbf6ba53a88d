#include <algorithm>

#include <fmt/format.h>

#include <boresight/app/figures/drawn_controller.hpp>
#include <boresight/app/figures/frequency_curves.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/numerics/angles.hpp>
#include <boresight/plant/linear/response_grid.hpp>

namespace boresight::app {

Eigen::ArrayXd controller_grid(const design::TrackingProblem& problem,
                               const control::Controller& controller) {
  const auto band = design::analysis_band(problem);
  const Eigen::ArrayXd open = plant::frequency_grid(problem.plant, band.lowest, band.highest, 40);
  plant::ResponseGridOptions options;
  options.lowest = two_pi * band.lowest;
  options.highest = two_pi * band.highest;
  options.points_per_decade = 40;
  const auto loop = control::closed_loop(problem.plant, controller, problem.delay);
  return merged(open, plant::response_grid(loop, options));
}

ControllerResponses controller_responses(const DrawnController& drawn) {
  ControllerResponses result;
  result.frequency = controller_grid(drawn.problem, drawn.controller);
  result.plant = plant::plant_response(drawn.problem.plant, result.frequency);
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    Eigen::ArrayXcd& gain = result.gain.at(b);
    gain.resize(result.frequency.size());
    for (Eigen::Index i = 0; i < gain.size(); ++i) {
      gain[i] =
          control::loop_gain(plant::point(result.plant, i), result.frequency[i], drawn.controller,
                             drawn.problem.delay, control::loop_breaks.at(b));
    }
  }
  return result;
}

std::string controller_conditions(const DrawnController& drawn) {
  return fmt::format("{}, {:.3g} m/s, wind model {}, linear plant with friction {:g} N.m.s/rad.",
                     drawn.name, drawn.problem.wind.mean_speed,
                     plant::to_string(drawn.problem.wind.model),
                     drawn.problem.plant.drive.viscous_friction);
}

FigureAxis shown_frequencies(const design::TrackingProblem& problem) {
  FigureAxis axis = frequency_axis();
  axis.lowest = std::max(1e-3, problem.rms_band.lowest);
  axis.highest = problem.rms_band.highest;
  return axis;
}

Figure controller_figure(const DrawnController& drawn, const char* id, const char* title) {
  Figure figure;
  figure.id = fmt::format("{}-{}", drawn.id, id);
  figure.section = drawn.section;
  figure.title = title;
  figure.x = shown_frequencies(drawn.problem);
  return figure;
}

std::string break_name(std::size_t loop_break) {
  return std::string(control::to_string(control::loop_breaks.at(loop_break)));
}

std::vector<std::size_t> shown_breaks(const DrawnController& drawn) {
  std::vector<std::size_t> shown;
  for (std::size_t b = 0; b < control::loop_breaks.size(); ++b) {
    if (control::has_break(drawn.controller, control::loop_breaks[b])) shown.push_back(b);
  }
  return shown;
}

std::string at_breaks(const DrawnController& drawn) {
  const auto shown = shown_breaks(drawn);
  return shown.size() == control::loop_breaks.size() ? "at the three breaks"
                                                     : "at the " + break_name(shown.front());
}

}  // namespace boresight::app
