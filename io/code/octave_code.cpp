#include <stdexcept>

#include <fmt/format.h>

#include <boresight/io/code/octave_code.hpp>

namespace boresight::io {
namespace {

using control::program::Expression;
using control::program::Operation;
using control::program::Precision;
using control::program::Program;
using control::program::Role;
using control::program::Type;
using control::program::Variable;

std::string comment_of(const Variable& variable) {
  const std::string text = description_of(variable);
  return text.empty() ? "" : "  % " + text;
}

class OctaveWriter final : public CodeWriter {
 public:
  using CodeWriter::CodeWriter;

  std::string literal(double value, Type type) const override {
    if (type == Type::boolean) return value != 0.0 ? "true" : "false";
    if (type == Type::integer) return fmt::format("{:.0f}", value);
    return real_literal(value, false);
  }

 protected:
  std::string name(const Variable& variable) const override {
    switch (variable.role) {
      case Role::parameter:
        return "parameters." + variable.name;
      case Role::input:
        return "inputs." + variable.name;
      case Role::output:
        return "outputs." + variable.name;
      case Role::state:
        return "state." + variable.name;
      case Role::local:
        return variable.name;
    }
    throw std::logic_error("Octave code: an unknown role");
  }
  std::string call(const Expression& expression,
                   const std::vector<std::string>& operands) const override {
    switch (expression.operation) {
      case Operation::absolute:
        return fmt::format("abs({})", operands[0]);
      case Operation::square_root:
        return fmt::format("sqrt({})", operands[0]);
      case Operation::exponential:
        return fmt::format("exp({})", operands[0]);
      case Operation::truncated:
        return fmt::format("fix({})", operands[0]);
      case Operation::smaller:
        return fmt::format("min({}, {})", operands[0], operands[1]);
      case Operation::larger:
        return fmt::format("max({}, {})", operands[0], operands[1]);
      case Operation::to_real:
      case Operation::to_wide:
        return fmt::format("double({})", operands[0]);
      default:
        throw std::logic_error("Octave code: an unknown operation");
    }
  }
  std::string_view conjunction() const override { return "&&"; }
  std::string_view complement() const override { return "~"; }
  std::string_view assignment() const override { return "="; }
  std::string remark(const std::string& text) const override { return "% " + text; }
  std::string begin_if(const std::string& condition) const override { return "if " + condition; }
  std::string otherwise() const override { return "else"; }
  std::string end_if() const override { return "end"; }
  std::string_view continuation() const override { return " ..."; }
};

// A function that returns a struct of the initial values of a role.
std::string struct_function(const Program& program, const OctaveWriter& writer, Role role,
                            const char* function, const char* result, const char* what) {
  std::string text = fmt::format("function {0} = {1}()\n% {2}\n", result, function, what);
  for (const auto& variable : program.variables) {
    if (variable.role != role) continue;
    text += fmt::format("  {}.{} = {};{}\n", result, variable.name,
                        writer.literal(variable.initial, variable.type), comment_of(variable));
  }
  return text + "end\n";
}

std::string described(const Program& program, Role role) {
  std::string text;
  for (const auto& variable : program.variables) {
    if (variable.role != role) continue;
    text += fmt::format("%   {:<18} {}\n", variable.name, description_of(variable));
  }
  return text;
}

}  // namespace

std::vector<CodeFile> octave_code(const Program& program) {
  const OctaveWriter writer(program, Precision::double_precision);
  std::string text =
      fmt::format("function [outputs, state] = servo_controller(parameters, state, inputs)\n% {}\n",
                  program.title);
  for (const auto& note : program.notes) text += fmt::format("%\n% {}\n", note);
  text += fmt::format("%\n% inputs:\n{}% outputs:\n{}", described(program, Role::input),
                      described(program, Role::output));
  for (const auto& variable : program.variables) {
    if (variable.role != Role::local && variable.role != Role::output) continue;
    text += fmt::format("  {}{} = {};\n", variable.role == Role::output ? "outputs." : "",
                        variable.name, writer.literal(0.0, variable.type));
  }
  text += writer.statements(program.step, 1) + "end\n";
  return {
      {"servo_controller.m", std::move(text)},
      {"servo_parameters.m", struct_function(program, writer, Role::parameter, "servo_parameters",
                                             "parameters", "Parameters of servo_controller.")},
      {"servo_initial_state.m",
       struct_function(program, writer, Role::state, "servo_initial_state", "state",
                       "State of servo_controller before the first step.")}};
}

}  // namespace boresight::io
