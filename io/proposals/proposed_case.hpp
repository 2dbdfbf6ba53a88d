#pragma once

#include <vector>

#include <boresight/io/case/case_file.hpp>
#include <boresight/io/proposals/change_rows.hpp>
#include <boresight/io/proposals/proposal.hpp>

namespace boresight::io {

/// A case with a proposal applied.
struct ProposedCase {
  Case antenna;
  std::vector<ChangeRow> changes;
  std::vector<DerivedChange> derived_quantities;  // of quantities that the proposal does not name
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
std::vector<DerivedChange> derived_quantities_of(const Case& before, const Case& after);

}  // namespace boresight::io
