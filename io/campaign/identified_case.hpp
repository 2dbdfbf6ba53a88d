#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <boresight/identification/grey_box/identified_antenna.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The case with what its records show instead of what it states, and with standard uncertainties
/// of the samples (none: none). Numbers that the records show have the basis "measured"; inertias
/// and oil, which are combined estimates of records and stated numbers, always come from the
/// estimate. All else by `parts`: leakage rate, friction curve, friction slope of the linear plant,
/// valve frequency, frequencies of the structure, offset torque and bristles where the case has
/// them.
/// @throws NumericalFailure for an estimate that leaves the antenna no inertia, and for one that
/// the records' contradiction with the case makes none (DriveEstimate::contradicted).
Case with_identified(const Case& antenna, const identification::DriveEstimate& estimate,
                     const std::vector<identification::DriveEstimate>& random_samples = {},
                     const identification::IdentifiedParts& parts = {});

/// The parts that a case takes from its records: what they show (identification::identified_parts)
/// but for numbers that the case states itself, not assumed, with a smaller uncertainty.
identification::IdentifiedParts taken_parts(const Case& antenna,
                                            const identification::GreyBoxResult& found);

/// A number that records have given in place of a stated one.
struct SupersededInput {
  std::string key;
  std::string unit;      // of the values, as the report shows SI
  std::string stated;    // as written; empty: derived
  bool assumed = false;  // the case assumed it, in value or in uncertainty
  double stated_value = 0.0;
  double value = 0.0;
  double standard_uncertainty = 0.0;
};

/// Inputs of the stated case that its records replace, in the case's order.
std::vector<SupersededInput> superseded_inputs(const Case& stated, const Case& identified);

/// Whether one of them has a key that begins so ("friction_curve.").
bool is_superseded(const std::vector<SupersededInput>& inputs, std::string_view key_begin);

}  // namespace boresight::io
