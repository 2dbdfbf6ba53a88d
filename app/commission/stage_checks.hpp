#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/design/commissioning/stage_quantities.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::design {
struct Mission;
}

namespace boresight::app {

/// Units that the antenna's computer and its operators read: those of [computer] and [tachometer]
/// of the case. Without [simulation], which states the valve's stroke, rad/s of motor.
struct PlantUnits {
  double valve = 1.0, tachometer = 1.0;  // unit per rad/s of motor
  std::string valve_unit = "rad/s", tachometer_unit = "rad/s";
  double gear_ratio = 1.0;
  /// The valve's unit is a default: percent of the stroke, as the case states no signal.
  bool valve_by_default = false;
};
PlantUnits plant_units(const io::Case& antenna, const design::Mission& mission);

/// Unit of a quantity, and how many of it one of design::StageQuantity's is.
struct QuantityUnit {
  std::string unit;
  double factor = 1.0;
};
QuantityUnit unit_of(design::StageQuantity quantity, const PlantUnits& units);

/// A line of a stage's sheet: what to measure, in the plant's unit.
struct StageCheck {
  design::StageQuantity quantity = design::StageQuantity::rise_time;
  std::string unit;
  double expected = 0.0;              // on the nominal antenna
  double lower = 0.0, upper = 0.0;    // passes between them
  std::optional<double> abort_above;  // none: no limit of its own
};

/// The lines of a stage; none where a plant is unstable.
std::vector<StageCheck> stage_checks(const design::CommissioningStage& stage,
                                     const PlantUnits& units, double rms_allowance);

/// Three digits, no exponent: "0.0123", "412".
std::string checked_number(double value);

}  // namespace boresight::app
