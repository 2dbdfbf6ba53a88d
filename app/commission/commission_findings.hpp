#pragma once

#include <string>
#include <vector>

#include <boresight/app/commission/commission_study.hpp>

namespace boresight::app {

/// "rate loop, 2 of 5".
std::string stage_name(const design::CommissioningStage& stage);
/// The command to make in a stage, in words: "step of the rate command, 10 mdeg/s at the sky".
std::string command_in_words(const CommissionReport& report, const StageSheet& sheet);
/// The steady motion below it, how long it lasts, and the record in still air. Empty without
/// [simulation] of the case.
std::string motion_in_words(const CommissionReport& report, const StageSheet& sheet);

// Sentences: what the records of stages say, what fresh plants and faults do; none where there are
// no such results.
std::vector<std::string> about_records(const CommissionReport& report);
std::vector<std::string> about_trials(const CommissionReport& report);

/// The same results as tables, and where they come from.
Document records_part(const CommissionReport& report);
Document trials_part(const CommissionReport& report);

}  // namespace boresight::app
