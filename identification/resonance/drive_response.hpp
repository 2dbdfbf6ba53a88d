#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boresight/identification/records/drive_record.hpp>
#include <boresight/numerics/statistics/interval.hpp>

namespace boresight::identification {

/// A mode of the structure on a locked rotor, from the motor's torque and rate.
struct StructuralMode {
  numerics::Interval frequency;  // Hz
  numerics::Interval damping_ratio;
  numerics::Interval inertia;  // kg m2, the part of the load's that moves with this mode
};

/// Torque over rate of the motor's shaft,
///   Z(s) = B + s [J0 + sum Jk (1 + 2 zk s/wk)/(1 + 2 zk s/wk + (s/wk)^2)],
/// which is independent of the drive's hydraulics. J0 is rigid with the motors (including modes
/// above the band); each Jk belongs to a mode of the locked rotor.
struct MechanicalImpedance {
  numerics::Interval inertia;        // J0 + all Jk, kg m2
  numerics::Interval rigid_inertia;  // J0
  std::vector<StructuralMode> modes;
  /// B: slope of friction at the record's speed, N m s/rad.
  numerics::Interval friction_slope;
  double lowest_frequency = 0.0;  // Hz, band that was fitted
  double highest_frequency = 0.0;
};

/// The oil between valve and motor, dT/dt = K (q - w) - lambda T - R dw/dt: from the same record,
/// when its valve command was recorded.
struct OilRelation {
  numerics::Interval stiffness;  // K, N m/rad
  /// lambda, 1/s: leakage, and the contribution of the valve's orifices at the record's mean flow.
  numerics::Interval total_loss_rate;
  /// K q/(2 e_t D) times the mean of 1/(2 (ps - p1)) and 1/(2 (p2 - pr)): orifices in series, flow
  /// q the mean rate's and the leakage's. 1/s
  double orifice_loss_rate = 0.0;
  /// Total less orifices: leakage alone, 1/s. The orifices' part is taken as known to 6 %.
  numerics::Interval leakage_rate;
  /// R: pressure lost in the lines, as torque per rate, N m s/rad.
  numerics::Interval line_resistance;
  /// No-load speed per rad/s of command as scaled in the record, linear about the mean.
  numerics::Interval valve_gain;
  double valve_delay = 0.0;  // s, of the valve as a pure delay
};

struct DriveResponseOptions {
  /// Hz; 0: from the record (where torque and rate stand out) and the knowledge's expected
  /// hydraulic frequency.
  double lowest_frequency = 0.0;
  double highest_frequency = 0.0;
  /// Largest number of the knowledge's locked-rotor frequencies that are fitted.
  std::size_t max_modes = 3;
  /// Largest relative difference of a locked-rotor frequency from the structural model's.
  double frequency_tolerance = 0.25;
};

/// Result of one record in motion: a chirp, or steps with less accuracy.
struct DriveResponse {
  std::string record;
  MechanicalImpedance impedance;
  /// Absent also if the record has too little excitation below twice the structure's lowest mode.
  std::optional<OilRelation> oil;
  /// The hydraulic mode that both make at the record's mean speed: the root of
  /// (s + lambda) Z(s) + R s + K = 0 near the expected one. Undamped natural, Hz.
  std::optional<numerics::Interval> hydraulic_frequency;
  std::optional<numerics::Interval> hydraulic_damping_ratio;
  double mean_rate = 0.0;    // rad/s, over the part used
  double mean_torque = 0.0;  // N m
  double start = 0.0;        // s, of the part used
  double length = 0.0;
  /// For plots: torque over rate, smoothed over neighbouring bins, and the fit there.
  Eigen::VectorXd frequency;
  Eigen::VectorXcd measured;
  Eigen::VectorXcd fitted;
  std::vector<std::string> notes;
};

/// Fits MechanicalImpedance and OilRelation to the Fourier transforms of torque, rate and valve
/// command. It uses the longest part of the record in which the drive moves one way. Both relations
/// are linear in inertias, friction, stiffness and loss; modal frequencies and dampings follow by
/// Gauss-Newton with the linear part eliminated. Torque and rate are measured at the same shaft, so
/// J needs no oil data, no valve and no damping model. Friction, which is in phase with the rate,
/// does not enter. Intervals include the transducers' scales (all pressure gains independent), the
/// fit's noise and the effect of a change of the band.
/// @throws InvalidInput for a record without pressures; NumericalFailure if the drive never moves
/// one way for long enough or the inertia does not show in the torque.
DriveResponse drive_response(const DriveRecord& record, const Campaign& campaign,
                             const DriveResponseOptions& options = {});

/// Relative standard uncertainty of recorded torque changes: from each pressure's independent gain
/// error, torque efficiency and displacement.
double torque_scale_uncertainty(const DriveRecord& record, const Campaign& campaign);

/// Loss rate (1/s) due to the valve's orifices at a mean flow (rad/s of motor) and the mean
/// pressures over samples `first` .. `first + count` of a record; as
/// OilRelation::orifice_loss_rate.
double orifice_loss_rate(const DriveRecord& record, const DriveKnowledge& knowledge,
                         double stiffness, double mean_flow, Eigen::Index first,
                         Eigen::Index count);

/// Samples of the longest part in which the drive moves one way faster than a quarter of its usual
/// speed, with all channels valid to 2 %; less a margin at its start.
struct MovingPart {
  Eigen::Index first = 0;
  Eigen::Index samples = 0;
};
MovingPart moving_part(const DriveRecord& record);

}  // namespace boresight::identification
