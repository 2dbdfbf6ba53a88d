#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/design/studies/controller_study.hpp>
#include <boresight/io/case/present_gains.hpp>
#include <boresight/plant/wind/wind_mast.hpp>

namespace boresight::app {

using design::ControllerInTime;
using design::TunedController;
using design::TunedFor;

/// What cannot be reached, and what comes closest.
struct Shortfall {
  std::string infeasible;
  std::string closest;
};

/// Results of `boresight tune`, and the parts of the case's text that its report needs.
struct TuneSection : design::TuningStudy {
  io::GainUnits gain_units;
  std::optional<plant::WindMast> wind_mast;  // none: the case states speeds at the dish's centre
  /// What goals on the valve's demand in gusts rest on where no number of it is stated.
  std::string demand_assumption;
  std::vector<Shortfall> shortfalls;
  /// Of shown_controller on the ensemble.
  std::optional<design::EnsembleCurves> curves;

  /// The gains of a row in the structure's order, in the engineer's units; none of an unstable one.
  std::vector<std::string> gains_of(const TunedController& row) const {
    if (!row.stable()) return {};
    return gain_units.texts(row.design.tuning.controller);
  }
  /// "PI, robust, 10 m/s" of each tuning that an interrupt left out.
  std::vector<std::string> not_run_texts() const;
};

/// With the shortfalls that find_shortfalls makes of it.
TuneSection section_of(const io::Case& antenna, design::TuningStudy study);

}  // namespace boresight::app
