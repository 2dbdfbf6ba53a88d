#pragma once

#include <string>
#include <vector>

#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/identification/grey_box/grey_box_record.hpp>
#include <boresight/identification/grey_box/stated_number_check.hpp>

namespace boresight::identification {

/// Whether what fits the records is what drawings, data sheets and instruments say.
struct GreyBoxConflict {
  /// Squares of the distances from the stated numbers, in units of their uncertainties: of all that
  /// drawings, data sheets and instruments state; how many; and the largest that so many have at
  /// random.
  double sum = 0.0;
  int count = 0;
  double limit = 0.0;
  std::string largest;  // the stated number that the records contradict most
  double departure = 0.0;
  /// Numbers of which one is contradicted by the records and all others: departing_numbers beyond
  /// StatedNumberCheck::contradicted_beyond.
  std::vector<StatedNumberCheck> contradicted;
  /// Factor of the posterior's variances: above 1 where records contradict the stated numbers that
  /// inertia and stiffness rest on significantly.
  double widening = 1.0;
  bool beyond_scatter() const { return sum > limit; }
};

/// Evaluates the conflict at the optimum. The scales of valve and supply, which enter neither
/// inertia nor stiffness, count in the sum but not in the widening. One contradicted number
/// widens by the square of its departure. The supply is among those that may be: it is the only
/// witness of a gain that all pressure transducers share.
GreyBoxConflict grey_box_conflict(const GreyBoxParameters& parameters, const Eigen::VectorXd& point,
                                  const std::vector<StatedNumberCheck>& checks);

/// Raises the posterior's variances by the conflict's widening; what nobody has stated at most to
/// the variance it had as a guess.
void widen(GreyBoxPosterior& posterior, const GreyBoxParameters& parameters,
           const GreyBoxConflict& conflict);

/// Which way, how long and how fast the drive moved where its rate counts.
struct GreyBoxMotion {
  double upward = 0.0;  // s at more than a twentieth of the largest rate
  double downward = 0.0;
  double highest_rate = 0.0;  // rad/s, of those that count
  /// Both ways for two seconds or more: else friction and offset are one number.
  bool both_ways() const;
};
GreyBoxMotion motion_of(const std::vector<GreyBoxRecord>& records);

/// Inflates the covariance of parameters that the motion cannot separate. These are offset and
/// Coulomb level if the drive moves one way. They are also friction's level and the rate at which
/// it saturates, if the drive never exceeds 2.5 such rates or its friction still rises by more than
/// the level.
void add_unidentifiable_directions(GreyBoxPosterior& posterior, const GreyBoxParameters& parameters,
                                   const GreyBoxMotion& motion);

/// Standard uncertainty (N m) of the offset beyond the posterior's covariance, from
///  - errors that last: wind that does not change within a record. Each record counts as one
///    observation, by what its prediction errors alone would move the offset (a sandwich, clustered
///    by records; K.-Y. Liang and S. L. Zeger, Biometrika 73(1), 1986);
///  - the torque balance's discrepancy of the records' rms torque: friction that is not alike both
///    ways, at a record's place and temperature, looks like an offset. Each record is one sample of
///    it, so that campaigns of few records are the less sure;
///  - pressures that stand for others whose zeros are not known, `unknown_torque` (N m).
double offset_discrepancy(const GreyBoxObjective& objective, const GreyBoxPosterior& posterior,
                          const std::vector<GreyBoxRecord>& records,
                          const GreyBoxParameters& parameters, double torque_balance,
                          double unknown_torque);

}  // namespace boresight::identification
