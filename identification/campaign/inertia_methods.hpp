#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/numerics/statistics/propagation.hpp>
#include <boresight/numerics/statistics/uncertain.hpp>
#include <boresight/plant/antenna/gear_train.hpp>
#include <boresight/plant/antenna/hydraulics.hpp>

namespace boresight::identification {

/// Everything the three methods rest on, from drawings, test stand and tests. SI; frequencies Hz.
struct DriveEvidence {
  struct Assembly {
    std::string name;
    numerics::Uncertain inertia;  // one of them, about its own axis
    double count = 1.0;
    std::size_t stages = 0;
  };
  struct AntennaInertia {
    std::string name;
    numerics::Uncertain reflected;  // at the motor shaft
  };
  struct Line {
    std::string name;
    numerics::Uncertain length;
    numerics::Uncertain slosh_frequency;
  };
  struct Impulse {
    std::string name;
    numerics::Uncertain reflected_inertia;
  };
  std::vector<plant::GearStage> stages;
  std::vector<Assembly> assemblies;
  std::vector<AntennaInertia> antenna;  // at least one; the first is the one used
  /// A whole load inertia that the source prints: gear train and antenna at the motor shaft.
  struct PrintedLoad {
    std::string source;
    double value = 0.0;
  };
  std::optional<PrintedLoad> printed_load;
  double motor_count = 1.0;
  numerics::Uncertain motor_inertia;  // one motor with flywheel
  numerics::Uncertain displacement;   // one motor, m3/rad
  numerics::Uncertain torque_efficiency;
  numerics::Uncertain volumetric_efficiency;
  numerics::Uncertain oil_density;  // for lines alone
  std::vector<Line> lines;
  std::optional<numerics::Uncertain> bulk_modulus;  // else the mean over the lines
  numerics::Uncertain volume_1;
  numerics::Uncertain volume_2;
  plant::EfficiencyInStiffness efficiency_in_stiffness = plant::EfficiencyInStiffness::both;
  std::optional<numerics::Uncertain> resonance_frequency;
  std::vector<Impulse> impulse;
};

enum class MethodKind { mass_properties, resonance, impulse };

/// One method's answer.
struct InertiaMethod {
  MethodKind kind = MethodKind::mass_properties;
  std::string name;
  std::string assumes;
  numerics::PropagatedResult reflected_inertia;    // kg m2
  numerics::PropagatedResult motor_to_load_ratio;  // eq. 27: motors against everything else
  /// What the method leaves for the antenna after motors and gear train (kg m2).
  numerics::PropagatedResult antenna_remainder;
};

struct InertiaIdentification {
  double gear_ratio = 1.0;
  std::vector<numerics::PropagatedResult>
      load_rows;  // each assembly and each antenna inertia, kg m2
  std::vector<numerics::PropagatedResult> line_bulk_modulus;  // Pa, eq. 26
  numerics::PropagatedResult bulk_modulus;                    // Pa, as used
  numerics::PropagatedResult oil_stiffness;                   // N m/rad, eq. 17
  /// Rigid hydraulic frequency that mass properties and oil stiffness give (Hz), eq. 18.
  numerics::PropagatedResult expected_frequency;
  std::vector<InertiaMethod> methods;  // by kind, in the evidence's order
};

/// Reflected inertia and ratio by mass properties (eqs. 3-6), hydraulic resonance (eqs. 7-26) and
/// impulse-momentum, each with an interval propagated from all its inputs (propagation.hpp).
/// @throws InvalidInput for evidence without an antenna inertia, or as the plant's formulas do.
InertiaIdentification identify_inertia(const DriveEvidence& evidence,
                                       const numerics::PropagationOptions& options = {});

/// One estimate from several methods.
struct CombinedInertia {
  double value = 0.0;
  double standard_uncertainty = 0.0;
  double lower = 0.0;  // 95 %
  double upper = 0.0;
  /// Standard deviation between the methods beyond their own uncertainties.
  double between_methods = 0.0;
  /// Cochran's Q and its degrees of freedom: Q far above them indicates that the methods contradict
  /// each other.
  double heterogeneity = 0.0;
  int degrees_of_freedom = 0;
  double motor_to_load_ratio = 0.0;
  double ratio_lower = 0.0;
  double ratio_upper = 0.0;  // infinity where the inertia's interval reaches the motors' own

  /// True if Cochran's Q has a probability below 0.001: the mean then represents none of the
  /// methods, and there is no combined estimate of the inertia.
  bool contradictory() const;
};

/// Random-effects mean (DerSimonian and Laird, Controlled Clinical Trials 7, 1986): each method's
/// own variance plus one between-method variance estimated from their scatter. Interval by
/// Student's t with methods - 1 degrees of freedom; of two methods, the hull of their own. Results
/// of one record count as one method: pass their mean. `motor_inertia`: all motors.
/// @throws InvalidInput for fewer than two estimates or an uncertainty that is not positive.
CombinedInertia combine(const std::vector<numerics::Uncertain>& estimates, double motor_inertia);

/// Tachometer scale (rad/s of motor per V): shaft speed (rad/s) at a voltage (V), times the motor's
/// turns per tachometer turn. Sommerville eq. 32.
double tachometer_scale(double shaft_speed, double voltage, double motor_turns_per_turn);

/// Coulomb friction and offset torque from the torques that keep the antenna moving up and down:
/// half their sum and half their difference (down less up). Sommerville section IV.B.
struct FrictionAndOffset {
  double coulomb = 0.0;
  double offset = 0.0;
};
FrictionAndOffset friction_and_offset(double torque_up, double torque_down);

}  // namespace boresight::identification
