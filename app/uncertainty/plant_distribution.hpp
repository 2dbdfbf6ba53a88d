#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/plant/antenna/antenna_change.hpp>

namespace boresight::app {

/// What is uncertain about a plant, in the order of PlantDraw::values.
enum class UncertainInput {
  structure_frequency,  // factor on the frequencies of locked rotor and modes
  oil_stiffness,        // factor
  leakage_rate,         // factor
  friction_slope,       // N m s/rad at the motor shaft
  antenna_inertia,      // factor
  motor_inertia,        // factor, flywheels included
  wind_torque,          // factor
};
inline constexpr std::size_t uncertain_inputs = 7;
/// "structure frequency" and so on.
std::string_view to_string(UncertainInput input);

/// One plant that may be the true one: factors on the numbers of a case, whatever a proposal makes
/// of them, and the slope of the friction.
struct PlantDraw {
  std::array<double, uncertain_inputs> values{1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0};

  double operator[](UncertainInput input) const {
    return values.at(static_cast<std::size_t>(input));
  }
};

std::vector<plant::AntennaChange> changes_of(const PlantDraw& draw);

/// How the plants that may be the true one are distributed.
class PlantDistribution {
 public:
  /// Independent, uniform over the case's ensemble ranges (tune/plant_members.hpp); the inertias
  /// lognormal with the case's own uncertainties, and the wind torque with those that the case
  /// states of torque coefficient and air density, none otherwise.
  static PlantDistribution of_ranges(const io::Case& antenna);
  /// Lognormal with mean and covariance of what the records leave open, about `identified` (the
  /// case at the estimate, identify/identified_case.hpp); the friction slope uniform from 0 to that
  /// at the tracking rate; the wind torque as in of_ranges. Draws that leave the antenna no inertia
  /// are passed over.
  /// @throws InvalidInput for fewer than 20 draws.
  static PlantDistribution of_records(const io::Case& identified,
                                      const std::vector<identification::DriveEstimate>& draws);

  /// Draw number `index` of a seed, whatever was drawn before.
  PlantDraw draw(std::uint64_t seed, std::uint64_t index) const;
  /// The draw whose inputs stand at these shares of their own distributions (0 to 1, both left
  /// out), as if they were independent. @throws InvalidInput for another number of shares, or one
  /// outside.
  PlantDraw at_shares(const std::vector<double>& shares) const;
  /// Every input at its median.
  PlantDraw median() const;
  /// Inputs that vary at all.
  const std::vector<UncertainInput>& inputs() const { return inputs_; }
  /// In words, for reports: where it comes from.
  const std::string& source() const { return source_; }

 private:
  // An input is uniform, or the exponential of a normal number.
  struct Marginal {
    bool uniform = true;
    double lower = 1.0, upper = 1.0;
    double centre = 0.0, deviation = 0.0;  // of the logarithm

    double at(double share) const;
  };
  void set_wind_torque(const io::Case& antenna);
  void list_inputs();

  std::array<Marginal, uncertain_inputs> marginals_;
  Eigen::MatrixXd factor_;  // lower triangular, of the covariance of the logarithms
  std::vector<UncertainInput> inputs_;
  std::string source_;
};

}  // namespace boresight::app
