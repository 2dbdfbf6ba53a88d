#pragma once

#include <boresight/design/studies/export_study.hpp>
#include <boresight/io/code/code_writer.hpp>
#include <boresight/io/code/computer_signals.hpp>

namespace boresight::io {

/// servo_controller.json: title, notes, sample time, gains, signals, and every parameter, input,
/// output and state with unit and description; numbers with all their digits.
CodeFile program_json(const control::program::Program& program,
                      const design::ExportedController& exported, const CaseSignals& signals);

}  // namespace boresight::io
