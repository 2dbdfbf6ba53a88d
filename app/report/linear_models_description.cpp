#include <boresight/app/report/linear_models_description.hpp>
#include <boresight/io/description/state_space_description.hpp>

namespace boresight::app {

void describe(io::Visitor& v, const LinearModels& models) {
  v.defined_as("linear_models",
               "Of model, redesign and tune: state spaces behind the report, SI at the motor "
               "shaft, numbers in the shortest form that reads back bit by bit (docs/formats.md).");
  v.number("gear_ratio", models.gear_ratio, io::key_units::ratio,
           "Motor turns per turn of the antenna.", {.above = 0.0, .finite = true});
  v.object("plant", models.plant, "The linear plant.");
  v.optional_members(models.loop, [&](const ControllerModels& loop) {
    v.text("controller_name", loop.description,
           "Of both controllers: structure and what it was tuned for.");
    v.number("dead_time", loop.dead_time, io::key_units::second,
             "Of the loop around the continuous controller.", {.minimum = 0.0, .finite = true});
    v.object("controller", loop.continuous, "The continuous controller.");
    v.object("sampled_controller", loop.sampled_controller,
             "The controller in the sampled form that the antenna's computer runs.");
  });
  v.optional_members(models.state_space_controller, [&](const plant::StateSpace& controller) {
    v.object("state_space_controller", controller,
             "The state-space controller, sampled: of `state_space`, or SS where it is one of "
             "the structures.");
  });
}

}  // namespace boresight::app
