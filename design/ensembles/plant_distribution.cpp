#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <boost/math/special_functions/erf.hpp>
#include <fmt/format.h>

#include <boresight/design/ensembles/plant_distribution.hpp>
#include <boresight/numerics/error.hpp>
#include <boresight/numerics/normal_numbers.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>
#include <boresight/plant/nonlinear/drive_capability.hpp>

namespace boresight::design {
namespace {

constexpr std::size_t place(UncertainInput input) {
  return static_cast<std::size_t>(input);
}

// Uniform within (0, 1), both ends left out.
double uniform(std::uint64_t state, std::uint64_t index) {
  constexpr double unit = 0x1p-53;
  return (static_cast<double>(numerics::splitmix64(state, index) >> 12U) + 0.5) * 2.0 * unit;
}

// Streams of a seed: fractions of uniform inputs, normal numbers of the others.
constexpr std::uint64_t uniform_stream = 0x5eed0001;
constexpr std::uint64_t normal_stream = 0x5eed0002;
constexpr std::uint64_t wind_stream = 0x5eed0003;
constexpr std::uint64_t valve_stream = 0x5eed0004;

// Inputs of the first two streams. Those of wind and valve have their own, so that the others'
// numbers stay the same whether they vary or not.
constexpr std::size_t plant_inputs = place(UncertainInput::wind_torque);

// Logarithms of a sample's factors against the estimate's case, in the order of
// PlantSample::values. Nothing where it leaves the antenna no inertia.
std::optional<Eigen::VectorXd> log_factors(const plant::Antenna& identified,
                                           const identification::DriveEstimate& draw) {
  const double antenna = draw.inertia - draw.motor_inertia - plant::gear_train_inertia(identified);
  if (!(antenna > 0.0)) return std::nullopt;
  using enum UncertainInput;
  Eigen::VectorXd logs = Eigen::VectorXd::Zero(plant_inputs);
  const auto set = [&](UncertainInput input, double value, double at_estimate) {
    if (value > 0.0 && at_estimate > 0.0) {
      logs(static_cast<Eigen::Index>(place(input))) = std::log(value / at_estimate);
    }
  };
  set(structure_frequency, draw.lowest_frequency, identified.structure.locked_rotor_frequency);
  set(oil_stiffness, draw.oil_stiffness, plant::oil_stiffness(identified));
  set(leakage_rate, draw.leakage_rate, identified.drive.leakage_rate);
  set(friction_slope, draw.tracking_slope, identified.drive.viscous_friction);
  set(antenna_inertia, antenna, plant::antenna_inertia(identified));
  set(motor_inertia, draw.motor_inertia, plant::motor_inertia(identified));
  return logs;
}

// Standard deviation of the logarithm of the samples' valve lags.
double valve_deviation(const std::vector<identification::DriveEstimate>& random_samples) {
  std::vector<double> logs;
  for (const auto& draw : random_samples) {
    if (draw.valve_lag > 0.0) logs.push_back(std::log(draw.valve_lag));
  }
  if (logs.size() < 2) return 0.0;
  const auto all = Eigen::Map<const Eigen::ArrayXd>(logs.data(), std::ssize(logs));
  return std::sqrt((all - all.mean()).square().sum() / static_cast<double>(logs.size() - 1));
}

}  // namespace

std::string_view to_string(UncertainInput input) {
  static constexpr std::array<std::string_view, uncertain_inputs> names{
      "structure frequency", "oil stiffness", "leakage rate", "friction slope",
      "antenna inertia",     "motor inertia", "wind torque",  "valve frequency"};
  return names.at(place(input));
}

std::vector<plant::AntennaChange> changes_of(const PlantSample& draw) {
  using enum UncertainInput;
  return {plant::set_to("drive.viscous_friction", draw[friction_slope]),
          plant::scaled_by("at_shaft.antenna_inertia", draw[antenna_inertia]),
          plant::scaled_by("at_shaft.oil_stiffness", draw[oil_stiffness]),
          plant::scaled_by("drive.leakage_rate", draw[leakage_rate]),
          plant::scaled_by("at_shaft.motor_inertia", draw[motor_inertia]),
          plant::scaled_by("structure.frequencies", draw[structure_frequency]),
          plant::scaled_by("structure.wind_torque_factor", draw[wind_torque]),
          plant::scaled_by("drive.valve_frequency", draw[valve_frequency])};
}

double PlantDistribution::Marginal::at(double fraction) const {
  if (uniform) return lower + fraction * (upper - lower);
  return std::exp(centre - deviation * std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * fraction));
}

