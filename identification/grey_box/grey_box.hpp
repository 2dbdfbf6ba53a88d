#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <boresight/identification/grey_box/grey_box_doubts.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/identification/grey_box/grey_box_whiteness.hpp>
#include <boresight/numerics/statistics/least_squares.hpp>

namespace boresight::identification {

struct GreyBoxOptions {
  /// Samples a second aimed at; 0: eight for every period of the structure's highest stated mode,
  /// at least 50.
  double sample_rate = 0.0;
  /// Starts beside that at the priors, drawn from them by the seed.
  int further_starts = 2;
  int draws = 2000;  // of the posterior, from 100
  std::uint64_t seed = 1;
  /// s of errors that are taken together as one observation of how far off the model may be.
  double stretch = 4.0;
  /// Whether the bulk modulus given is a guess (oil of an unknown kind) and not a measured or
  /// published number: then records may contradict it.
  bool bulk_modulus_guessed = false;
  GreyBoxDiscrepancy discrepancy;
  unsigned threads = 0;  // at a time; 0: as many as the machine has. Never changes the result.
  /// Told what is done, and how much of all; false stops with Interrupted.
  std::function<bool(const std::string& what, double share)> progress;
};

/// A number with its interval and what it was before the records spoke.
struct GreyBoxQuantity {
  std::string name;
  std::string unit;
  numerics::Interval posterior;
  numerics::Interval prior;
  /// Share of the prior's variance that the records took away.
  double learnt = 0.0;
  /// Whether the records say anything to speak of (half the variance): if not, the interval is that
  /// of drawings and data sheets, or of a wide guess where those say nothing. Offset and Coulomb
  /// level are not, however narrow, where the drive moves one way, the level not where the drive is
  /// too slow for friction to saturate.
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
  /// Between what fits the records and what is stated. Where it widens the posterior, quantities
  /// hold only if the stated number that it names is what is wrong.
  GreyBoxConflict conflict;
  GreyBoxMotion motion;
  std::vector<GreyBoxParameterResult> parameters;
  std::vector<GreyBoxQuantity> quantities;
  /// Of the quantities, by their order.
  Eigen::MatrixXd correlation;
  /// At the optimum; the draws are for a plant ensemble.
  DriveEstimate estimate;
  std::vector<DriveEstimate> draws;
  std::vector<GreyBoxResidual> residuals;
  std::vector<std::string> records;        // used, in the residuals' names
  std::vector<std::string> without_valve;  // of which only the mechanical half was used
  std::vector<std::string> left_out;       // without motor rate or pressures
  std::vector<GreyBoxStart> starts;        // the first is the one at the priors
  numerics::LeastSquaresStatus status = numerics::LeastSquaresStatus::iteration_limit;
  /// Directions in which the records say more than the priors, of how many; the condition of the
  /// records' Jacobian with priors, in units of the priors' spreads.
  Eigen::Index rank = 0;
  Eigen::Index varied = 0;
  double condition = 1.0;
  /// What the reader must know, in words with numbers.
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

/// Fits the nonlinear drive to all records of a campaign at once, and says how sure it is.
///
/// Each half is driven by what was measured at its port, so that no controller need be known: the
/// mechanical half (predict_rate) by the pressures' torque, the hydraulic half (predict_pressures)
/// by the motor rate and the valve's command, which is a rate command of unknown scale where the
/// rate loop is open and no valve command was recorded. Records in which nothing is known of the
/// valve serve the mechanical half alone. Parameters have priors of drawings, data sheets and
/// instruments; the bulk modulus that of `bulk_modulus`, from slosh frequencies, if given. Errors
/// of each record and half count in units of their own rms, found by turns with the optimum.
///
/// The posterior is not that of white errors: see grey_box_posterior. Inertia and offset "as
/// recorded" are what the transducers' errors leave of them, which no test can remove; the
/// inertia itself has those errors in its interval.
/// @throws InvalidInput as prepare_records and GreyBoxParameters, and for options out of range;
/// NumericalFailure if no start arrives; Interrupted as asked by `progress`.
GreyBoxResult fit_grey_box(const Campaign& campaign,
                           const std::optional<numerics::Interval>& bulk_modulus = {},
                           const GreyBoxOptions& options = {});

/// Steady friction torque (N m, true) at a motor rate (rad/s, not 0) with its interval, and whether
/// the records were at such rates is for the caller to know.
numerics::Interval friction_interval(const GreyBoxResult& result, double rate);

/// Another estimate of one of the quantities, held against the grey box's.
struct GreyBoxComparison {
  std::string name;
  numerics::Interval other;
  double relative = 0.0;  // other less grey box, over the grey box
  /// The difference over both standard uncertainties' root sum of squares: beyond 2 they
  /// contradict each other.
  double normalised = 0.0;
};

/// @throws InvalidInput as GreyBoxResult::quantity.
std::vector<GreyBoxComparison> compare_with(
    const GreyBoxResult& result, const std::string& quantity,
    const std::vector<std::pair<std::string, numerics::Interval>>& others);

}  // namespace boresight::identification
