#include <nlohmann/json.hpp>

#include <boresight/io/code/exported_files.hpp>
#include <boresight/io/code/program_json.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using control::program::Program;
using control::program::Role;
using control::program::Type;
using control::program::Variable;
using Json = nlohmann::ordered_json;

const char* type_name(Type type) {
  switch (type) {
    case Type::boolean:
      return "boolean";
    case Type::integer:
      return "integer";
    case Type::real:
      return "real";
    case Type::wide:
      return "double";
  }
  throw InvalidInput("program: not one of the types there are");
}

Json described(const Variable& variable) {
  Json object{{"name", variable.name}, {"type", type_name(variable.type)}};
  if (!variable.unit.empty()) object["unit"] = variable.unit;
  if (!variable.comment.empty()) object["description"] = variable.comment;
  if (variable.role == Role::parameter) object["value"] = variable.initial;
  return object;
}

Json all_of(const Program& program, Role role) {
  Json list = Json::array();
  for (const auto& variable : program.variables) {
    if (variable.role == role) list.push_back(described(variable));
  }
  return list;
}

}  // namespace

CodeFile program_json(const Program& program, const design::ExportedController& exported,
                      const CaseSignals& signals) {
  Json gains = Json::array();
  for (const auto& row : gain_rows(exported.controller)) {
    gains.push_back(
        {{"symbol", row.symbol}, {"name", row.name}, {"value", row.value}, {"unit", row.unit}});
  }
  Json scales = Json::array();
  for (const auto& signal : signals.descriptions) {
    scales.push_back(
        {{"signal", signal.signal}, {"scale", signal.scale}, {"stated", signal.stated}});
  }
  const Json file{{"title", program.title},
                  {"notes", program.notes},
                  {"structure", exported.controller.structure.name()},
                  {"sample_time_s", program.sample_time},
                  {"operations_per_step", operation_count(program)},
                  {"gains", gains},
                  {"signals", scales},
                  {"friction_feedforward_fraction", exported.friction_feedforward},
                  {"parameters", all_of(program, Role::parameter)},
                  {"inputs", all_of(program, Role::input)},
                  {"outputs", all_of(program, Role::output)},
                  {"states", all_of(program, Role::state)}};
  return {"servo_controller.json", file.dump(2) + "\n"};
}

}  // namespace boresight::io
