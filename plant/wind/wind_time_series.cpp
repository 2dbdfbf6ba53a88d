#include <boresight/plant/wind/wind_time_series.hpp>

namespace boresight::plant {

StationarySeries gust_series(const WindSite& site, double mean_speed, double duration,
                             double sample_time, const StationarySeriesOptions& options) {
  validate(site, "gust_series");
  const GustSpectrum gusts = site_gusts(site);
  return {[&](double frequency) { return gust_spectrum(gusts, mean_speed, frequency); }, duration,
          sample_time, options};
}

StationarySeries wind_torque_series(const WindSite& site, WindModel model, WindTorquePart part,
                                    double mean_speed, double duration, double sample_time,
                                    const StationarySeriesOptions& options) {
  return {[&](double frequency) {
            return wind_torque_spectrum(site, model, mean_speed, frequency, part);
          },
          duration, sample_time, options};
}

WindTorqueParts synthesise_wind_torque(const WindSite& site, WindModel model, double mean_speed,
                                       double duration, double sample_time, std::uint64_t seed,
                                       const StationarySeriesOptions& options) {
  const auto draw = [&](WindTorquePart part, std::uint64_t stream) {
    return wind_torque_series(site, model, part, mean_speed, duration, sample_time, options)
        .draw(seed, stream);
  };
  WindTorqueParts parts;
  parts.uniform = draw(WindTorquePart::uniform, 0);
  parts.gradient = model == WindModel::coherence ? draw(WindTorquePart::gradient, 1)
                                                 : Eigen::VectorXd::Zero(parts.uniform.size());
  return parts;
}

}  // namespace boresight::plant
