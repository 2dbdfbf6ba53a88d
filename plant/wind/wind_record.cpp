#include <cmath>

#include <fmt/format.h>

#include <boresight/numerics/error.hpp>
#include <boresight/numerics/fourier_transform.hpp>
#include <boresight/plant/wind/wind_record.hpp>

namespace boresight::plant {
namespace {

constexpr Eigen::Index max_samples = Eigen::Index{1} << 26;

// Torques about their mean, smoothed over the dish.
Eigen::VectorXd smooth(const Eigen::VectorXd& torque, double sample_time, double mean_speed,
                       const WindSite& site, WindModel model) {
  const Eigen::Index samples = torque.size();
  const Eigen::Index length = numerics::fast_transform_length(2 * samples);
  Eigen::VectorXd mirrored(length);
  mirrored.head(samples) = torque;
  // Half of the rest goes on from the end, half leads to the start, both backwards in time. The
  // length is below three times the record.
  const Eigen::Index rest = length - samples;
  const Eigen::Index after = rest / 2;
  for (Eigen::Index i = 0; i < after; ++i) {
    mirrored[samples + i] = torque[samples - 1 - i];
  }
  for (Eigen::Index i = 0; i < rest - after; ++i) {
    mirrored[length - 1 - i] = torque[i];
  }
  Eigen::VectorXcd transform = numerics::fourier_transform(mirrored);
  const double step = 1.0 / (static_cast<double>(length) * sample_time);
  for (Eigen::Index k = 0; k < transform.size(); ++k) {
    transform[k] *= wind_admittance(site, model, mean_speed, static_cast<double>(k) * step);
  }
  return numerics::inverse_fourier_transform(transform, length).head(samples);
}

// The quasi-static torque as the dish takes it, with or without its mean.
Eigen::VectorXd torque_series(const WindRecord& record, const WindSite& site,
                              const Eigen::VectorXd& quasi_static,
                              const RecordTorqueOptions& options) {
  const double mean = quasi_static.mean();
  const Eigen::VectorXd about_mean = quasi_static.array() - mean;
  Eigen::VectorXd torque =
      options.model == WindModel::uniform
          ? about_mean
          : smooth(about_mean, record.sample_time, record.speed.mean(), site, options.model);
  // Mirrored ends have slightly more weight in the smoothed series than in the record.
  torque.array() += (options.remove_mean ? 0.0 : mean) - torque.mean();
  return torque;
}

}  // namespace

void validate(const WindRecord& record, std::string_view function) {
  if (!(record.sample_time > 0.0) || !std::isfinite(record.sample_time)) {
    throw InvalidInput(fmt::format("{}: expected a sample_time above 0, found {} s", function,
                                   record.sample_time));
  }
  const Eigen::Index samples = record.speed.size();
  if (samples < 2 || samples > max_samples) {
    throw InvalidInput(
        fmt::format("{}: expected a record of 2 to 2^26 samples, found {}", function, samples));
  }
  for (Eigen::Index i = 0; i < samples; ++i) {
    if (record.speed[i] >= 0.0 && std::isfinite(record.speed[i])) continue;
    throw InvalidInput(fmt::format("{}: expected speeds of at least 0, found {} m/s at sample {}",
                                   function, record.speed[i], i));
  }
  if (!(record.speed.maxCoeff() > 0.0)) {
    throw InvalidInput(fmt::format("{}: expected a wind, found speeds that are all 0", function));
  }
  if (record.direction.size() != 0 && record.direction.size() != samples) {
    throw InvalidInput(fmt::format("{}: expected {} directions or none, found {}", function,
                                   samples, record.direction.size()));
  }
  if (!record.direction.allFinite()) {
    throw InvalidInput(fmt::format("{}: expected finite directions", function));
  }
}

Eigen::VectorXd wind_record_torque(const WindRecord& record, const WindSite& site,
                                   const RecordTorqueOptions& options) {
  validate(record, "wind_record_torque");
  const Eigen::VectorXd quasi_static = mean_wind_torque(site, 1.0) * record.speed.array().square();
  return torque_series(record, site, quasi_static, options);
}

Eigen::VectorXd wind_record_torque(const WindRecord& record, const WindSite& site,
                                   const TorqueCoefficientTable& table,
                                   const DishDirection& pointing,
                                   const RecordTorqueOptions& options) {
  validate(record, "wind_record_torque");
  if (record.direction.size() == 0) {
    throw InvalidInput("wind_record_torque: expected a record with directions, found none");
  }
  WindSite unit = site;
  unit.torque_coefficient = 1.0;
  Eigen::VectorXd quasi_static = mean_wind_torque(unit, 1.0) * record.speed.array().square();
  for (Eigen::Index i = 0; i < quasi_static.size(); ++i) {
    quasi_static[i] *= table.at(record.direction[i] - pointing.azimuth, pointing.elevation);
  }
  return torque_series(record, site, quasi_static, options);
}

}  // namespace boresight::plant
