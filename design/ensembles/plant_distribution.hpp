#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/design/ensembles/plant_members.hpp>
#include <boresight/identification/grey_box/identified_antenna.hpp>

namespace boresight::design {

/// The uncertain inputs of a plant, in the order of PlantSample::values.
enum class UncertainInput {
  structure_frequency,  // factor on the frequencies of locked rotor and modes
  oil_stiffness,        // factor
  leakage_rate,         // factor
  friction_slope,       // N m s/rad at the motor shaft
  antenna_inertia,      // factor
  motor_inertia,        // factor, flywheels included
  wind_torque,          // factor
  valve_frequency,      // factor
};
inline constexpr std::size_t uncertain_inputs = 8;
/// "structure frequency" and so on.
std::string_view to_string(UncertainInput input);

/// One sample of the plant: factors on the numbers of an antenna (after any proposal changes them),
/// and the friction slope.
struct PlantSample {
  std::array<double, uncertain_inputs> values{1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0};

  double operator[](UncertainInput input) const {
    return values.at(static_cast<std::size_t>(input));
  }
};

std::vector<plant::AntennaChange> changes_of(const PlantSample& draw);

/// The distribution of the plant, given the available data.
class PlantDistribution {
 public:
  /// Independent inputs: uniform over AntennaUncertainty::ranges; inertias and wind torque
  /// lognormal with the mission's uncertainties.
  static PlantDistribution of_ranges(const Mission& mission);
  /// Lognormal with the mean and covariance that remain after identification from records, about
  /// `identified` (the mission at the estimate). If `parts` has no leakage rate, it is as in
  /// of_ranges. If `parts` has no friction slope, it is uniform from 0 to largest_viscous_friction.
  /// If `parts` has the valve's lag, the valve's frequency is lognormal, independent of the rest.
  /// The wind torque is as in of_ranges. Samples without a positive antenna inertia are skipped.
  /// @throws InvalidInput for fewer than 20 samples.
  static PlantDistribution of_records(
      const Mission& identified, const std::vector<identification::DriveEstimate>& random_samples,
      const identification::IdentifiedParts& parts = {});

  /// Sample number `index` of a seed, independent of earlier calls.
  PlantSample draw(std::uint64_t seed, std::uint64_t index) const;
  /// The sample with each input at this quantile (0 to 1, both excluded) of its own distribution,
  /// as if the inputs were independent. @throws InvalidInput for another number of quantiles, or
  /// one outside this range.
  PlantSample at_fractions(const std::vector<double>& fractions) const;
  /// Every input at its median.
  PlantSample median() const;
  /// Inputs that vary.
  const std::vector<UncertainInput>& inputs() const { return inputs_; }
  EnsembleSource source() const { return source_; }
  /// True if the input varies.
  bool varies(UncertainInput input) const;

 private:
  // An input is uniform, or the exponential of a normal number.
  struct Marginal {
    bool uniform = true;
    double lower = 1.0, upper = 1.0;
    double centre = 0.0, deviation = 0.0;  // of the logarithm

    double at(double fraction) const;
  };
  void set_lognormal(UncertainInput input, double centre, double deviation);
  void set_ranges(UncertainInput input, double lower, double upper);
  void list_inputs();

  std::array<Marginal, uncertain_inputs> marginals_;
  Eigen::MatrixXd factor_;  // lower triangular, of the covariance of the logarithms
  std::vector<UncertainInput> inputs_;
  EnsembleSource source_ = EnsembleSource::ranges;
};

}  // namespace boresight::design
