#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/design/studies/proposal_study.hpp>
#include <boresight/io/proposals/change_rows.hpp>
#include <boresight/plant/wind/wind_mast.hpp>

namespace boresight::app {

using design::CandidateController;
using design::CandidateFigures;
using design::CandidateSamples;
using design::PairByStructure;
using design::SameStructure;
using design::SlewFigures;

/// The present antenna, or the antenna with a proposal applied, and the data of the proposal's
/// file.
struct Candidate : design::ProposedDesign {
  std::string path;  // of the proposal; empty for the antenna as it is
  std::string description;
  double cost_uncertainty = 0.0;
  bool cost_assumed = false;
  std::vector<std::string> risks;
  std::vector<io::ChangeRow> changes;
  std::vector<io::DerivedChange> derived_quantities;
  /// Gains of each controller in the engineer's units; empty for an unstable one.
  std::vector<std::vector<std::string>> gains;
};

/// A decision with the description of its basis.
struct DecisionSection : design::ProposalDecision {
  std::string source;               // of the samples
  std::vector<std::string> inputs;  // `uncertain`
  std::vector<std::string> notes;   // what is missing, and why
};

/// What `boresight evaluate` found.
struct EvaluateSection {
  double wind_speed = 0.0;  // m/s
  plant::WindModel wind_model = plant::WindModel::coherence;
  std::optional<plant::WindMast> wind_mast;  // none: the case states speeds at the dish's centre
  bool climate = false;                      // the case has one
  bool minimises_climate = false;
  std::string currency;  // empty: no proposal states a cost
  std::string ensemble_source;
  std::size_t ensemble_size = 0;
  int starts = 0;
  std::vector<design::PointingBand> bands;
  std::vector<design::PointingBudget> budgets;
  /// Options of the controllers' runs on the nonlinear antenna; none without such runs.
  std::optional<design::NonlinearVerificationOptions> time_domain;
  std::vector<Candidate> candidates;  // the antenna as it is first
  /// Candidates on the Pareto front of cost and compared_rms, as indices into `candidates`, by
  /// increasing cost. Empty if no proposal states a cost.
  std::vector<std::size_t> front;
  std::optional<DecisionSection> decision;
  std::vector<std::string> not_run;  // what an interrupt left out
};

/// "on average", "at the 95 % quantile", "at the median": behind an rms or a change of it.
std::string_view measure_phrase(design::LossMeasure measure);

/// A few paragraphs that say what the section means, with its conditions.
std::vector<std::string> conclude(const EvaluateSection& section);

}  // namespace boresight::app