void PlantDistribution::set_lognormal(UncertainInput input, double centre, double deviation) {
  Marginal& marginal = marginals_.at(place(input));
  marginal.uniform = false;
  marginal.centre = centre;
  marginal.deviation = deviation;
}

void PlantDistribution::set_ranges(UncertainInput input, double lower, double upper) {
  Marginal& marginal = marginals_.at(place(input));
  marginal = {};
  marginal.lower = lower;
  marginal.upper = upper;
}

bool PlantDistribution::varies(UncertainInput input) const {
  return std::ranges::find(inputs_, input) != inputs_.end();
}

void PlantDistribution::list_inputs() {
  for (std::size_t i = 0; i < uncertain_inputs; ++i) {
    const Marginal& marginal = marginals_.at(i);
    const bool varies =
        marginal.uniform ? marginal.upper > marginal.lower : marginal.deviation > 0.0;
    if (varies) inputs_.push_back(static_cast<UncertainInput>(i));
  }
}

PlantDistribution PlantDistribution::of_ranges(const Mission& mission) {
  const AntennaUncertainty& uncertainty = mission.uncertainty;
  const MemberRanges& ranges = uncertainty.ranges;
  const double leakage = mission.antenna.drive.leakage_rate;
  PlantDistribution distribution;
  using enum UncertainInput;
  distribution.set_ranges(structure_frequency, ranges.structure_frequency.lower,
                          ranges.structure_frequency.upper);
  distribution.set_ranges(oil_stiffness, ranges.oil_stiffness.lower, ranges.oil_stiffness.upper);
  if (leakage > 0.0) {
    distribution.set_ranges(leakage_rate, ranges.leakage_rate.lower / leakage,
                            ranges.leakage_rate.upper / leakage);
  }
  distribution.set_ranges(friction_slope, ranges.viscous_friction.lower,
                          ranges.viscous_friction.upper);
  distribution.factor_ = Eigen::MatrixXd::Zero(plant_inputs, plant_inputs);
  for (const auto& [input, deviation] : {std::pair{antenna_inertia, uncertainty.antenna_inertia},
                                         std::pair{motor_inertia, uncertainty.motor_inertia}}) {
    distribution.set_lognormal(input, 0.0, deviation);
    const auto i = static_cast<Eigen::Index>(place(input));
    distribution.factor_(i, i) = deviation;
  }
  distribution.set_lognormal(wind_torque, 0.0, uncertainty.wind_torque);
  distribution.list_inputs();
  return distribution;
}

