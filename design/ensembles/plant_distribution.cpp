#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

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

// Streams of a seed: shares of uniform inputs, normal numbers of the others.
constexpr std::uint64_t uniform_stream = 0x5eed0001;
constexpr std::uint64_t normal_stream = 0x5eed0002;
constexpr std::uint64_t wind_stream = 0x5eed0003;

// Inputs of the first two streams. The wind's has its own, so that the others' numbers stay the
// same whether it varies or not.
constexpr std::size_t plant_inputs = place(UncertainInput::wind_torque);

// Logarithms of a draw's factors against the estimate's case, in the order of PlantDraw::values;
// the friction slope's stays 0. Nothing where it leaves the antenna no inertia.
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
  set(antenna_inertia, antenna, plant::antenna_inertia(identified));
  set(motor_inertia, draw.motor_inertia, plant::motor_inertia(identified));
  return logs;
}

}  // namespace

std::string_view to_string(UncertainInput input) {
  static constexpr std::array<std::string_view, uncertain_inputs> names{
      "structure frequency", "oil stiffness", "leakage rate", "friction slope",
      "antenna inertia",     "motor inertia", "wind torque"};
  return names.at(place(input));
}

std::vector<plant::AntennaChange> changes_of(const PlantDraw& draw) {
  using enum UncertainInput;
  return {plant::set_to("drive.viscous_friction", draw[friction_slope]),
          plant::scaled_by("at_shaft.antenna_inertia", draw[antenna_inertia]),
          plant::scaled_by("at_shaft.oil_stiffness", draw[oil_stiffness]),
          plant::scaled_by("drive.leakage_rate", draw[leakage_rate]),
          plant::scaled_by("at_shaft.motor_inertia", draw[motor_inertia]),
          plant::scaled_by("structure.frequencies", draw[structure_frequency]),
          plant::scaled_by("structure.wind_torque_factor", draw[wind_torque])};
}

double PlantDistribution::Marginal::at(double share) const {
  if (uniform) return lower + share * (upper - lower);
  return std::exp(centre - deviation * std::numbers::sqrt2 * boost::math::erfc_inv(2.0 * share));
}

void PlantDistribution::set_wind_torque(double deviation) {
  Marginal& marginal = marginals_.at(place(UncertainInput::wind_torque));
  marginal.uniform = false;
  marginal.deviation = deviation;
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
  const auto uniform_within = [&](UncertainInput input, double lower, double upper) {
    Marginal& marginal = distribution.marginals_.at(place(input));
    marginal.lower = lower;
    marginal.upper = upper;
  };
  uniform_within(structure_frequency, ranges.structure_frequency.lower,
                 ranges.structure_frequency.upper);
  uniform_within(oil_stiffness, ranges.oil_stiffness.lower, ranges.oil_stiffness.upper);
  if (leakage > 0.0) {
    uniform_within(leakage_rate, ranges.leakage_rate.lower / leakage,
                   ranges.leakage_rate.upper / leakage);
  }
  uniform_within(friction_slope, ranges.viscous_friction.lower, ranges.viscous_friction.upper);
  distribution.factor_ = Eigen::MatrixXd::Zero(plant_inputs, plant_inputs);
  for (const auto& [input, deviation] : {std::pair{antenna_inertia, uncertainty.antenna_inertia},
                                         std::pair{motor_inertia, uncertainty.motor_inertia}}) {
    Marginal& marginal = distribution.marginals_.at(place(input));
    marginal.uniform = false;
    marginal.deviation = deviation;
    const auto i = static_cast<Eigen::Index>(place(input));
    distribution.factor_(i, i) = marginal.deviation;
  }
  distribution.set_wind_torque(uncertainty.wind_torque);
  distribution.list_inputs();
  return distribution;
}

