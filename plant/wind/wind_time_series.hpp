#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <boresight/plant/wind/stationary_series.hpp>
#include <boresight/plant/wind/wind.hpp>

namespace boresight::plant {

/// The speed of the gusts at one point about the mean speed (m/s), by the spectrum of the site, for
/// any number of seeds. V in m/s, duration and sample time in s.
/// @throws InvalidInput as gust_spectrum and StationarySeries.
StationarySeries gust_series(const WindSite& site, double mean_speed, double duration,
                             double sample_time, const StationarySeriesOptions& options = {});

/// The wind torque about its mean (N m), by wind_torque_spectrum, for any number of seeds.
/// @throws InvalidInput as wind_torque_spectrum and StationarySeries.
StationarySeries wind_torque_series(const WindSite& site, WindModel model, WindTorquePart part,
                                    double mean_speed, double duration, double sample_time,
                                    const StationarySeriesOptions& options = {});

/// One sample of the two independent parts of the wind torque about its mean (N m); their sum is
/// the torque. The gradient part of the uniform and Vickery models is 0.
struct WindTorqueParts {
  Eigen::VectorXd uniform;
  Eigen::VectorXd gradient;
};

/// The uniform part from stream 0 of the seed, which gust_series also uses, and the gradient part
/// from stream 1. In the uniform model the torque is wind_torque_sensitivity times the gust of the
/// same seed.
/// @throws InvalidInput as wind_torque_series.
WindTorqueParts synthesise_wind_torque(const WindSite& site, WindModel model, double mean_speed,
                                       double duration, double sample_time, std::uint64_t seed,
                                       const StationarySeriesOptions& options = {});

}  // namespace boresight::plant
