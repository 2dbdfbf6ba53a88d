#pragma once

#include <string>
#include <vector>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/proposals/proposal.hpp>

namespace boresight::io {

/// One change as a report shows it.
struct ChangeRow {
  std::string key;
  std::string before;  // as the case has it
  std::string after;   // as the proposal has it: "12", "x 1.41"
  Basis basis = Basis::unstated;
  std::string source;
};

/// What a change brings with it.
struct DerivedChange {
  std::string quantity;
  std::string unit;
  double before = 0.0, after = 0.0;  // in `unit`
  std::string follows_from;          // the equation or the rule
  std::string key;                   // of the case's own number, where it is one
};

/// A case as a proposal makes it.
struct ProposedCase {
  Case antenna;
  std::vector<ChangeRow> changes;
  std::vector<DerivedChange> consequences;  // of quantities that the proposal does not name
};

/// Applies a proposal to a case, and all that must follow from its changes:
///   leakage            the coefficient C is the hardware's: lambda = C beta (1/V1 + 1/V2), so that
///                      volumes and bulk modulus leave K/lambda alone; C in proportion to the
///                      number of motors. A leakage rate given as a value is the changed drive's.
///   motor displacement by D = count x d/rev: K with D^2, supply torque with D, torque noise (of
///   and count          pressure transducers) with D, the valve's stroke (no-load motor speed) with
///                      1/D; bodies of the gear train of which there is one a motor by the count
///   supply pressure    supply torque in proportion, the valve's stroke with the square root
///   valve's rated flow the valve's stroke in proportion, at the case's rated pressure drop
///   valve stroke       the valve effort's limit: the same share of the stroke
///   gear teeth         every reflection, motor rates at given rates of the sky, encoder noise at
///                      the motor, backlash and offset torque at the motor; friction stays the same
///                      at the motor shaft, and grows at the sky with the ratio
///   flywheel disks     the motor's inertia, from rotor, disks and as built
///   line lengths       volumes, by the share that is lines; the lines' own pressure waves
///   gear stiffness     the locked-rotor frequency: the structure on the gear spring stays
///   sampling rate      dead time of one and a half samples, noise bandwidth of half the rate
/// Ranges of the ensemble that the case states in absolute numbers follow their number. Numbers
/// that a proposal names itself are as it says, factors on top of what follows.
/// @throws InvalidInput (FILE:LINE:COLUMN: KEY: ...) for what the case has not (a stage, an
/// assembly, a table), a number out of its range once changed, a structure that is none, changes
/// that contradict one another (motor inertia against disks, volumes against lines, delay against
/// sampling rate), a sampling that its own antenna's modes are too fast for, and a proposal that
/// changes nothing.
ProposedCase apply_proposal(const Case& antenna, const Proposal& proposal);

/// What differs between a case and what was made of it, quantity by quantity.
std::vector<DerivedChange> consequences_of(const Case& before, const Case& after);

}  // namespace boresight::io