PlantDistribution PlantDistribution::of_records(
    const Mission& identified, const std::vector<identification::DriveEstimate>& draws) {
  constexpr Eigen::Index least = 20;
  Eigen::MatrixXd logs(static_cast<Eigen::Index>(draws.size()), plant_inputs);
  Eigen::Index kept = 0;
  for (const auto& draw : draws) {
    if (const auto row = log_factors(identified.antenna, draw)) logs.row(kept++) = row->transpose();
  }
  if (kept < least) {
    throw InvalidInput(fmt::format(
        "PlantDistribution: expected {} draws or more that leave the antenna an inertia, found {}",
        least, kept));
  }
  logs.conservativeResize(kept, Eigen::NoChange);
  const Eigen::RowVectorXd mean = logs.colwise().mean();
  const Eigen::MatrixXd centred = logs.rowwise() - mean;
  const Eigen::MatrixXd covariance = centred.transpose() * centred / static_cast<double>(kept - 1);
  PlantDistribution distribution;
  // Inputs that the records say nothing of have rows of zeros: a diagonal of rounding's size keeps
  // the factor defined and their draws where they are.
  const Eigen::MatrixXd lifted =
      covariance + 1e-24 * Eigen::MatrixXd::Identity(plant_inputs, plant_inputs);
  distribution.factor_ = lifted.llt().matrixL();
  for (std::size_t i = 0; i < plant_inputs; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    Marginal& marginal = distribution.marginals_.at(i);
    marginal.uniform = false;
    marginal.centre = mean(row);
    marginal.deviation = covariance(row, row) > 1e-20 ? std::sqrt(covariance(row, row)) : 0.0;
  }
  Marginal& friction = distribution.marginals_.at(place(UncertainInput::friction_slope));
  friction = {};
  friction.lower = 0.0;
  friction.upper = largest_viscous_friction(identified.antenna);
  distribution.source_ = EnsembleSource::records;
  distribution.set_wind_torque(identified.uncertainty.wind_torque);
  distribution.list_inputs();
  return distribution;
}

PlantDraw PlantDistribution::draw(std::uint64_t seed, std::uint64_t index) const {
  const numerics::NormalNumbers normals(seed, normal_stream);
  constexpr std::uint64_t pairs = (plant_inputs + 1) / 2;
  std::array<double, 2 * pairs> standard{};
  for (std::uint64_t k = 0; k < pairs; ++k) {
    const auto pair = normals.pair(index * pairs + k);
    standard.at(2 * k) = pair.real();
    standard.at(2 * k + 1) = pair.imag();
  }
  const std::uint64_t shares = numerics::splitmix64(seed, uniform_stream);
  PlantDraw draw;
  for (std::size_t i = 0; i < plant_inputs; ++i) {
    const Marginal& marginal = marginals_.at(i);
    if (marginal.uniform) {
      draw.values.at(i) = marginal.at(uniform(shares, index * plant_inputs + i));
      continue;
    }
    double sum = marginal.centre;
    for (std::size_t k = 0; k <= i; ++k) {
      sum += factor_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * standard.at(k);
    }
    draw.values.at(i) = std::exp(sum);
  }
  const Marginal& wind = marginals_.at(place(UncertainInput::wind_torque));
  const double of_wind = numerics::NormalNumbers(seed, wind_stream).pair(index).real();
  draw.values.at(place(UncertainInput::wind_torque)) = std::exp(wind.deviation * of_wind);
  return draw;
}

PlantDraw PlantDistribution::at_shares(const std::vector<double>& shares) const {
  if (shares.size() != inputs_.size()) {
    throw InvalidInput(fmt::format("PlantDistribution::at_shares: expected {} shares, found {}",
                                   inputs_.size(), shares.size()));
  }
  PlantDraw draw = median();
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (!(shares[k] > 0.0) || !(shares[k] < 1.0)) {
      throw InvalidInput(fmt::format(
          "PlantDistribution::at_shares: expected shares within (0, 1), found {:g}", shares[k]));
    }
    draw.values.at(place(inputs_[k])) = marginals_.at(place(inputs_[k])).at(shares[k]);
  }
  return draw;
}

PlantDraw PlantDistribution::median() const {
  PlantDraw draw;
  for (std::size_t i = 0; i < uncertain_inputs; ++i) {
    const Marginal& marginal = marginals_.at(i);
    draw.values.at(i) =
        marginal.uniform ? 0.5 * (marginal.lower + marginal.upper) : std::exp(marginal.centre);
  }
  return draw;
}

}  // namespace boresight::design
