#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/control/controllers/sampled_controller.hpp>
#include <boresight/control/program/digital_sections.hpp>
#include <boresight/io/code/simulink_model.hpp>

namespace boresight::io {
namespace {

using control::LoopPath;

std::string matrix(const Eigen::MatrixXd& values) {
  if (values.size() == 0) return fmt::format("zeros({}, {})", values.rows(), values.cols());
  std::string text = "[";
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (i > 0) text += "; ...\n    ";
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      text += fmt::format("{}{:.17g}", j > 0 ? " " : "", values(i, j));
    }
  }
  return text + "]";
}

std::string cells(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += fmt::format("{}'{}'", text.empty() ? "" : ", ", name);
  return "{" + text + "}";
}

std::string state_space(const std::string& name, const plant::StateSpace& system) {
  return fmt::format(
      "{0}.A = {1};\n{0}.B = {2};\n{0}.C = {3};\n{0}.D = {4};\n{0}.Ts = {5:.17g};  % s\n"
      "{0}.inputs = {6};\n{0}.outputs = {7};\n",
      name, matrix(system.a), matrix(system.b), matrix(system.c), matrix(system.d),
      system.sample_time, cells(system.inputs), cells(system.outputs));
}

// Of loops: a row per section, and the response that they make together.
std::string blocks_of_loops(const control::Controller& controller, double sample_time) {
  std::string text =
      "blocks = struct('path', {}, 'name', {}, 'numerator', {}, 'denominator', {});\n";
  for (const LoopPath path :
       {LoopPath::position, LoopPath::rate, LoopPath::pressure, LoopPath::compliance}) {
    if (!controller.structure.has(path)) continue;
    for (const auto& section : control::program::digital_sections(controller, path, sample_time)) {
      text += fmt::format(
          "blocks(end+1) = struct('path', '{}', 'name', '{}', ...\n  'numerator', [{:.17g}], ...\n"
          "  'denominator', [1 {:.17g}]);\n",
          to_string(path), section.description, fmt::join(section.b, " "),
          fmt::join(section.a, " "));
    }
  }
  text += R"(
% Response of the paths at z, and of the feedback that they make:
% u = R (r - tachometer) - Q torque, r = rate_disturbance - P (encoder - C torque).
at = struct('position', 1, 'rate', 1, 'pressure', 0, 'compliance', 0);
for name = {'pressure', 'compliance'}
  if any(strcmp({blocks.path}, name{1})), at.(name{1}) = 1; end
end
z = exp(2i*pi*0.05);
for k = 1:numel(blocks)
  h = polyval(fliplr(blocks(k).numerator), 1/z)/polyval(fliplr(blocks(k).denominator), 1/z);
  at.(blocks(k).path) = at.(blocks(k).path)*h;
end
of_blocks.tachometer = -at.rate;
of_blocks.encoder = -at.rate*at.position;
of_blocks.rate_disturbance = at.rate;
of_blocks.motor_torque = at.rate*at.position*at.compliance - at.pressure;
)";
  return text;
}

std::string blocks_of_state_space(const plant::StateSpace& system) {
  return "% The same in blocks of one and two states.\n" +
         state_space("blocks", control::program::in_modal_blocks(system)) + R"(
z = exp(2i*pi*0.05);
h = blocks.C*((z*eye(size(blocks.A, 1)) - blocks.A)\blocks.B) + blocks.D;
for k = 1:numel(blocks.inputs)
  of_blocks.(blocks.inputs{k}) = h(k);
end
)";
}

}  // namespace

CodeFile simulink_model(const design::ExportedController& exported) {
  const control::Controller& controller = exported.controller;
  const plant::StateSpace* own = controller.structure.state_space();
  plant::StateSpace feedback =
      own != nullptr ? *own : control::sampled_controller(controller, exported.sample_time);
  if (own == nullptr) {
    // The encoder is less its reference already; of the outputs the demand alone.
    const Eigen::Index demand = plant::output_index(feedback, "valve_demand");
    feedback.c = Eigen::MatrixXd(feedback.c.row(demand));
    feedback.d = Eigen::MatrixXd(feedback.d.row(demand));
    feedback.outputs = {"valve_demand"};
  }
  std::string text = fmt::format(
      "% {}: linear feedback, SI at the motor shaft.\n%\n"
      "% encoder: rad, less the reference in `angle_reference` if there is that input; tachometer\n"
      "% and rate_disturbance (added to the rate command): rad/s; motor_torque: N m;\n"
      "% valve_demand: rad/s of motor without load. Signs as in docs/control-structures.md.\n"
      "% The complete controller with its feedforward, limits and scales is "
      "servo_controller.m.\n\n",
      exported.program.title);
  text += state_space("feedback", feedback) +
          fmt::format("command_limit = {:.17g};  % rad/s\n\n", exported.options.command_limit);
  text += own != nullptr ? blocks_of_state_space(*own)
                         : blocks_of_loops(controller, exported.sample_time);
  text += R"(
h = feedback.C*((z*eye(size(feedback.A, 1)) - feedback.A)\feedback.B) + feedback.D;
difference = 0;
for k = 1:numel(feedback.inputs)
  if isfield(of_blocks, feedback.inputs{k})
    difference = max(difference, abs(h(k) - of_blocks.(feedback.inputs{k}))/max(abs(h)));
  end
end
text = sprintf('Blocks and state space differ by %.1e at 5 %% of the sampling rate.', ...
                      difference);
disp(text);
if difference > 1e-9, error('Blocks and state space do not agree.'); end

if exist('new_system') == 5 && exist('simulink') > 0
  model = 'servo_loop';
  if bdIsLoaded(model), close_system(model, 0); end
  new_system(model);
  add_block('built-in/Inport', [model '/signals']);
  add_block('built-in/DiscreteStateSpace', [model '/feedback'], 'A', 'feedback.A', ...
            'B', 'feedback.B', 'C', 'feedback.C', 'D', 'feedback.D', 'SampleTime', 'feedback.Ts');
  add_block('built-in/Saturate', [model '/valve limit'], 'UpperLimit', 'command_limit', ...
            'LowerLimit', '-command_limit');
  add_block('built-in/UnitDelay', [model '/computation'], 'SampleTime', 'feedback.Ts');
  add_block('built-in/Outport', [model '/valve_command']);
  add_line(model, 'signals/1', 'feedback/1');
  add_line(model, 'feedback/1', 'valve limit/1');
  add_line(model, 'valve limit/1', 'computation/1');
  add_line(model, 'computation/1', 'valve_command/1');
  open_system(model);
end
)";
  return {"servo_model.m", std::move(text)};
}

}  // namespace boresight::io
