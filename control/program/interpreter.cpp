#include <cmath>
#include <stdexcept>

#include <boresight/control/program/interpreter.hpp>

namespace boresight::control::program {

Interpreter::Interpreter(const Program& program, Precision precision)
    : Runner(program), precision_(precision), values_(program.variables.size(), 0.0) {
  restart();
}

void Interpreter::restart() {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Variable& variable = program().variables[i];
    values_[i] = rounded(variable.initial, variable.type);
  }
}

double Interpreter::rounded(double value, Type type) const {
  if (type != Type::real || precision_ == Precision::double_precision) return value;
  return static_cast<double>(static_cast<float>(value));
}

// A sum, product, quotient or root of single-precision values that is computed in double precision
// and rounded once more is the one that single precision gives (S. A. Figueroa, When is double
// rounding innocuous, SIGNUM Newsletter 30(3), 1995).
double Interpreter::evaluate(const Expression& expression) const {
  const auto operand = [&](std::size_t i) { return evaluate(expression.operands[i]); };
  switch (expression.operation) {
    case Operation::constant:
      return rounded(expression.value, expression.type);
    case Operation::variable:
      return values_[expression.variable];
    case Operation::negate:
      return -operand(0);
    case Operation::add:
      return rounded(operand(0) + operand(1), expression.type);
    case Operation::subtract:
      return rounded(operand(0) - operand(1), expression.type);
    case Operation::multiply:
      return rounded(operand(0) * operand(1), expression.type);
    case Operation::divide:
      return rounded(operand(0) / operand(1), expression.type);
    case Operation::less:
      return operand(0) < operand(1) ? 1.0 : 0.0;
    case Operation::less_or_equal:
      return operand(0) <= operand(1) ? 1.0 : 0.0;
    case Operation::both:
      return operand(0) != 0.0 && operand(1) != 0.0 ? 1.0 : 0.0;
    case Operation::complement:
      return operand(0) != 0.0 ? 0.0 : 1.0;
    case Operation::absolute:
      return std::abs(operand(0));
    case Operation::square_root:
      return rounded(std::sqrt(operand(0)), expression.type);
    case Operation::exponential:
      if (expression.type == Type::real && precision_ == Precision::single_precision) {
        return static_cast<double>(std::exp(static_cast<float>(operand(0))));
      }
      return std::exp(operand(0));
    case Operation::smaller: {
      const double a = operand(0), b = operand(1);
      return a < b ? a : b;
    }
    case Operation::larger: {
      const double a = operand(0), b = operand(1);
      return a < b ? b : a;
    }
    case Operation::truncated:
      return std::trunc(operand(0));
    case Operation::to_real:
      return rounded(operand(0), Type::real);
    case Operation::to_wide:
      return operand(0);
  }
  throw std::logic_error("program: an unknown operation");
}

void Interpreter::run(const std::vector<Statement>& statements) {
  for (const Statement& statement : statements) {
    switch (statement.kind) {
      case StatementKind::remark:
        break;
      case StatementKind::assignment:
        values_[statement.target] = evaluate(statement.expression);
        break;
      case StatementKind::condition:
        run(evaluate(statement.expression) != 0.0 ? statement.then : statement.otherwise);
        break;
    }
  }
}

void Interpreter::step() {
  run(program().step);
}

void Interpreter::set_value(std::size_t variable, double value) {
  values_[variable] = rounded(value, program().variables[variable].type);
}

}  // namespace boresight::control::program
