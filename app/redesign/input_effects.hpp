#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/control/controllers/control_law.hpp>
#include <boresight/design/problem/goals.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// What a tuned law's rms owes to one number of the case.
struct InputEffect {
  io::Quantity quantity;
  /// Which mode's share of wind or beam it is, by its frequency; empty for any other number.
  std::string mode = {};
  /// How far it is moved to either side, in its SI unit (Hz for frequencies): by the standard
  /// uncertainty that the case gives, else, where its value is assumed, by a tenth of it, else by
  /// the printed digits' rounding.
  double moved_by = 0.0;
  /// Whether that is a tenth or the range below, for want of an uncertainty.
  bool unstated = false;
  /// Of a share of wind or beam that is guessed so: the values it is moved to, the inertia fraction
  /// of its body (of the bull gear: what the modes leave) and as far to the other side, but not
  /// beyond 0 and 1 if it lies between; a tenth where the fraction is nearer than that. moved_by is
  /// then the larger of the two ways.
  std::optional<std::pair<double, double>> range = std::nullopt;
  /// Beam rms (rad, one axis at the sky, in the case's design wind) with the number lower and
  /// higher, gains held. NaN where the loop is unstable there.
  double low_rms = 0.0, high_rms = 0.0;

  /// The larger change from `rms` as a share of it; infinite where the loop is unstable.
  double change(double rms) const;
};

/// The numbers that linear plant and wind are made of, moved one at a time with all gains held: the
/// `most` that change the rms most, the largest first. Of shares that sum to 1 (wind, beam) the
/// others give way in proportion. Left out is what changes the rms by less than a thousandth, what
/// leaves no antenna, and what was identified from records: what those leave open is not the case's
/// uncertainty. The same for any number of threads.
std::vector<InputEffect> input_effects(const io::Case& antenna, const control::ControlLaw& law,
                                       const design::HardGoals& goals, double rms, std::size_t most,
                                       unsigned threads);

/// What friction alone adds to the simulated rms (rad), where that is a telling_change of `rms`,
/// the linear one; 0 elsewhere.
double telling_friction(const std::optional<TimeDomainSection>& time_domain, double rms);

/// Which of them to measure first, in a sentence; empty where none changes the rms by what decides
/// anything. And that friction is to be measured, with a telling_friction.
std::string measure_first(const std::vector<InputEffect>& effects, double rms,
                          const std::optional<TimeDomainSection>& time_domain = std::nullopt);

}  // namespace boresight::app
