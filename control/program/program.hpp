#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/control/program/expression.hpp>

namespace boresight::control::program {

/// Of a variable: a parameter is given before the start and constant; inputs are given and outputs
/// read at every step; a state keeps its value from step to step, a local does not.
enum class Role { parameter, input, output, state, local };

struct Variable {
  std::string name;  // lower case, unique, a word of no language
  Role role = Role::local;
  Type type = Type::real;
  std::string unit;      // empty: none
  std::string comment;   // what it is
  double initial = 0.0;  // of a parameter its value, of a state that at the first step
};

enum class StatementKind { remark, assignment, condition };

struct Statement {
  StatementKind kind = StatementKind::assignment;
  std::string remark = {};  // of a remark: what the next statements compute
  std::size_t target = 0;   // of an assignment
  Expression expression = {};
  std::vector<Statement> then = {}, otherwise = {};  // of a condition
};

/// What an antenna's computer executes once per sample.
struct Program {
  std::string title;
  std::vector<std::string> notes;  // how to use it, a line each
  double sample_time = 0.0;        // s
  std::vector<Variable> variables;
  std::vector<Statement> step;
};

/// The variable of that name. @throws InvalidInput if there is none.
std::size_t variable_index(const Program& program, std::string_view name);

/// Operations of a step on real and wide values, at most (both branches of a condition counted).
std::size_t operation_count(const Program& program);

/// Writes a program statement by statement.
class Builder {
 public:
  Builder(std::string title, double sample_time);

  /// Declares a variable; as an expression. @throws std::logic_error for a name given twice.
  Expression parameter(const std::string& name, Type type, double value, const std::string& unit,
                       const std::string& comment);
  Expression input(const std::string& name, Type type, const std::string& unit,
                   const std::string& comment);
  Expression output(const std::string& name, Type type, const std::string& unit,
                    const std::string& comment);
  Expression state(const std::string& name, Type type, const std::string& unit,
                   const std::string& comment);
  Expression local(const std::string& name, Type type, const std::string& unit,
                   const std::string& comment);

  void note(std::string text);
  void remark(std::string text);
  /// @throws std::logic_error for a target that is no output, state or local, or of another type.
  void assign(const Expression& target, const Expression& value);
  /// Declares a local, assigns the value and returns the local.
  Expression assigned(const std::string& name, const Expression& value, const std::string& unit,
                      const std::string& comment);
  void begin_if(const Expression& condition);
  void otherwise();
  void end_if();

  /// The program, without parameters, states and locals that nothing reads.
  /// @throws std::logic_error inside a condition.
  Program finish();

 private:
  Expression declare(Variable variable);
  void append(Statement statement);

  struct Branch {
    Statement statement;
    bool otherwise = false;
  };
  Program program_;
  std::vector<Branch> open_;
};

}  // namespace boresight::control::program
