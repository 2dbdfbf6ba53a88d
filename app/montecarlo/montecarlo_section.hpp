#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boresight/app/figures/figure.hpp>
#include <boresight/design/studies/monte_carlo_summary.hpp>
#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/case/pointing_axis.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::app {

using design::NotablePlant;

/// Results of `boresight montecarlo`, and the parts of the case's text that its report needs.
struct MonteCarloSection : design::MonteCarloSummary {
  std::string case_path, title;
  io::PointingAxis axis;
  std::uint64_t seed = 1;

  std::string distribution;  // what the plants are drawn from
  control::Controller controller;
  std::string structure;           // as the user names it
  std::string controller_source;   // where the gains come from
  std::vector<std::string> gains;  // in the engineer's units
  plant::WindModel wind_model = plant::WindModel::coherence;
  double wind_speed = 0.0;  // m/s

  std::vector<io::Quantity> assumed;
  std::vector<std::string> conclusions;
  std::vector<Figure> figures;
};

/// Basis of the budget verdicts: "linear", or the simulated equivalent of each linear rms.
std::string evaluated_by(const design::NonlinearEffect& effect);

}  // namespace boresight::app
