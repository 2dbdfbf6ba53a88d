#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include <boresight/io/campaign/campaign.hpp>

namespace boresight::io {

/// The record of that name, if loops can be tuned on the response that it shows.
/// @throws InvalidInput for a name that the case has no record of and for a record that was left
/// out, one without valve command or pressures, one with the rate loop closed.
const identification::DriveRecord& record_of_response(const identification::Campaign& campaign,
                                                      const CampaignNotes& notes,
                                                      const std::string& name);

/// A column of a record's file with the antenna's angle.
struct EncoderColumn {
  std::string name;
  /// rad of motor, one per sample, negated if the case states that the column is reversed. None if
  /// its unit is not an angle's, or one value is not a number. None also if its rows are not the
  /// record's samples (some were cut or put on another time base).
  std::optional<Eigen::VectorXd> motor_angle;
};

/// The first column of a record's file whose name begins with "encoder", in any case of letters;
/// nothing without one. `samples`: of the record as used. @throws InvalidInput as read_record.
std::optional<EncoderColumn> encoder_column(const Case& antenna, const RecordNotes& notes,
                                            Eigen::Index samples);

}  // namespace boresight::io
