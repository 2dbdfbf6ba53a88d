#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <boresight/io/code/structured_text.hpp>

namespace boresight::io {
namespace {

using control::program::Expression;
using control::program::Operation;
using control::program::Precision;
using control::program::Program;
using control::program::Role;
using control::program::Type;
using control::program::Variable;

class StructuredTextWriter final : public CodeWriter {
 public:
  using CodeWriter::CodeWriter;

  std::string_view type_name(Type type) const {
    switch (type) {
      case Type::boolean:
        return "BOOL";
      case Type::integer:
        return "DINT";
      case Type::real:
        return is_single() ? "REAL" : "LREAL";
      case Type::wide:
        return "LREAL";
    }
    throw std::logic_error("structured text: an unknown type");
  }

  std::string literal(double value, Type type) const override {
    if (type == Type::boolean) return value != 0.0 ? "TRUE" : "FALSE";
    if (type == Type::integer) return fmt::format("DINT#{:.0f}", value);
    std::string number = real_literal(value, type == Type::real && is_single());
    for (char& letter : number) {
      if (letter == 'e') letter = 'E';
    }
    return fmt::format("{}#{}", type_name(type), number);
  }

  // VAR_INPUT, VAR_OUTPUT, VAR and so on, of one role.
  std::string section(const char* opening, Role role) const {
    std::string text = fmt::format("{}\n", opening);
    for (const Variable& variable : program().variables) {
      if (variable.role != role) continue;
      const std::string comment = description_of(variable);
      text += fmt::format("  {} : {}{};{}\n", variable.name, type_name(variable.type),
                          role == Role::parameter || role == Role::state
                              ? fmt::format(" := {}", literal(variable.initial, variable.type))
                              : "",
                          comment.empty() ? "" : fmt::format(" (* {} *)", comment));
    }
    return text + "END_VAR\n";
  }

 protected:
  std::string name(const Variable& variable) const override { return variable.name; }
  std::string call(const Expression& expression,
                   const std::vector<std::string>& operands) const override {
    const std::string& first = operands[0];
    switch (expression.operation) {
      case Operation::absolute:
        return fmt::format("ABS({})", first);
      case Operation::square_root:
        return fmt::format("SQRT({})", first);
      case Operation::exponential:
        return fmt::format("EXP({})", first);
      case Operation::truncated:
        return fmt::format("DINT_TO_LREAL(TRUNC({}))", first);
      case Operation::smaller:
        return fmt::format("MIN({}, {})", first, operands[1]);
      case Operation::larger:
        return fmt::format("MAX({}, {})", first, operands[1]);
      case Operation::to_real:
        return is_single() ? fmt::format("LREAL_TO_REAL({})", first) : fmt::format("({})", first);
      case Operation::to_wide:
        if (expression.operands[0].type == Type::integer) {
          return fmt::format("DINT_TO_LREAL({})", first);
        }
        return is_single() ? fmt::format("REAL_TO_LREAL({})", first) : fmt::format("({})", first);
      default:
        throw std::logic_error("structured text: an unknown operation");
    }
  }
  std::string_view conjunction() const override { return "AND"; }
  std::string_view complement() const override { return "NOT "; }
  std::string_view assignment() const override { return ":="; }
  std::string remark(const std::string& text) const override {
    return fmt::format("(* {} *)", text);
  }
  std::string begin_if(const std::string& condition) const override {
    return fmt::format("IF {} THEN", condition);
  }
  std::string otherwise() const override { return "ELSE"; }
  std::string end_if() const override { return "END_IF;"; }
};

}  // namespace

CodeFile structured_text(const Program& program, Precision precision) {
  const StructuredTextWriter writer(program, precision);
  std::string text = fmt::format("(* {}\n", program.title);
  for (const auto& note : program.notes) text += fmt::format("\n   {}\n", note);
  text += "*)\nFUNCTION_BLOCK SERVO_CONTROLLER\n";
  text += writer.section("VAR_INPUT", Role::input);
  text += writer.section("VAR_OUTPUT", Role::output);
  text += writer.section("VAR CONSTANT", Role::parameter);
  text += writer.section("VAR", Role::state);
  text += writer.section("VAR_TEMP", Role::local);
  text += writer.statements(program.step, 0);
  return {"servo_controller.st", text + "END_FUNCTION_BLOCK\n"};
}

}  // namespace boresight::io
