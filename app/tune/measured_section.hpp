#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <boresight/design/studies/measured_tuning_study.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::app {

using design::MeasuredController;

/// What to tune on a record of the case.
struct MeasuredTuneOptions {
  std::string record;                   // its name
  std::vector<std::string> structures;  // short names; empty: PI and DPF
  int starts = 0;                       // 0: as the tuner has it
  std::uint64_t seed = 1;
  /// Asked now and then; true ends the work with what was found.
  std::function<bool()> interrupted;
};

/// Results of `boresight tune --measured`, and the parts of the case's text that its report needs.
struct MeasuredTuneSection : design::MeasuredTuningStudy {
  std::string record;
  std::string encoder_column;  // empty: none was used
  std::string oil_source;
  /// Assumptions, and quantities that were not evaluated, a sentence each.
  std::vector<std::string> notes;
};

/// design::study_measured_tuning on a record of the case, with the antenna's angle of
/// io::encoder_column where it has one.
/// @throws InvalidInput naming the option for a record that io::record_of_response refuses, for a
/// structure that is none; as io::make_campaign and design::study_measured_tuning.
MeasuredTuneSection tune_measured(const io::Case& antenna, const MeasuredTuneOptions& options);

}  // namespace boresight::app
