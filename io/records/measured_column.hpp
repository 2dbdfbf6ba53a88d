#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include <boresight/io/case/case_campaign.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/records/column_chooser.hpp>
#include <boresight/io/records/record_table.hpp>
#include <boresight/io/records/signal_source.hpp>
#include <boresight/io/units/units.hpp>

namespace boresight::io {

/// A column of a file and the unit of its numbers.
struct MeasuredColumn {
  const RecordColumn& column;
  Unit unit;
  SignalSource source;  // its unit: as the file or the case states it
};

/// A column with its unit: the file's, or the case's where the file states none or one that is not
/// known. `signal` and `key` (of record_columns) are for the source and for messages.
/// @throws InvalidInput without a unit, or if file and case state different ones.
MeasuredColumn measured_column(const RecordTable& table, const ChosenColumn& chosen,
                               const std::optional<ColumnEntry>& entry, const std::string& signal,
                               const std::string& key);

/// The column's numbers times `factor`, or times its negative if the case reverses the column; the
/// source then has the remark "sign turned".
Eigen::VectorXd scaled_values(const RecordColumnsEntry& columns, MeasuredColumn& measured,
                              double factor);

/// @throws InvalidInput, always: the column's unit does not measure `expected` ("a pressure").
[[noreturn]] void refuse_kind(const RecordTable& table, const MeasuredColumn& measured,
                              const std::string& expected);

/// Turns of the motor in a turn of the shaft "motor", "antenna" or "tachometer".
/// @throws InvalidInput if the case does not state the tachometer's gear, which `what` needs.
double motor_turns(const Case& antenna, const std::string& shaft, const std::string& what);

/// The dimension of a product.
Dimension product(const Dimension& a, const Dimension& b);

}  // namespace boresight::io
