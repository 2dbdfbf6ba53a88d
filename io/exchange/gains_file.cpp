#include <fmt/format.h>

#include <boresight/io/case/case_tuning.hpp>
#include <boresight/io/case/table_reader.hpp>
#include <boresight/io/exchange/gains_file.hpp>
#include <boresight/io/files/input_files.hpp>
#include <boresight/io/units/wording.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

GainsOfFile gains_from(TableReader& table, const Case& antenna) {
  GainsOfFile result;
  result.structure = table.text("structure");
  control::Controller& controller = result.controller;
  try {
    controller.structure = loop_structure(antenna, result.structure);
  } catch (const InvalidInput& error) {
    table.refuse("structure", error.what());
  }
  for (const auto& block : controller.structure.blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      controller.gains.push_back(table
                                     .quantity(block.gains[i].symbol,
                                               gain_kind(block.path, block.kind, i),
                                               Range::positive(1e11))
                                     .value);
    }
  }
  table.finish();
  return result;
}

}  // namespace

GainsOfFile read_gains_file(const std::string& path, const Case& antenna,
                            const std::string& structure, design::Fitness accepted) {
  const std::string text = read_input(path);
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    return controller_of_report(antenna, text, path, structure, accepted);
  }
  TableReader file = TableReader::parse(text, path);
  GainsOfFile result;
  if (auto table = file.optional_table("gains")) {
    result = gains_from(*table, antenna);
    file.finish();
  } else {
    result = gains_from(file, antenna);
  }
  if (!structure.empty() && loop_structure(antenna, structure) != result.controller.structure) {
    throw InvalidInput(fmt::format("{}: expected gains of {}, found those of {}", path,
                                   in_quotes(structure), in_quotes(result.structure)));
  }
  return result;
}

}  // namespace boresight::io
