#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/program/program.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::control::program {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(fmt::format("program: {}", what));
}

std::size_t operations(const Expression& expression) {
  std::size_t count = 0;
  for (const auto& operand : expression.operands) count += operations(operand);
  const bool computes =
      !expression.operands.empty() &&
      (expression.type != Type::boolean || expression.operation == Operation::less ||
       expression.operation == Operation::less_or_equal);
  return count + (computes ? 1 : 0);
}

std::size_t operations(const std::vector<Statement>& statements) {
  std::size_t count = 0;
  for (const auto& statement : statements) {
    if (statement.kind == StatementKind::remark) continue;
    count += operations(statement.expression) + operations(statement.then) +
             operations(statement.otherwise);
  }
  return count;
}

void mark_read(const Expression& expression, std::vector<bool>& read) {
  if (expression.operation == Operation::variable) read[expression.variable] = true;
  for (const auto& operand : expression.operands) mark_read(operand, read);
}

void mark_read(const std::vector<Statement>& statements, std::vector<bool>& read) {
  for (const auto& statement : statements) {
    mark_read(statement.expression, read);
    mark_read(statement.then, read);
    mark_read(statement.otherwise, read);
  }
}

void rename(Expression& expression, const std::vector<std::size_t>& places) {
  if (expression.operation == Operation::variable) {
    expression.variable = places[expression.variable];
  }
  for (auto& operand : expression.operands) rename(operand, places);
}

// Drops the assignments to variables that are not kept, and renumbers the others.
void keep_only(std::vector<Statement>& statements, const std::vector<bool>& kept,
               const std::vector<std::size_t>& places) {
  std::erase_if(statements, [&](const Statement& statement) {
    return statement.kind == StatementKind::assignment && !kept[statement.target];
  });
  for (auto& statement : statements) {
    if (statement.kind == StatementKind::assignment) statement.target = places[statement.target];
    rename(statement.expression, places);
    keep_only(statement.then, kept, places);
    keep_only(statement.otherwise, kept, places);
  }
}

// Parameters, states and locals that nothing reads; false if there are none.
bool drop_unread(Program& program) {
  std::vector<bool> kept(program.variables.size(), false);
  mark_read(program.step, kept);
  std::vector<std::size_t> places(program.variables.size(), 0);
  std::vector<Variable> variables;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Role role = program.variables[i].role;
    if (role == Role::input || role == Role::output) kept[i] = true;
    places[i] = variables.size();
    if (kept[i]) variables.push_back(std::move(program.variables[i]));
  }
  const bool dropped = variables.size() < kept.size();
  program.variables = std::move(variables);
  keep_only(program.step, kept, places);
  return dropped;
}

}  // namespace

std::size_t variable_index(const Program& program, std::string_view name) {
  const auto found = std::ranges::find(program.variables, name, &Variable::name);
  if (found == program.variables.end()) {
    throw InvalidInput(fmt::format("program: expected one of its variables, found '{}'", name));
  }
  return static_cast<std::size_t>(found - program.variables.begin());
}

std::size_t operation_count(const Program& program) {
  return operations(program.step);
}

Builder::Builder(std::string title, double sample_time) {
  program_.title = std::move(title);
  program_.sample_time = sample_time;
}

Expression Builder::declare(Variable variable) {
  require(std::ranges::find(program_.variables, variable.name, &Variable::name) ==
              program_.variables.end(),
          "a variable is declared twice");
  const Type type = variable.type;
  program_.variables.push_back(std::move(variable));
  return {
      .operation = Operation::variable, .type = type, .variable = program_.variables.size() - 1};
}

Expression Builder::parameter(const std::string& name, Type type, double value,
                              const std::string& unit, const std::string& comment) {
  return declare({name, Role::parameter, type, unit, comment, value});
}
Expression Builder::input(const std::string& name, Type type, const std::string& unit,
                          const std::string& comment) {
  return declare({name, Role::input, type, unit, comment});
}
Expression Builder::output(const std::string& name, Type type, const std::string& unit,
                           const std::string& comment) {
  return declare({name, Role::output, type, unit, comment});
}
Expression Builder::state(const std::string& name, Type type, const std::string& unit,
                          const std::string& comment) {
  return declare({name, Role::state, type, unit, comment});
}
Expression Builder::local(const std::string& name, Type type, const std::string& unit,
                          const std::string& comment) {
  return declare({name, Role::local, type, unit, comment});
}

void Builder::note(std::string text) {
  program_.notes.push_back(std::move(text));
}

void Builder::append(Statement statement) {
  if (open_.empty()) {
    program_.step.push_back(std::move(statement));
    return;
  }
  Branch& branch = open_.back();
  (branch.otherwise ? branch.statement.otherwise : branch.statement.then)
      .push_back(std::move(statement));
}

void Builder::remark(std::string text) {
  append({.kind = StatementKind::remark, .remark = std::move(text)});
}

void Builder::assign(const Expression& target, const Expression& value) {
  require(target.operation == Operation::variable, "an assignment to no variable");
  const Variable& variable = program_.variables[target.variable];
  require(variable.role != Role::parameter && variable.role != Role::input,
          "an assignment to a parameter or input");
  require(variable.type == value.type, "an assignment of another type");
  append({.target = target.variable, .expression = value});
}

Expression Builder::assigned(const std::string& name, const Expression& value,
                             const std::string& unit, const std::string& comment) {
  const Expression target = local(name, value.type, unit, comment);
  assign(target, value);
  return target;
}

void Builder::begin_if(const Expression& condition) {
  require(condition.type == Type::boolean, "a condition that is no boolean");
  open_.push_back({{.kind = StatementKind::condition, .expression = condition}});
}

void Builder::otherwise() {
  require(!open_.empty() && !open_.back().otherwise, "a second alternative");
  open_.back().otherwise = true;
}

void Builder::end_if() {
  require(!open_.empty(), "the end of no condition");
  Statement statement = std::move(open_.back().statement);
  open_.pop_back();
  append(std::move(statement));
}

Program Builder::finish() {
  require(open_.empty(), "an open condition");
  while (drop_unread(program_)) {
  }
  return std::move(program_);
}

}  // namespace boresight::control::program
