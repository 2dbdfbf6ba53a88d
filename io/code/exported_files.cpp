#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include <boresight/control/controllers/path_sections.hpp>
#include <boresight/io/code/c_code.hpp>
#include <boresight/io/code/exported_files.hpp>
#include <boresight/io/code/octave_code.hpp>
#include <boresight/io/code/program_json.hpp>
#include <boresight/io/code/simulink_model.hpp>
#include <boresight/io/code/structured_text.hpp>
#include <boresight/io/code/test_vector_files.hpp>
#include <boresight/io/exchange/controller_file.hpp>
#include <boresight/numerics/error.hpp>

namespace boresight::io {
namespace {

using control::program::Program;

std::string gain_text(const GainRow& row) {
  return row.unit == "1" || row.unit.empty() ? fmt::format("{:.17g}", row.value)
                                             : fmt::format("{:.17g} {}", row.value, row.unit);
}

// Text of a user's within comments of any of the languages.
std::string in_comment(std::string text) {
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < ' ') letter = ' ';
  }
  for (const char* mark : {"*/", "/*", "*)", "(*", "//"}) {
    for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark)) {
      text.insert(at + 1, " ");
    }
  }
  return text;
}

// With antenna, gains and their source in its notes.
Program described_program(const design::ExportedController& exported,
                          const ExportOptions& options) {
  Program program = exported.program;
  if (!options.antenna.empty()) program.notes.push_back(options.antenna + ".");
  program.notes.push_back(fmt::format("Sample time: {:.9g} s.", program.sample_time));
  program.notes.push_back(fmt::format("Controller: {}.", options.source));
  std::string gains;
  for (const auto& row : gain_rows(exported.controller)) {
    gains += fmt::format("{}{} = {:.9g}{}{}", gains.empty() ? "" : ", ", row.symbol, row.value,
                         row.unit == "1" ? "" : " ", row.unit == "1" ? "" : row.unit);
  }
  if (!gains.empty()) program.notes.push_back("Gains at the motor shaft: " + gains + ".");
  program.title = in_comment(program.title);
  for (auto& note : program.notes) note = in_comment(note);
  for (auto& variable : program.variables) {
    variable.comment = in_comment(variable.comment);
    variable.unit = in_comment(variable.unit);
  }
  return program;
}

void replace_all(std::string& text, std::string_view old, const std::string& by) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size())) {
    text.replace(at, old.size(), by);
  }
}

void rename(CodeFile& file, const std::string& prefix) {
  if (prefix == "servo") return;
  std::string upper = prefix;
  for (char& letter : upper) {
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  for (std::string* text : {&file.name, &file.content}) {
    replace_all(*text, "servo_", prefix + "_");
    replace_all(*text, "SERVO_", upper + "_");
  }
}

void require_prefix(const std::string& prefix) {
  constexpr std::size_t longest = 20;
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const bool good =
      !prefix.empty() && prefix.size() <= longest && is_letter(prefix.front()) &&
      std::ranges::all_of(prefix, [&](char c) {
        return is_letter(c) || c == '_' || std::isdigit(static_cast<unsigned char>(c)) != 0;
      });
  if (!good) {
    throw InvalidInput(fmt::format(
        "export: expected a prefix of at most {} letters, digits and underscores that begins with "
        "a letter, found '{}'",
        longest, prefix));
  }
}

void append(std::vector<CodeFile>& files, std::vector<CodeFile> more) {
  std::ranges::move(more, std::back_inserter(files));
}

}  // namespace

std::string_view to_string(CodeLanguage language) {
  switch (language) {
    case CodeLanguage::c:
      return "c";
    case CodeLanguage::structured_text:
      return "st";
    case CodeLanguage::simulink:
      return "simulink";
    case CodeLanguage::json:
      return "json";
  }
  throw InvalidInput("code language: not one of those there are");
}

const std::vector<CodeLanguage>& code_languages() {
  static const std::vector<CodeLanguage> all{CodeLanguage::c, CodeLanguage::structured_text,
                                             CodeLanguage::simulink, CodeLanguage::json};
  return all;
}

CodeFile controller_to_read(const control::Controller& controller, const std::string& structure) {
  if (const plant::StateSpace* system = controller.structure.state_space()) {
    return {"state_space.json", controller_json(*system)};
  }
  std::string text = fmt::format("[gains]\nstructure = \"{}\"\n", structure);
  const auto& descriptions = controller.structure.gains();
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    const auto& [name, symbol, unit, lower, upper] = descriptions[i];
    text +=
        fmt::format("{} = \"{}\"\n", symbol, gain_text({symbol, name, controller.gains[i], unit}));
  }
  return {"gains.toml", std::move(text)};
}

std::vector<GainRow> gain_rows(const control::Controller& controller) {
  std::vector<GainRow> rows, integrals;
  std::size_t first = 0;
  for (const auto& block : controller.structure.blocks()) {
    for (std::size_t i = 0; i < block.gains.size(); ++i) {
      const auto& gain = block.gains[i];
      rows.push_back({gain.symbol, gain.name, controller.gains[first + i], gain.unit});
    }
    if (block.kind == control::BlockKind::integral) {
      const bool rate = block.path == control::LoopPath::rate;
      integrals.push_back({rate ? "Kir" : "Kip",
                           fmt::format("{} integral gain, proportional gain times {}",
                                       to_string(block.path), block.gains.front().symbol),
                           control::path_gain(controller, block.path) * controller.gains[first],
                           rate ? "1/s" : "1/s2"});
    }
    first += block.gains.size();
  }
  std::ranges::move(integrals, std::back_inserter(rows));
  return rows;
}

CodeFile exported_json(const design::ExportedController& exported, const CaseSignals& signals,
                       const ExportOptions& options) {
  require_prefix(options.prefix);
  CodeFile file = program_json(described_program(exported, options), exported, signals);
  rename(file, options.prefix);
  return file;
}

std::vector<CodeFile> exported_files(const design::ExportedController& exported,
                                     const CaseSignals& signals, const ExportOptions& options) {
  require_prefix(options.prefix);
  const Program program = described_program(exported, options);
  std::vector<CodeFile> files;
  bool tested = false;
  for (const CodeLanguage language : options.languages) {
    switch (language) {
      case CodeLanguage::c:
        append(files, c_code(program, options.precision));
        files.push_back(c_test_program(program));
        break;
      case CodeLanguage::structured_text:
        files.push_back(structured_text(program, options.precision));
        break;
      case CodeLanguage::simulink:
        append(files, octave_code(program));
        files.push_back(simulink_model(exported));
        break;
      case CodeLanguage::json:
        files.push_back(program_json(program, exported, signals));
        break;
    }
    tested = tested || language != CodeLanguage::json;
  }
  if (tested) {
    auto vectors = test_vector_files(program, exported.vectors);
    for (auto& file : vectors) file.name = "vectors/" + file.name;
    append(files, std::move(vectors));
  }
  for (auto& file : files) rename(file, options.prefix);
  files.push_back(controller_to_read(exported.controller, options.structure));
  return files;
}

}  // namespace boresight::io