PlantDistribution PlantDistribution::of_records(
    const Mission& identified, const std::vector<identification::DriveEstimate>& random_samples,
    const identification::IdentifiedParts& parts) {
  constexpr Eigen::Index minimum = 20;
  Eigen::MatrixXd logs(static_cast<Eigen::Index>(random_samples.size()), plant_inputs);
  Eigen::Index kept = 0;
  for (const auto& draw : random_samples) {
    if (const auto row = log_factors(identified.antenna, draw)) logs.row(kept++) = row->transpose();
  }
  if (kept < minimum) {
    throw InvalidInput(
        fmt::format("PlantDistribution: expected {} samples or more that leave the antenna an "
                    "inertia, found {}",
                    minimum, kept));
  }
  logs.conservativeResize(kept, Eigen::NoChange);
  const Eigen::RowVectorXd mean = logs.colwise().mean();
  const Eigen::MatrixXd centred = logs.rowwise() - mean;
  const Eigen::MatrixXd covariance = centred.transpose() * centred / static_cast<double>(kept - 1);
  PlantDistribution distribution;
  // Inputs that the records do not determine have rows of zeros. A diagonal of the size of rounding
  // keeps the factor defined and leaves their samples unchanged.
  const Eigen::MatrixXd lifted =
      covariance + 1e-24 * Eigen::MatrixXd::Identity(plant_inputs, plant_inputs);
  distribution.factor_ = lifted.llt().matrixL();
  for (std::size_t i = 0; i < plant_inputs; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    distribution.set_lognormal(
        static_cast<UncertainInput>(i), mean(row),
        covariance(row, row) > 1e-20 ? std::sqrt(covariance(row, row)) : 0.0);
  }
  using enum UncertainInput;
  const plant::DriveRatings& drive = identified.antenna.drive;
  if (parts.friction_slope && drive.viscous_friction > 0.0) {
    distribution.marginals_.at(place(friction_slope)).centre += std::log(drive.viscous_friction);
  } else {
    distribution.set_ranges(friction_slope, 0.0, largest_viscous_friction(identified.antenna));
  }
  if (!parts.leakage_rate && drive.leakage_rate > 0.0) {
    const Ends& range = identified.uncertainty.ranges.leakage_rate;
    distribution.set_ranges(leakage_rate, range.lower / drive.leakage_rate,
                            range.upper / drive.leakage_rate);
  }
  if (parts.valve_lag)
    distribution.set_lognormal(valve_frequency, 0.0, valve_deviation(random_samples));
  distribution.source_ = EnsembleSource::records;
  distribution.set_lognormal(wind_torque, 0.0, identified.uncertainty.wind_torque);
  distribution.list_inputs();
  return distribution;
}

PlantSample PlantDistribution::draw(std::uint64_t seed, std::uint64_t index) const {
  const numerics::NormalNumbers normals(seed, normal_stream);
  constexpr std::uint64_t pairs = (plant_inputs + 1) / 2;
  std::array<double, 2 * pairs> standard{};
  for (std::uint64_t k = 0; k < pairs; ++k) {
    const auto pair = normals.pair(index * pairs + k);
    standard.at(2 * k) = pair.real();
    standard.at(2 * k + 1) = pair.imag();
  }
  const std::uint64_t fractions = numerics::splitmix64(seed, uniform_stream);
  PlantSample draw;
  for (std::size_t i = 0; i < plant_inputs; ++i) {
    const Marginal& marginal = marginals_.at(i);
    if (marginal.uniform) {
      draw.values.at(i) = marginal.at(uniform(fractions, index * plant_inputs + i));
      continue;
    }
    double sum = marginal.centre;
    for (std::size_t k = 0; k <= i; ++k) {
      sum += factor_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * standard.at(k);
    }
    draw.values.at(i) = std::exp(sum);
  }
  for (const auto& [input, stream] : {std::pair{UncertainInput::wind_torque, wind_stream},
                                      std::pair{UncertainInput::valve_frequency, valve_stream}}) {
    const Marginal& marginal = marginals_.at(place(input));
    const double normal = numerics::NormalNumbers(seed, stream).pair(index).real();
    draw.values.at(place(input)) = std::exp(marginal.deviation * normal);
  }
  return draw;
}

PlantSample PlantDistribution::at_fractions(const std::vector<double>& fractions) const {
  if (fractions.size() != inputs_.size()) {
    throw InvalidInput(
        fmt::format("PlantDistribution::at_fractions: expected {} fractions, found {}",
                    inputs_.size(), fractions.size()));
  }
  PlantSample draw = median();
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    if (!(fractions[k] > 0.0) || !(fractions[k] < 1.0)) {
      throw InvalidInput(fmt::format(
          "PlantDistribution::at_fractions: expected fractions within (0, 1), found {:g}",
          fractions[k]));
    }
    draw.values.at(place(inputs_[k])) = marginals_.at(place(inputs_[k])).at(fractions[k]);
  }
  return draw;
}

PlantSample PlantDistribution::median() const {
  PlantSample draw;
  for (std::size_t i = 0; i < uncertain_inputs; ++i) {
    const Marginal& marginal = marginals_.at(i);
    draw.values.at(i) =
        marginal.uniform ? 0.5 * (marginal.lower + marginal.upper) : std::exp(marginal.centre);
  }
  return draw;
}

}  // namespace boresight::design
