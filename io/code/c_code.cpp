#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <boresight/io/code/c_code.hpp>

namespace boresight::io {
namespace {

using control::program::Expression;
using control::program::Operation;
using control::program::Precision;
using control::program::Program;
using control::program::Role;
using control::program::Type;
using control::program::Variable;

std::string_view type_name(Type type) {
  switch (type) {
    case Type::boolean:
      return "bool";
    case Type::integer:
      return "int32_t";
    case Type::real:
      return "servo_real";
    case Type::wide:
      return "double";
  }
  throw std::logic_error("C code: an unknown type");
}

std::string comment_of(const Variable& variable) {
  const std::string text = description_of(variable);
  return text.empty() ? "" : fmt::format(" /* {} */", text);
}

class CWriter final : public CodeWriter {
 public:
  using CodeWriter::CodeWriter;

  std::string literal(double value, Type type) const override {
    if (type == Type::boolean) return value != 0.0 ? "true" : "false";
    if (type == Type::integer) return fmt::format("{:.0f}", value);
    const bool single = type == Type::real && is_single();
    return real_literal(value, single) + (single ? "f" : "");
  }

 protected:
  std::string name(const Variable& variable) const override {
    switch (variable.role) {
      case Role::parameter:
        return "parameters->" + variable.name;
      case Role::input:
        return "inputs->" + variable.name;
      case Role::output:
        return "outputs->" + variable.name;
      case Role::state:
        return "state->" + variable.name;
      case Role::local:
        return variable.name;
    }
    throw std::logic_error("C code: an unknown role");
  }
  std::string call(const Expression& expression,
                   const std::vector<std::string>& operands) const override {
    const bool single = expression.type == Type::real && is_single();
    const auto of_library = [&](const char* function) {
      return fmt::format("{}{}({})", function, single ? "f" : "", operands[0]);
    };
    const char* kind = expression.type == Type::real ? "real" : "wide";
    switch (expression.operation) {
      case Operation::absolute:
        return of_library("fabs");
      case Operation::square_root:
        return of_library("sqrt");
      case Operation::exponential:
        return of_library("exp");
      case Operation::truncated:
        return of_library("trunc");
      case Operation::smaller:
        return fmt::format("smaller_{}({}, {})", kind, operands[0], operands[1]);
      case Operation::larger:
        return fmt::format("larger_{}({}, {})", kind, operands[0], operands[1]);
      case Operation::to_real:
        return fmt::format("(servo_real)({})", operands[0]);
      case Operation::to_wide:
        return fmt::format("(double)({})", operands[0]);
      default:
        throw std::logic_error("C code: an unknown operation");
    }
  }
  std::string_view conjunction() const override { return "&&"; }
  std::string_view complement() const override { return "!"; }
  std::string_view assignment() const override { return "="; }
  std::string remark(const std::string& text) const override {
    return fmt::format("/* {} */", text);
  }
  std::string begin_if(const std::string& condition) const override {
    return fmt::format("if ({}) {{", condition);
  }
  std::string otherwise() const override { return "} else {"; }
  std::string end_if() const override { return "}"; }
};

std::string members(const Program& program, Role role) {
  std::string text;
  for (const auto& variable : program.variables) {
    if (variable.role != role) continue;
    text +=
        fmt::format("  {} {};{}\n", type_name(variable.type), variable.name, comment_of(variable));
  }
  return text;
}

std::string notes(const Program& program) {
  std::string text = fmt::format("/* {}\n", program.title);
  for (const auto& note : program.notes) text += fmt::format(" *\n * {}\n", note);
  return text + " */\n";
}

std::string header(const Program& program, bool single) {
  return notes(program) + fmt::format(R"(#ifndef SERVO_CONTROLLER_H
#define SERVO_CONTROLLER_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {{
#endif

typedef {} servo_real;

typedef struct {{
{}}} servo_parameters;

/* Samples taken now. */
typedef struct {{
{}}} servo_inputs;

typedef struct {{
{}}} servo_outputs;

typedef struct {{
{}}} servo_state;

/* The controller as designed. */
extern const servo_parameters servo_default_parameters;

/* Before the first step. */
void servo_initialise(servo_state *state);

/* Once per sample time. The structs must not overlap. */
void servo_step(const servo_parameters *parameters, servo_state *state,
                const servo_inputs *inputs, servo_outputs *outputs);

#ifdef __cplusplus
}}
#endif

#endif
)",
                                      single ? "float" : "double",
                                      members(program, Role::parameter),
                                      members(program, Role::input), members(program, Role::output),
                                      members(program, Role::state));
}

