#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_parameters.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// A number that drawings, data sheets or instruments state, against what the records and all other
/// stated numbers say of it.
struct StatedNumberCheck {
  /// Departures from here on are no scatter: once in two thousand numbers.
  static constexpr double contradicted_beyond = 3.5;
  /// From here on the number may be wrong, and intervals include that it is.
  static constexpr double doubtful_beyond = 2.5;

  std::string name;
  double stated_uncertainty = 0.0;  // standard, relative, as the fit has it
  /// By the records and all other stated numbers: a factor of the stated number.
  numerics::Interval by_others;
  /// Logarithm of that factor over its standard uncertainty and the stated one together: standard
  /// normal if all that is stated is right.
  double departure = 0.0;
  /// Smallest relative error of the stated number with an expected departure of
  /// contradicted_beyond: what the records can show.
  double visible_error = 0.0;
  double inertia_effect = 0.0;  // relative change of the inertia per relative change of the number
  numerics::Interval inertia;   // kg m2, without the stated number
  /// Without the number the inertia is another, by its standard uncertainty or more. Also of the
  /// supply pressure, whose departure is that of a gain that all pressure transducers share. Never
  /// of the structure's frequencies, whose modes the model may lack.
  bool moves_inertia = false;
  Eigen::VectorXd direction;  // along which the number varies, a unit vector of the fit's points
};

/// Checks every stated number of the fit that has an uncertainty, and the displacement, which
/// enters torque and flow alike; of the gains of inlets against outlets their ratio. Its
/// `posterior` is that of grey_box_posterior.
///
/// The fit's own value of a number is no check of it: where the records say nothing of a scale, the
/// fit returns what was stated. So one prior at a time is taken out of the posterior
/// (leave-one-prior-out, exact for a linear model) with what covariance and misfit have of it, and
/// the stated number is compared with what is left (prior-data conflict: M. Evans, H. Moshonov,
/// Bayesian Analysis 1(4), 2006). Several numbers may depart alike: a wrong one makes those wrong
/// that it stands against.
std::vector<StatedNumberCheck> check_stated_numbers(const GreyBoxParameters& parameters,
                                                    const GreyBoxPosterior& posterior);

/// The posterior without a stated number, `direction` as of its check. The leakage, offset and
/// other discrepancies stay.
GreyBoxPosterior without_stated_number(const GreyBoxPosterior& posterior,
                                       const Eigen::VectorXd& direction);

enum class StatedNumbers { that_move_inertia, all };
/// Of some numbers the one that departs most, by at least `beyond`, and after it those that depart
/// by at most 0.5 less, in order: each would explain the records nearly as well if it alone were
/// wrong. Not those that would have to be wrong more than tenfold, unless all would. None if none
/// departs so far.
std::vector<StatedNumberCheck> departing_numbers(
    const std::vector<StatedNumberCheck>& checks, double beyond,
    StatedNumbers which = StatedNumbers::that_move_inertia);

/// Probability that each number that moves the inertia is the one that is grossly wrong (of the
/// others: 0), if one of fifty is before the records and its error has ten times the stated
/// uncertainty. That none is wrong has what they leave of 1.
/// Source: G. E. P. Box, G. C. Tiao, Biometrika 55(1), 1968.
std::vector<double> gross_error_probabilities(const std::vector<StatedNumberCheck>& checks);

/// Samples as posterior_samples of the mixture of what follows if each of the numbers is grossly
/// wrong and if none is, by gross_error_probabilities.
std::vector<DriveEstimate> samples_in_doubt(const GreyBoxParameters& parameters,
                                            const GreyBoxPosterior& posterior,
                                            const std::vector<StatedNumberCheck>& checks, int count,
                                            std::uint64_t seed);

}  // namespace boresight::identification
