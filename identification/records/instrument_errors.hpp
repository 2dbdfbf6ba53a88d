#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <boresight/identification/records/drive_record.hpp>

namespace boresight::identification {

/// Errors that the recorded channels and the stated motor constants may have, in the order of a
/// motion's pressure_impulse: all inlets, then all outlets. A transducer shows
/// (1 + gain) pressure + zero. All 0: as recorded.
struct InstrumentErrors {
  Eigen::VectorXd pressure_gain;  // relative
  Eigen::VectorXd pressure_zero;  // Pa
  double tachometer_scale = 0.0;  // relative: recorded rate = (1 + scale) rate
  double torque_scale = 0.0;      // relative, of displacement times torque efficiency
};

/// Pressure channels of the campaign's records: the most that any has.
Eigen::Index channel_count(const Campaign& campaign);

/// No errors, for so many pressure channels.
InstrumentErrors no_instrument_errors(Eigen::Index channels);

/// Sample number `draw` of a seed's errors: independent and normal, with the campaign's standard
/// uncertainties. It does not depend on other samples.
InstrumentErrors draw_instrument_errors(const Campaign& campaign, std::uint64_t seed,
                                        std::uint64_t draw);

/// Integral of the torque (N m s) from pressure impulses (Pa s) over a duration (s), the errors
/// removed to first order: k (1 + torque scale) times the sum of inlets less that of outlets of
/// (1 - gain) impulse - zero duration. `inlets`: how many of the impulses are inlets'.
double torque_impulse(const Eigen::VectorXd& pressure_impulse, Eigen::Index inlets, double duration,
                      double torque_per_pressure, const InstrumentErrors& errors);

}  // namespace boresight::identification
