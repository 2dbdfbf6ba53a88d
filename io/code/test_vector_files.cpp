#include <fmt/format.h>

#include <boresight/io/code/test_vector_files.hpp>

namespace boresight::io {
namespace {

using control::program::Program;
using control::program::Role;

std::string columns(const Program& program, Role role, const std::string& suffix = {}) {
  std::string text;
  for (const auto& variable : program.variables) {
    if (variable.role == role) text += fmt::format(",{}{}", variable.name, suffix);
  }
  return text;
}

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format(",{:.17g}", value);
  return text;
}

}  // namespace

std::vector<CodeFile> test_vector_files(const Program& program,
                                        const std::vector<control::program::TestVector>& vectors) {
  std::vector<CodeFile> files;
  std::string tolerances =
      fmt::format("# vector,samples{}{}\n", columns(program, Role::output, " (double)"),
                  columns(program, Role::output, " (single)"));
  for (const auto& vector : vectors) {
    std::string text = fmt::format("# {}\n# sample{}{}\n", vector.description,
                                   columns(program, Role::input), columns(program, Role::output));
    for (std::size_t k = 0; k < vector.inputs.size(); ++k) {
      text += fmt::format("{}{}{}\n", k, numbers(vector.inputs[k]), numbers(vector.outputs[k]));
    }
    tolerances += fmt::format("{}.csv,{}{}{}\n", vector.name, vector.inputs.size(),
                              numbers(vector.double_tolerance), numbers(vector.single_tolerance));
    files.push_back({vector.name + ".csv", std::move(text)});
  }
  files.push_back({"tolerances.csv", std::move(tolerances)});
  return files;
}

}  // namespace boresight::io
