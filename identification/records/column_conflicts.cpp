#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include <boresight/identification/records/column_conflicts.hpp>

namespace boresight::identification {
namespace {

bool in_motion(const EvaluatedRecord& one) {
  return one.clean->record && one.clean->record->test != TestKind::slosh &&
         !one.clean->without_rate;
}

bool among(const std::vector<std::size_t>& motors, std::size_t motor) {
  return std::find(motors.begin(), motors.end(), motor) != motors.end();
}

/// The records in motion of which something is said.
class Votes {
 public:
  template <typename Said>
  Votes(const std::vector<EvaluatedRecord>& records, const Said& said) {
    for (const EvaluatedRecord& one : records) {
      if (!in_motion(one)) continue;
      ++all_;
      if (!said(one)) continue;
      ++count_;
      if (first_.empty()) first_ = one.raw->name;
    }
  }
  bool active() const { return count_ > 0 && 2 * count_ >= all_; }
  std::string where() const {
    return fmt::format("{} of {} records in motion, '{}' first", count_, all_, first_);
  }

 private:
  std::size_t count_ = 0;
  std::size_t all_ = 0;
  std::string first_;
};

constexpr const char* against_motion = "inlet above outlet drives against the tachometer";

constexpr const char* ambiguous =
    "which motors have their inlet and outlet exchanged cannot be told, half of them or more go "
    "against the others";

std::string pressure_columns(const RawRecord& raw, const std::vector<std::size_t>& motors) {
  std::string columns;
  for (const std::size_t motor : motors) {
    columns += fmt::format("{}{} and {}", columns.empty() ? "" : ", ", raw.inlet[motor].name,
                           raw.outlet[motor].name);
  }
  return columns;
}

std::string ambiguous_refusal(const RawRecord& raw, const std::vector<std::size_t>& motors) {
  return fmt::format("{} ({})", ambiguous, pressure_columns(raw, motors));
}

std::string exchanged_refusal(const RawRecord& raw, const std::vector<std::size_t>& motors,
                              const Votes& votes) {
  return fmt::format(
      "the pressure differences of motors go against one another in {}: {} ({}). Exchange the "
      "columns of the motor that is wired the other way in record_columns.inlet and .outlet",
      votes.where(), ambiguous, pressure_columns(raw, motors));
}

std::string torque_refusal(const RawRecord& raw, const Votes& votes) {
  return fmt::format(
      "{} in {}, where friction would have it take power: the sign of {} is turned "
      "(record_columns.reversed turns it back), or record_columns.inlet and .outlet are exchanged",
      against_motion, votes.where(), raw.tachometer.name);
}

// Motors that the campaign shows to be exchanged.
std::vector<std::size_t> exchanged_motors(const std::vector<EvaluatedRecord>& records,
                                          ColumnConflicts& conflicts) {
  std::vector<std::size_t> exchanged;
  const std::size_t motors = records.front().raw->inlet.size();
  for (std::size_t motor = 0; motor < motors; ++motor) {
    const Votes votes(records, [motor](const EvaluatedRecord& one) {
      return among(one.clean->suspicions.exchanged_motors, motor);
    });
    if (votes.active()) exchanged.push_back(motor);
  }
  if (!exchanged.empty() && 2 * exchanged.size() >= motors) {
    const Votes votes(records, [&](const EvaluatedRecord& one) {
      return among(one.clean->suspicions.exchanged_motors, exchanged.front());
    });
    conflicts.refusal = exchanged_refusal(*records.front().raw, exchanged, votes);
  }
  return exchanged;
}

void evaluate_ports(const EvaluatedRecord& one, const std::vector<std::size_t>& everywhere,
                    RecordConflict& conflict) {
  const auto& own = one.clean->suspicions.exchanged_motors;
  const auto& exchanged = everywhere.empty() ? own : everywhere;
  if (exchanged.empty()) return;
  if (2 * exchanged.size() >= one.raw->inlet.size()) {
    conflict.refusal = ambiguous_refusal(*one.raw, exchanged);
    return;
  }
  conflict.options.exchanged_motors = exchanged;
  conflict.again = true;
}

// Whether a command is against the tachometer in most of the records that have it.
template <typename Command, typename Against>
bool against_everywhere(const std::vector<EvaluatedRecord>& records, const Command& command,
                        const Against& against) {
  std::vector<EvaluatedRecord> having;
  for (const EvaluatedRecord& one : records) {
    if (one.raw->*command) having.push_back(one);
  }
  return Votes(having, [&](const EvaluatedRecord& one) { return one.clean->suspicions.*against; })
      .active();
}

}  // namespace

ColumnConflicts column_conflicts(const std::vector<EvaluatedRecord>& records) {
  ColumnConflicts conflicts;
  conflicts.records.resize(records.size());
  if (records.empty()) return conflicts;
  const auto exchanged = exchanged_motors(records, conflicts);
  const Votes torque(records,
                     [](const EvaluatedRecord& one) { return one.clean->suspicions.torque; });
  if (conflicts.refusal.empty() && torque.active()) {
    conflicts.refusal = torque_refusal(*records.front().raw, torque);
  }
  if (!conflicts.refusal.empty()) return conflicts;
  const bool no_rate_command =
      against_everywhere(records, &RawRecord::rate_command, &ColumnSuspicions::rate_command);
  const bool no_valve_command =
      against_everywhere(records, &RawRecord::valve_command, &ColumnSuspicions::valve_command);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const EvaluatedRecord& one = records[i];
    if (!one.clean->record) continue;
    RecordConflict& conflict = conflicts.records[i];
    const ColumnSuspicions& own = one.clean->suspicions;
    // What a slosh test shows of directions is one blow of the valve: nothing to go by.
    const bool moving = in_motion(one);
    if (moving || !exchanged.empty()) evaluate_ports(one, exchanged, conflict);
    if (moving && own.torque && !conflict.again) conflict.refusal = against_motion;
    conflict.options.leave_out_rate_command =
        one.raw->rate_command && (no_rate_command || (moving && own.rate_command));
    conflict.options.leave_out_valve_command =
        one.raw->valve_command && (no_valve_command || (moving && own.valve_command));
    conflict.again = conflict.again || conflict.options.leave_out_rate_command ||
                     conflict.options.leave_out_valve_command;
  }
  return conflicts;
}

}  // namespace boresight::identification
