#pragma once

#include <string>
#include <vector>

#include <boresight/design/studies/export_study.hpp>
#include <boresight/io/code/code_writer.hpp>
#include <boresight/io/code/computer_signals.hpp>

namespace boresight::io {

enum class CodeLanguage { c, structured_text, simulink, json };
/// "c", "st", "simulink", "json".
std::string_view to_string(CodeLanguage language);
const std::vector<CodeLanguage>& code_languages();

struct ExportOptions {
  std::vector<CodeLanguage> languages = code_languages();
  control::program::Precision precision = control::program::Precision::double_precision;
  /// The user's name of the structure, for a file of gains.
  std::string structure;
  std::string source;   // where the controller comes from, in words
  std::string antenna;  // antenna, axis and case, for the heads of the files
  /// Begins the names of files, types and functions: "servo". A letter, then letters, digits and
  /// underscores. Two axes in one computer have two.
  std::string prefix = "servo";
};

/// A gain, or a quantity derived from gains, in SI at the motor shaft.
struct GainRow {
  std::string symbol, name;
  double value = 0.0;
  std::string unit;
};

/// The gains in corner form, as the structure has them, and those of the integrals also in Ki form,
/// Ki = K wi. Empty of a state space.
std::vector<GainRow> gain_rows(const control::Controller& controller);

/// A controller in the form in which every command reads it: gains.toml (--gains), with the user's
/// name of the structure, or of a state space state_space.json (--controller). To the last bit.
CodeFile controller_to_read(const control::Controller& controller, const std::string& structure);

/// The files of a controller in the languages asked for, names relative to the folder:
///   c          servo_controller.h, .c, servo_controller_test.c
///   st         servo_controller.st
///   simulink   servo_controller.m, servo_parameters.m, servo_initial_state.m, servo_model.m
///   json       servo_controller.json: all parameters with units
/// with test vectors in vectors/ beside the first three, and controller_to_read.
std::vector<CodeFile> exported_files(const design::ExportedController& exported,
                                     const CaseSignals& signals, const ExportOptions& options);

/// The file of CodeLanguage::json alone.
CodeFile exported_json(const design::ExportedController& exported, const CaseSignals& signals,
                       const ExportOptions& options);

}  // namespace boresight::io
