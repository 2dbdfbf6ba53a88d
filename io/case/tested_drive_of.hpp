#pragma once

#include <optional>

#include <boresight/design/simulation/drive_tests.hpp>
#include <boresight/io/case/case_declaration.hpp>

/// What a case's antenna is simulated with.
namespace boresight::io {

/// @throws InvalidInput naming the table [simulation] if the case has none.
void require_simulation(const Case& stated);

/// The nonlinear antenna of antenna_of(stated).
/// @throws InvalidInput as require_simulation, antenna_of and plant::nonlinear_antenna.
plant::NonlinearAntenna make_nonlinear_antenna(const Case& stated);

/// Rate of the motors per volt of the tachometer (rad/s per V), on whichever shaft it is
/// (Sommerville, eq. 32); none unless the case states its voltage at a speed.
std::optional<double> motor_rate_per_volt(const Case& stated);

/// The recorder of the case's tests, the tachometer on a shaft of its own, the motor's or the
/// antenna's.
/// @throws InvalidInput naming what is missing: the table [recorder], the table [tachometer], its
/// voltage or its recorder_limit.
plant::Recorder recorder_of(const Case& stated);

/// The drive under test: its recorder reads pressures at the motors' ends of the oil lines.
/// @throws InvalidInput as make_nonlinear_antenna and recorder_of, and without lines.
design::TestedDrive tested_drive_of(const Case& stated);

}  // namespace boresight::io
