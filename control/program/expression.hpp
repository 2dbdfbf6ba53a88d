#pragma once

#include <cstddef>
#include <vector>

/// Programs of an antenna's computer as data: expressions, statements and variables that are
/// printed in several languages and run by Interpreter, with the same operations in the same order.
namespace boresight::control::program {

/// Of a value. `real` is single or double precision, by the precision of the program; `wide` is
/// always double precision, for angles at the sky and times. Booleans are 0 or 1.
enum class Type { boolean, integer, real, wide };

enum class Operation {
  constant,
  variable,
  negate,
  add,
  subtract,
  multiply,
  divide,
  less,           // false with a NaN, like the next
  less_or_equal,  // false with a NaN
  both,           // of two booleans
  complement,     // of a boolean
  absolute,
  square_root,
  exponential,
  smaller,    // a < b ? a : b
  larger,     // a < b ? b : a
  truncated,  // towards zero, of a wide value below 2^31
  to_real,
  to_wide,
};

/// A tree of operations. The operators below build it; both operands are of one type.
struct Expression {
  Operation operation = Operation::constant;
  Type type = Type::real;
  double value = 0.0;        // of a constant
  std::size_t variable = 0;  // Program::variables
  std::vector<Expression> operands = {};
};

/// @throws std::logic_error where types do not fit: for all functions here.
Expression constant(double value, Type type = Type::real);
Expression operator-(const Expression& a);
Expression operator+(const Expression& a, const Expression& b);
Expression operator-(const Expression& a, const Expression& b);
Expression operator*(const Expression& a, const Expression& b);
Expression operator/(const Expression& a, const Expression& b);
Expression operator<(const Expression& a, const Expression& b);
Expression operator<=(const Expression& a, const Expression& b);
Expression both(const Expression& a, const Expression& b);
Expression complement(const Expression& a);
Expression absolute(const Expression& a);
Expression square_root(const Expression& a);
Expression exponential(const Expression& a);
Expression smaller(const Expression& a, const Expression& b);
Expression larger(const Expression& a, const Expression& b);
Expression truncated(const Expression& a);
Expression to_real(const Expression& a);
Expression to_wide(const Expression& a);
/// `value` within -limit to limit.
Expression limited(const Expression& value, const Expression& limit);

}  // namespace boresight::control::program
