#pragma once

#include <Eigen/Core>

#include <boresight/plant/wind/torque_coefficients.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::plant {

/// What an anemometer recorded at one point, in steps of sample_time (s).
struct WindRecord {
  double sample_time = 0.0;
  Eigen::VectorXd speed;  // m/s, horizontal, at least 0
  /// Where the wind comes from, rad from north over east; empty if not recorded.
  Eigen::VectorXd direction;
};

/// @throws InvalidInput, naming `function`, for a sample_time that is not above 0, fewer than 2 or
/// more than 2^26 samples, speeds that are negative, not finite or all 0, and directions that are
/// not finite or not as many as the speeds.
void validate(const WindRecord& record, std::string_view function);

/// Where the dish points, rad: azimuth from north over east, elevation from the horizon.
struct DishDirection {
  double azimuth = 0.0;
  double elevation = 0.0;
};

struct RecordTorqueOptions {
  WindModel model = WindModel::coherence;
  /// Torque about its mean over the record, as synthesised series have it, instead of the whole.
  bool remove_mean = false;
};

/// The axis torque (N m) of a recorded wind, sample by sample: the quasi-static 1/2 rho V(t)^2 A D
/// C, C the site's torque_coefficient. It is smoothed over the dish by wind_admittance at the
/// record's mean speed. The smoothing acts on the torque, since pressures add up over the dish as
/// squares of the local speeds. It preserves the mean, that of V^2: 1/2 rho (mean^2 + variance) A D
/// C. It has zero phase, as the anemometer stands at the dish. The record is mirrored at both ends
/// for the computation.
///
/// One point contains no information on gradients over the dish, so the gradient part of the
/// coherence model is missing. Add a sample of it from wind_torque_series
/// (WindTorquePart::gradient) at the mean speed.
/// @throws InvalidInput as validate of record and site.
Eigen::VectorXd wind_record_torque(const WindRecord& record, const WindSite& site,
                                   const RecordTorqueOptions& options = {});

/// The same with C(t) from a table at the yaw direction(t) - azimuth and the elevation of the dish.
/// @throws InvalidInput also for a record without directions and out of the table.
Eigen::VectorXd wind_record_torque(const WindRecord& record, const WindSite& site,
                                   const TorqueCoefficientTable& table,
                                   const DishDirection& pointing,
                                   const RecordTorqueOptions& options = {});

}  // namespace boresight::plant
