#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <boresight/io/code/code_writer.hpp>

namespace boresight::io {
namespace {

using control::program::Expression;
using control::program::Operation;
using control::program::Statement;
using control::program::StatementKind;

constexpr std::size_t widest_line = 100;
constexpr int primary = 6, unary = 5, product = 4, sum = 3, comparison = 2, conjunction_level = 1;

// An operator between two operands; null for other operations.
struct Infix {
  Operation operation;
  const char* symbol;
  int precedence;
};
constexpr Infix infixes[]{
    {Operation::add, "+", sum},          {Operation::subtract, "-", sum},
    {Operation::multiply, "*", product}, {Operation::divide, "/", product},
    {Operation::less, "<", comparison},  {Operation::less_or_equal, "<=", comparison}};

std::string in_parentheses(const std::string& text) {
  return fmt::format("({})", text);
}

}  // namespace

std::string description_of(const control::program::Variable& variable) {
  if (variable.unit.empty() || variable.comment.empty()) return variable.unit + variable.comment;
  return fmt::format("{}: {}", variable.unit, variable.comment);
}

std::string real_literal(double value, bool single) {
  std::string text = single ? fmt::format("{:.9g}", value) : fmt::format("{:.17g}", value);
  const auto exponent = text.find('e');
  if (text.find('.') == std::string::npos) {
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  }
  return text;
}

CodeWriter::CodeWriter(const control::program::Program& program,
                       control::program::Precision precision)
    : program_(program), precision_(precision) {}

CodeWriter::Text CodeWriter::printed(const Expression& expression) const {
  if (expression.operation == Operation::variable) {
    return {name(program_.variables[expression.variable]), primary};
  }
  if (expression.operation == Operation::constant) {
    return {literal(expression.value, expression.type), expression.value < 0.0 ? unary : primary};
  }
  std::vector<Text> operands;
  for (const auto& operand : expression.operands) operands.push_back(printed(operand));
  const auto at_least = [](const Text& text, int precedence) {
    return text.precedence < precedence ? in_parentheses(text.text) : text.text;
  };
  const auto* infix = std::ranges::find(infixes, expression.operation, &Infix::operation);
  if (infix != std::end(infixes)) {
    return {fmt::format("{} {} {}", at_least(operands[0], infix->precedence), infix->symbol,
                        at_least(operands[1], infix->precedence + 1)),
            infix->precedence};
  }
  if (expression.operation == Operation::both) {
    return {fmt::format("{} {} {}", at_least(operands[0], conjunction_level), conjunction(),
                        at_least(operands[1], primary)),
            conjunction_level};
  }
  if (expression.operation == Operation::negate) {
    return {fmt::format("-{}", at_least(operands[0], primary)), unary};
  }
  if (expression.operation == Operation::complement) {
    return {fmt::format("{}{}", complement(), at_least(operands[0], primary)), unary};
  }
  std::vector<std::string> texts;
  for (const auto& operand : operands) texts.push_back(operand.text);
  return {call(expression, texts), primary};
}

std::string CodeWriter::expression(const Expression& expression) const {
  return printed(expression).text;
}

std::string CodeWriter::broken(const std::string& line, int level) const {
  std::string rest = std::string(2 * static_cast<std::size_t>(level), ' ') + line;
  const std::string indent(2 * static_cast<std::size_t>(level) + 4, ' ');
  std::string text;
  while (rest.size() > widest_line) {
    const auto blank = rest.rfind(' ', widest_line - continuation().size());
    if (blank == std::string::npos || rest.find_first_not_of(' ') > blank) break;
    text += fmt::format("{}{}\n", rest.substr(0, blank), continuation());
    rest.replace(0, blank + 1, indent);
  }
  return text + rest + "\n";
}

std::string CodeWriter::statements(const std::vector<Statement>& statements, int level) const {
  std::string text;
  for (const Statement& statement : statements) {
    switch (statement.kind) {
      case StatementKind::remark:
        text +=
            std::string(2 * static_cast<std::size_t>(level), ' ') + remark(statement.remark) + "\n";
        break;
      case StatementKind::assignment:
        text +=
            broken(fmt::format("{} {} {}{}", name(program_.variables[statement.target]),
                               assignment(), expression(statement.expression), end_of_statement()),
                   level);
        break;
      case StatementKind::condition:
        text += broken(begin_if(expression(statement.expression)), level);
        text += this->statements(statement.then, level + 1);
        if (!statement.otherwise.empty()) {
          text += broken(otherwise(), level) + this->statements(statement.otherwise, level + 1);
        }
        text += broken(end_if(), level);
        break;
    }
  }
  return text;
}

}  // namespace boresight::io
