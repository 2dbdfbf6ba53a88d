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
  /// rad of motor, one a sample, turned round if the case says that the column is reversed. None:
  /// its unit is none of an angle, its rows are not the record's samples (some were cut or put on
  /// another time base), or one is not a number.
  std::optional<Eigen::VectorXd> motor_angle;
};

/// The first column of a record's file whose name begins with "encoder", in any case of letters;
/// nothing without one. `samples`: of the record as used. @throws InvalidInput as read_record.
std::optional<EncoderColumn> encoder_column(const Case& antenna, const RecordNotes& notes,
                                            Eigen::Index samples);

}  // namespace boresight::io
