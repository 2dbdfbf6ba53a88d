#pragma once

#include <string>
#include <vector>

#include <boresight/identification/grey_box/grey_box_objective.hpp>
#include <boresight/identification/grey_box/grey_box_posterior.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// What the fit of all records rests on in one record.
struct RecordInfluence {
  std::string record;
  numerics::Interval inertia;  // kg m2, without the record
  double change = 0.0;         // relative, of the inertia by the record
  /// Fraction of the information about the inertia as recorded that is the record's alone: 1 less
  /// the variance with it over that without. The instruments' scales, which no record tells, are
  /// not in it.
  double information = 0.0;
};

/// Of each record of the objective, at its optimum: the first step of a fit without the record
/// (normal equations less the record's part), which is exact for a linear model and says how a fit
/// would move where it is not. Variances have the posterior's inflation along the inertia and its
/// torque discrepancy.
/// Source: R. D. Cook and S. Weisberg, Residuals and Influence in Regression, 1982, chapter 3.
std::vector<RecordInfluence> record_influences(const GreyBoxObjective& objective,
                                               const std::vector<GreyBoxRecord>& records,
                                               const GreyBoxParameters& parameters,
                                               const GreyBoxPosterior& posterior);

}  // namespace boresight::identification
