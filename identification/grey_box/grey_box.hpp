#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_adequacy.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/identification/grey_box/grey_box_whiteness.hpp>
#include <boresight/identification/grey_box/record_influence.hpp>
#include <boresight/identification/grey_box/stated_number_check.hpp>
#include <boresight/numerics/statistics/least_squares.hpp>

namespace boresight::identification {

struct GreyBoxOptions {
  /// Target sample rate (1/s); 0: eight samples per period of the structure's highest stated mode,
  /// at least 50.
  double sample_rate = 0.0;
  /// Starts in addition to the one at the priors, sampled from the priors by the seed.
  int further_starts = 2;
  int random_samples = 2000;  // of the posterior, from 100
  std::uint64_t seed = 1;
  /// Length (s) of errors that count as one observation of the model's error.
  double stretch = 4.0;
  /// True if the given bulk modulus is a guess (unknown kind of oil), not a measured or published
  /// number. Records may then contradict it.
  bool bulk_modulus_guessed = false;
  GreyBoxDiscrepancy discrepancy;
  unsigned threads = 0;  // at a time; 0: as many as the machine has. Never changes the result.
  /// Called with the present step and the completed fraction; returns false to stop with
  /// Interrupted.
  std::function<bool(const std::string& what, double fraction)> progress;
};

/// A quantity with its interval before (prior) and after (posterior) the records.
struct GreyBoxQuantity {
  std::string name;
  std::string unit;
  numerics::Interval posterior;
  numerics::Interval prior;
  /// Fraction of the prior's variance removed by the records.
  double learnt = 0.0;
  /// True if the records remove at least half the variance. Otherwise the interval is that of
  /// drawings and data sheets, or of a wide guess without them. Always false for offset and Coulomb
  /// level if the drive moves one way, and for the level if the drive is too slow for friction to
  /// saturate.
  bool identified = false;
  bool prior_from_drawings = false;
};

/// A parameter at the optimum.
struct GreyBoxParameterResult {
  GreyBoxParameter parameter;
  double value = 0.0;
  /// Distance from the prior and standard uncertainty, both in units of the prior's spread.
  double departure = 0.0;
  double remaining = 0.0;
  bool identified = false;  // remaining below 0.7
};

/// One search for the optimum.
struct GreyBoxStart {
  double cost = 0.0;  // sum of squares with priors
  int iterations = 0;
  bool converged = false;
};

struct GreyBoxResult {
  /// Conflict between the records and the stated numbers. If it widens the posterior, the
  /// quantities are valid only if the stated number it names is the wrong one.
  GreyBoxConflict conflict;
  GreyBoxMotion motion;
  std::vector<GreyBoxParameterResult> parameters;
  /// Each stated number against all else. If one is in doubt (StatedNumberCheck::doubtful_beyond),
  /// random samples and intervals include what follows if it is wrong.
  std::vector<StatedNumberCheck> stated_numbers;
  std::vector<RecordInfluence> influences;  // of the used records, in their order
  std::vector<GreyBoxQuantity> quantities;
  /// Of the quantities, in their order.
  Eigen::MatrixXd correlation;
  /// At the optimum; the samples are for a plant ensemble.
  DriveEstimate estimate;
  std::vector<DriveEstimate> random_samples;
  std::vector<GreyBoxResidual> residuals;
  std::vector<std::string> records;        // used, in the residuals' names
  std::vector<std::string> without_valve;  // of which only the mechanical half was used
  std::vector<std::string> left_out;       // without motor rate or pressures
  std::vector<GreyBoxStart> starts;        // the first is the one at the priors
  numerics::LeastSquaresStatus status = numerics::LeastSquaresStatus::iteration_limit;
  /// Number of directions in which the records are more informative than the priors, and of all
  /// directions. Condition of the records' Jacobian with priors, in units of the priors' spreads.
  Eigen::Index rank = 0;
  Eigen::Index varied = 0;
  double condition = 1.0;
  /// Remarks for the reader, in words with numbers.
  std::vector<std::string> notes;
  /// For simulation and for the ranking of tests.
  std::vector<GreyBoxParameters> model;  // one
  GreyBoxPosterior posterior;
  double sample_time = 0.0;     // s, the most usual of the records'
  double rate_scale = 0.0;      // rad/s, median rms of the records' prediction errors
  double pressure_scale = 0.0;  // N m; 0 without valve commands

  /// @throws InvalidInput for a name that is not among the quantities.
  const GreyBoxQuantity& quantity(const std::string& name) const;
};

/// Fits the nonlinear drive to all records of a campaign together, with a posterior.
///
/// Each half is driven by the signals measured at its port, so no controller need be known. The
/// mechanical half (predict_rate) is driven by the pressures' torque; the hydraulic half
/// (predict_pressures) by motor rate and valve command. If the rate loop is open and no valve
/// command was recorded, the latter is a rate command of unknown scale. Records without any
/// information on the valve serve the mechanical half only. Parameters have priors from drawings,
/// data sheets and instruments. The bulk modulus has the prior `bulk_modulus`, from slosh
/// frequencies, if given. Errors of each record and half are weighted by their own rms, found
/// iteratively with the optimum.
///
/// The posterior does not assume white errors: see grey_box_posterior. Inertia and offset "as
/// recorded" include the transducers' errors, which no test can remove; the interval of the inertia
/// itself includes those errors.
/// @throws InvalidInput as prepare_records and GreyBoxParameters, and for options out of range;
/// NumericalFailure if no start converges; Interrupted as requested by `progress`.
GreyBoxResult fit_grey_box(const Campaign& campaign,
                           const std::optional<numerics::Interval>& bulk_modulus = {},
                           const GreyBoxOptions& options = {});

/// Steady friction torque (N m, true) at a motor rate (rad/s, not 0) with its interval. The caller
/// must check that the records cover such rates.
numerics::Interval friction_interval(const GreyBoxResult& result, double rate);

/// Another estimate of one of the quantities, compared with the grey box's.
struct GreyBoxComparison {
  std::string name;
  numerics::Interval other;
  double relative = 0.0;  // other less grey box, over the grey box
  /// Difference over the root sum of squares of both standard uncertainties; the two contradict
  /// each other beyond 2.
  double normalised = 0.0;
};

/// @throws InvalidInput as GreyBoxResult::quantity.
std::vector<GreyBoxComparison> compare_with(
    const GreyBoxResult& result, const std::string& quantity,
    const std::vector<std::pair<std::string, numerics::Interval>>& others);

}  // namespace boresight::identification
