#include <cmath>
#include <initializer_list>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/io/exchange/state_space_formats.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& file, const char* key, const std::string& expected,
                         const std::string& found) {
  throw InvalidInput(fmt::format("{}: {}: expected {}, found {}", file, key, expected, found));
}

double number_of(const Json& value, const std::string& file, const char* key) {
  if (!value.is_number()) refuse(file, key, "numbers", in_quotes(value.dump().substr(0, 40)));
  return value.get<double>();
}

// Rows of numbers; a bare number is 1 x 1, an empty list has no rows.
Eigen::MatrixXd matrix_of(const Json& json, const std::string& file, const char* key,
                          Eigen::Index rows_if_empty, Eigen::Index columns_if_empty) {
  if (!json.contains(key)) return Eigen::MatrixXd::Zero(rows_if_empty, columns_if_empty);
  const Json& value = json.at(key);
  if (value.is_number()) return Eigen::MatrixXd::Constant(1, 1, value.get<double>());
  if (!value.is_array()) refuse(file, key, "a list of rows", in_quotes(value.type_name()));
  const auto rows = static_cast<Eigen::Index>(value.size());
  if (rows == 0) return Eigen::MatrixXd::Zero(rows_if_empty, columns_if_empty);
  Eigen::MatrixXd matrix;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Json& row = value.at(static_cast<std::size_t>(i));
    if (!row.is_array()) refuse(file, key, "a list of rows", "a row that is no list");
    const auto columns = static_cast<Eigen::Index>(row.size());
    if (i == 0) matrix.resize(rows, columns);
    if (columns != matrix.cols()) {
      refuse(file, key, fmt::format("rows of {} numbers", matrix.cols()),
             fmt::format("one of {}", columns));
    }
    for (Eigen::Index j = 0; j < columns; ++j) {
      matrix(i, j) = number_of(row.at(static_cast<std::size_t>(j)), file, key);
    }
  }
  return matrix;
}

std::vector<std::string> texts_of(const Json& json, const std::string& file, const char* key) {
  std::vector<std::string> texts;
  if (!json.contains(key)) return texts;
  const Json& value = json.at(key);
  if (!value.is_array()) refuse(file, key, "a list of texts", in_quotes(value.type_name()));
  for (const auto& text : value) {
    if (!text.is_string())
      refuse(file, key, "a list of texts", in_quotes(text.dump().substr(0, 40)));
    texts.push_back(text.get<std::string>());
  }
  return texts;
}

// The state space meant in a report of a command that writes several, else the whole.
Json part_of(Json json, const std::string& name, const std::string& part) {
  const Json models = json.contains("linear_models") ? json.at("linear_models") : Json();
  if (!models.is_object()) {
    chosen_part({}, part, name);
    return json;
  }
  std::vector<std::string> parts;
  for (const auto& [key, value] : models.items()) {
    if (value.is_object() && value.contains("D")) parts.push_back(key);
  }
  const std::string chosen = chosen_part(parts, part, name);
  if (chosen.empty()) refuse(name, "linear_models", "a controller", "none");
  return models.at(chosen);
}

}  // namespace

ControllerText controller_from_json(std::string_view content, const std::string& name,
                                    const std::string& part) {
  Json json;
  try {
    json = Json::parse(content);
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("{}: expected a MAT file of version 5 or JSON, found: {}", name,
                                   in_quotes(std::string_view(error.what()).substr(0, 200))));
  }
  if (!json.is_object()) {
    throw InvalidInput(fmt::format("{}: expected an object with A, B, C, D, found {}", name,
                                   in_quotes(json.type_name())));
  }
  json = part_of(std::move(json), name, part);
  static constexpr std::array known{"format", "A",           "B",           "C",
                                    "D",      "inputs",      "outputs",     "states",
                                    "title",  "sample_time", "input_units", "output_units",
                                    "angles", "state_units"};
  for (const auto& [key, value] : json.items()) {
    if (std::ranges::find(known, key) == known.end()) {
      throw InvalidInput(fmt::format("{}: expected the keys {}, found {}", name,
                                     "A, B, C, D, inputs, outputs, sample_time, input_units, "
                                     "output_units, angles, states, title",
                                     in_quotes(key)));
    }
  }
  if (!json.contains("D")) refuse(name, "D", "a list of rows", "none");
  ControllerText text;
  try {
    text.inputs = texts_of(json, name, "inputs");
    text.outputs = texts_of(json, name, "outputs");
    text.input_units = texts_of(json, name, "input_units");
    text.output_units = texts_of(json, name, "output_units");
    text.d = matrix_of(json, name, "D", 0, 0);
    text.a = matrix_of(json, name, "A", 0, 0);
    text.b = matrix_of(json, name, "B", text.a.rows(), text.d.cols());
    text.c = matrix_of(json, name, "C", text.d.rows(), text.a.cols());
    if (json.contains("sample_time")) {
      text.sample_time = number_of(json.at("sample_time"), name, "sample_time");
    }
    if (json.contains("angles")) text.angles = json.at("angles").get<std::string>();
  } catch (const Json::exception& error) {
    throw InvalidInput(fmt::format("{}: expected a controller, found: {}", name,
                                   in_quotes(std::string_view(error.what()).substr(0, 200))));
  }
  return text;
}

std::string controller_json(const plant::StateSpace& controller) {
  Json json{{"format", "boresight controller"}};
  json.update(state_space_json(controller));
  return json.dump(1) + "\n";
}

}  // namespace boresight::io
