#pragma once

#include <string>
#include <vector>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/proposals/proposal.hpp>

namespace boresight::io {

/// One change, as shown in a report.
struct ChangeRow {
  std::string key;
  std::string before;  // as the case has it
  std::string after;   // as the proposal has it: "12", "x 1.41"
  Basis basis = Basis::unstated;
  std::string source;
};

/// A quantity that changes as a consequence.
struct DerivedChange {
  std::string quantity;
  std::string unit;
  double before = 0.0, after = 0.0;  // in `unit`
  std::string follows_from;          // the equation or the rule
  std::string key;                   // of the case's own number, where it is one
};

/// A case with a proposal applied.
struct ProposedCase {
  Case antenna;
  std::vector<ChangeRow> changes;
  std::vector<DerivedChange> consequences;  // of quantities that the proposal does not name
};

/// Applies a proposal to a case, with all changes that depend on it:
///   leakage            the coefficient C belongs to the hardware: lambda = C beta (1/V1 + 1/V2);
///                      volumes and bulk modulus keep K/lambda; C in proportion to the
///                      number of motors. A leakage rate given as a value is the changed drive's.
///   motor displacement by D = count x d/rev: K with D^2, supply torque with D, torque noise (of
///   and count          pressure transducers) with D, the valve's stroke (no-load motor speed) with
///                      1/D; bodies of the gear train that come one per motor, by the count
///   supply pressure    supply torque in proportion, the valve's stroke with the square root
///   valve's rated flow the valve's stroke in proportion, at the case's rated pressure drop
///   valve stroke       the limit of the control effort: the same fraction of the stroke
///   gear teeth         every reflection, motor rates at given rates on the sky, encoder noise at
///                      the motor, backlash and offset torque at the motor; friction stays the same
///                      at the motor shaft, and grows on the sky with the ratio
///   flywheel disks     the motor's inertia, from rotor, disks and as built
///   line lengths       volumes, by the lines' fraction; the lines' own pressure waves
///   gear stiffness     the locked-rotor frequency: the structure on the gear spring stays
///   sampling rate      dead time of one and a half samples, noise bandwidth of half the rate
/// Ranges of the ensemble that the case states in absolute numbers scale with their number. Numbers
/// that a proposal names itself are set as stated; factors apply on top of the dependent changes.
/// @throws InvalidInput (FILE:LINE:COLUMN: KEY: ...) for items missing in the case (a stage, an
/// assembly, a table), a number out of its range after the change, or an invalid structure. Also
/// for changes that contradict each other (motor inertia against disks, volumes against lines,
/// delay against sampling rate), a sampling too slow for the modes of its antenna, and a proposal
/// without effect.
ProposedCase apply_proposal(const Case& antenna, const Proposal& proposal);

/// Differences between a case and a case derived from it, quantity by quantity.
std::vector<DerivedChange> consequences_of(const Case& before, const Case& after);

}  // namespace boresight::io