bool uses(const Expression& expression, Operation operation, Type type) {
  return (expression.operation == operation && expression.type == type) ||
         std::ranges::any_of(expression.operands, [&](const Expression& operand) {
           return uses(operand, operation, type);
         });
}

bool uses(const std::vector<control::program::Statement>& statements, Operation operation,
          Type type) {
  return std::ranges::any_of(statements, [&](const auto& statement) {
    return uses(statement.expression, operation, type) || uses(statement.then, operation, type) ||
           uses(statement.otherwise, operation, type);
  });
}

std::string choosing_functions(const Program& program) {
  std::string text;
  for (const Type type : {Type::real, Type::wide}) {
    for (const Operation operation : {Operation::smaller, Operation::larger}) {
      if (!uses(program.step, operation, type)) continue;
      text += fmt::format("static {0} {1}_{2}({0} a, {0} b)\n{{\n  return (a < b) ? {3};\n}}\n\n",
                          type_name(type), operation == Operation::smaller ? "smaller" : "larger",
                          type == Type::real ? "real" : "wide",
                          operation == Operation::smaller ? "a : b" : "b : a");
    }
  }
  return text;
}

std::string source(const Program& program, const CWriter& writer) {
  std::string text = notes(program) + R"(#include "servo_controller.h"

#include <math.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "The watchdog needs comparisons with NaN to be false: no -ffast-math."
#endif

const servo_parameters servo_default_parameters = {
)";
  std::string initial, locals;
  for (const auto& variable : program.variables) {
    const std::string value = writer.literal(variable.initial, variable.type);
    if (variable.role == Role::parameter) {
      text += fmt::format("  .{} = {},\n", variable.name, value);
    } else if (variable.role == Role::state) {
      initial += fmt::format("  state->{} = {};\n", variable.name, value);
    } else if (variable.role == Role::local) {
      locals += fmt::format("  {} {} = {};{}\n", type_name(variable.type), variable.name, value,
                            comment_of(variable));
    }
  }
  return text + "};\n\n" + choosing_functions(program) +
         fmt::format("void servo_initialise(servo_state *state)\n{{\n{}}}\n\n", initial) +
         "void servo_step(const servo_parameters *parameters, servo_state *state,\n"
         "                const servo_inputs *inputs, servo_outputs *outputs)\n{\n" +
         locals + "\n" + writer.statements(program.step, 1) + "}\n";
}

}  // namespace

std::vector<CodeFile> c_code(const Program& program, Precision precision) {
  const CWriter writer(program, precision);
  return {{"servo_controller.h", header(program, precision == Precision::single_precision)},
          {"servo_controller.c", source(program, writer)}};
}

