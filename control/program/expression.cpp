#include <stdexcept>

#include <boresight/control/program/expression.hpp>

namespace boresight::control::program {
namespace {

void require(bool fits) {
  if (!fits) throw std::logic_error("program: an operation on operands of types that do not fit");
}

bool is_real(Type type) {
  return type == Type::real || type == Type::wide;
}

Expression unary(Operation operation, const Expression& a, Type type) {
  return {.operation = operation, .type = type, .operands = {a}};
}

Expression arithmetic(Operation operation, const Expression& a, const Expression& b) {
  require(a.type == b.type && is_real(a.type));
  return {.operation = operation, .type = a.type, .operands = {a, b}};
}

Expression comparison(Operation operation, const Expression& a, const Expression& b) {
  require(a.type == b.type && a.type != Type::boolean);
  return {.operation = operation, .type = Type::boolean, .operands = {a, b}};
}

Expression function(Operation operation, const Expression& a) {
  require(is_real(a.type));
  return unary(operation, a, a.type);
}

}  // namespace

Expression constant(double value, Type type) {
  return {.operation = Operation::constant, .type = type, .value = value};
}
Expression operator-(const Expression& a) {
  return function(Operation::negate, a);
}
Expression operator+(const Expression& a, const Expression& b) {
  return arithmetic(Operation::add, a, b);
}
Expression operator-(const Expression& a, const Expression& b) {
  return arithmetic(Operation::subtract, a, b);
}
Expression operator*(const Expression& a, const Expression& b) {
  return arithmetic(Operation::multiply, a, b);
}
Expression operator/(const Expression& a, const Expression& b) {
  return arithmetic(Operation::divide, a, b);
}
Expression operator<(const Expression& a, const Expression& b) {
  return comparison(Operation::less, a, b);
}
Expression operator<=(const Expression& a, const Expression& b) {
  return comparison(Operation::less_or_equal, a, b);
}
Expression both(const Expression& a, const Expression& b) {
  require(a.type == Type::boolean && b.type == Type::boolean);
  return {.operation = Operation::both, .type = Type::boolean, .operands = {a, b}};
}
Expression complement(const Expression& a) {
  require(a.type == Type::boolean);
  return unary(Operation::complement, a, Type::boolean);
}
Expression absolute(const Expression& a) {
  return function(Operation::absolute, a);
}
Expression square_root(const Expression& a) {
  return function(Operation::square_root, a);
}
Expression exponential(const Expression& a) {
  return function(Operation::exponential, a);
}
Expression smaller(const Expression& a, const Expression& b) {
  return arithmetic(Operation::smaller, a, b);
}
Expression larger(const Expression& a, const Expression& b) {
  return arithmetic(Operation::larger, a, b);
}
Expression truncated(const Expression& a) {
  require(a.type == Type::wide);
  return unary(Operation::truncated, a, Type::wide);
}
Expression to_real(const Expression& a) {
  require(a.type == Type::wide);
  return unary(Operation::to_real, a, Type::real);
}
Expression to_wide(const Expression& a) {
  require(a.type == Type::real || a.type == Type::integer);
  return unary(Operation::to_wide, a, Type::wide);
}
Expression limited(const Expression& value, const Expression& limit) {
  return larger(smaller(value, limit), -limit);
}

}  // namespace boresight::control::program
