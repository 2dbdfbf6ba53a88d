#include <utility>

#include <boresight/app/benchmark/benchmark_report.hpp>
#include <boresight/app/models/linear_models.hpp>
#include <boresight/app/tune/controllers_in_time.hpp>
#include <boresight/app/tune/tune_verdict.hpp>
#include <boresight/control/controllers/sample_time.hpp>
#include <boresight/control/loops/closed_loop.hpp>
#include <boresight/control/loops/state_space_controller.hpp>
#include <boresight/io/case/drive_numbers.hpp>
#include <boresight/plant/linear/interconnection.hpp>

namespace boresight::app {

LinearModels linear_models(const plant::AntennaPlant& antenna, double gear_ratio) {
  return {antenna, plant::to_state_space(antenna), gear_ratio, std::nullopt, std::nullopt};
}

LinearModels linear_models(const design::TrackingProblem& problem,
                           const control::Controller& controller, const std::string& description) {
  LinearModels models = linear_models(problem.plant, problem.gear_ratio);
  const double sample_time = control::sample_time_of(problem.delay);
  auto continuous = control::to_state_space(controller);
  // Its rate command is one in form only.
  if (const auto* system = controller.structure.state_space()) {
    continuous = plant::subsystem(continuous, system->inputs, {"valve_demand"});
  }
  models.loop = {description,
                 controller,
                 problem.delay,
                 control::antenna_state_space_controller(continuous),
                 design::controller_of(controller, description, sample_time).system,
                 control::closed_loop(problem.plant, controller, problem.delay)};
  return models;
}

std::optional<LinearModels> linear_models(const Report& report) {
  if (report.tuned) {
    const TunedController* shown =
        shown_controller(*report.tuned, report.time_domain ? &*report.time_domain : nullptr);
    const auto& problem = report.tuned->problem;
    if (shown == nullptr) return linear_models(problem.plant, problem.gear_ratio);
    const bool recommended = recommended_tuned_controller(*report.tuned) != nullptr;
    LinearModels models =
        linear_models(problem, shown->design.tuning.controller,
                      description_of(*shown) + (recommended ? "" : ", not recommended"));
    if (report.state_space) models.state_space_controller = report.state_space->controller;
    for (const auto& row : report.tuned->controllers) {
      const auto* system = row.design.tuning.controller.structure.state_space();
      if (system != nullptr) models.state_space_controller = *system;
    }
    return models;
  }
  if (report.tuning && report.tuning->design.tuning.status == design::TuningStatus::optimal) {
    const auto& controller = report.tuning->design.tuning.controller;
    auto models = linear_models(report.tuning->problem, controller, controller.structure.name());
    if (const auto* system = controller.structure.state_space()) {
      models.state_space_controller = *system;
    }
    return models;
  }
  if (report.plant) return linear_models(report.plant->plant, report.plant->gear_ratio);
  return std::nullopt;
}

std::function<std::string()> mat_of(const Report& report) {
  auto models = linear_models(report);
  if (!models) return {};
  return [models = std::move(*models), command = report.command, path = report.case_path] {
    return to_mat(models, command, path);
  };
}

}  // namespace boresight::app