CodeFile c_test_program(const Program& program) {
  std::string inputs, outputs, names;
  std::size_t input_count = 0, output_count = 0;
  for (const auto& variable : program.variables) {
    if (variable.role == Role::input) {
      const std::string value = fmt::format("row[{}]", ++input_count);
      inputs += fmt::format("    inputs.{} = {};\n", variable.name,
                            variable.type == Type::boolean ? value + " > 0.5"
                            : variable.type == Type::wide
                                ? value
                                : fmt::format("({}){}", type_name(variable.type), value));
    } else if (variable.role == Role::output) {
      outputs +=
          fmt::format("    found[{}] = (double)outputs.{};\n", output_count++, variable.name);
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", variable.name);
    }
  }
  return {"servo_controller_test.c",
          fmt::format(R"(/* Runs the test vectors of servo_controller and compares its outputs.
 *
 * usage: servo_controller_test FOLDER
 *
 * FOLDER holds tolerances.csv and the vectors that it lists. Exit code 0: all agree; 1: one does
 * not; 2: a file cannot be read.
 */
{5}

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {{ input_count = {0}, output_count = {1}, columns = 1 + {0} + {1}, longest_line = 4096 }};

static const char *const output_names[output_count] = {{{2}}};

/* Numbers behind commas, from the first column on; returns how many. */
static int read_numbers(char *line, double *numbers, int most)
{{
  int count = 0;
  char *at = line;
  while (count < most) {{
    char *end = at;
    numbers[count] = strtod(at, &end);
    if (end == at) break;
    ++count;
    if (*end != ',') break;
    at = end + 1;
  }}
  return count;
}}

static FILE *open_in(const char *folder, const char *name)
{{
  char path[longest_line];
  FILE *file = NULL;
  if (snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path) {{
    file = fopen(path, "r");
  }}
  if (file == NULL) fprintf(stderr, "%s/%s: cannot be read\n", folder, name);
  return file;
}}

/* Exit code. */
static int run_vector(const char *folder, const char *name, int expected,
                      const double *tolerance)
{{
  char line[longest_line];
  double row[columns];
  double largest[output_count] = {{0.0}};
  servo_state state;
  int samples = 0;
  int failed = 0;
  FILE *file = open_in(folder, name);
  if (file == NULL) return 2;
  servo_initialise(&state);
  while (fgets(line, sizeof line, file) != NULL) {{
    servo_inputs inputs;
    servo_outputs outputs;
    double found[output_count];
    if (line[0] == '#') continue;
    if (read_numbers(line, row, columns) != columns) break;
{3}    servo_step(&servo_default_parameters, &state, &inputs, &outputs);
{4}    for (int i = 0; i < output_count; ++i) {{
      const double difference = fabs(found[i] - row[1 + input_count + i]);
      if (!(difference <= largest[i])) largest[i] = difference;
    }}
    ++samples;
  }}
  fclose(file);
  for (int i = 0; i < output_count; ++i) {{
    const int bad = !(largest[i] <= tolerance[i]);
    printf("%s %-16s largest difference %9.2e, tolerance %9.2e%s\n", name, output_names[i],
           largest[i], tolerance[i], bad ? "  FAILED" : "");
    failed = failed || bad;
  }}
  if (samples != expected) {{
    fprintf(stderr, "%s/%s: expected %d samples, found %d\n", folder, name, expected, samples);
    return 2;
  }}
  return failed;
}}

int main(int argument_count, char **arguments)
{{
  char line[longest_line];
  int result = 0;
  int vectors = 0;
  FILE *list;
  if (argument_count != 2) {{
    fprintf(stderr, "usage: servo_controller_test FOLDER\n");
    return 2;
  }}
  list = open_in(arguments[1], "tolerances.csv");
  if (list == NULL) return 2;
  while (fgets(line, sizeof line, list) != NULL) {{
    double numbers[1 + 2 * output_count];
    char *comma = strchr(line, ',');
    int single = sizeof(servo_real) == sizeof(float);
    int one;
    if (line[0] == '#') continue;
    if (comma == NULL ||
        read_numbers(comma + 1, numbers, 1 + 2 * output_count) != 1 + 2 * output_count) {{
      fprintf(stderr, "%s/tolerances.csv: expected a row per vector, found: %s", arguments[1], line);
      fclose(list);
      return 2;
    }}
    *comma = '\0';
    one = run_vector(arguments[1], line, (int)numbers[0],
                     numbers + 1 + (single ? output_count : 0));
    if (one > result) result = one;
    ++vectors;
  }}
  fclose(list);
  if (vectors == 0) {{
    fprintf(stderr, "%s/tolerances.csv: no vectors\n", arguments[1]);
    return 2;
  }}
  return result;
}}
)",
                      input_count, output_count, names, inputs, outputs,
                      "#include \"servo_controller.h\"")};
}

}  // namespace boresight::io
