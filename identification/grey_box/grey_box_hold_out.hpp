#pragma once

#include <optional>
#include <string>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/identification/grey_box/grey_box_simulation.hpp>

namespace boresight::identification {

/// A record that was not fitted, and what the drive fitted to the others makes of it.
struct GreyBoxHoldOut {
  GreyBoxValidation error;
  GreyBoxRecord recorded;   // as the grey box reads it
  GreyBoxRecord simulated;  // from the valve's command alone, at the same samples
};

/// Fits the campaign without the named record and runs the drive by that record's valve command.
/// @throws InvalidInput for a name that no record of the campaign has, or a record without valve
/// command; as fit_grey_box and simulate_drive.
GreyBoxHoldOut hold_out_record(const Campaign& campaign, const std::string& name,
                               const std::optional<numerics::Interval>& bulk_modulus = {},
                               const GreyBoxOptions& options = {});

}  // namespace boresight::identification
