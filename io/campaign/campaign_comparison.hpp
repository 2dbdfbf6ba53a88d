#pragma once

#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The combined estimate of a quantity (GreyBoxQuantity::name); nothing without one.
std::optional<numerics::Interval> combined(const CampaignSection& section,
                                           const std::string& quantity);
std::optional<Difference> difference_from_combined(const CampaignSection& section,
                                                   const std::string& quantity,
                                                   const numerics::Interval& other);

/// All motors over everything else (eq. 27) from a reflected inertia (kg m2).
numerics::Interval motor_to_load_ratio(const identification::DriveKnowledge& knowledge,
                                       const numerics::Interval& inertia);

/// One row per method, with the difference from the combined estimate of the inertia and its
/// causes.
std::vector<InertiaRow> inertia_rows(const CampaignSection& section, const Case& antenna);

/// Other estimates of bulk modulus, oil stiffness, leakage, offset and Coulomb level.
std::vector<QuantityRow> quantity_rows(const CampaignSection& section);

/// For a section without a grey box: the mean of drawings and of each method's best estimate, or a
/// statement that they contradict each other significantly.
void average_methods(CampaignSection& section);

/// Friction at the rates of the constant-speed tests and at the tracking rate. Of many tests a
/// selection is taken; between few tests further rates are added. Empty without a friction model.
std::vector<FrictionRow> friction_rows(const CampaignSection& section,
                                       const identification::Campaign& campaign);

/// Source of a combined estimate:
/// - "identified";
/// - "slosh": the lines' ringing gave the prior (with data-sheet volumes in the stiffness) and
///   other records add little;
/// - "drawings";
/// - "not identifiable";
/// - "contradicts slosh", "contradicts drawings": the value that fits the records is more than 2.5
///   standard uncertainties (of the prior) away from it;
/// - "contradicts the case", for all quantities: the records contradict the data behind inertia and
///   stiffness.
std::string verdict(const CampaignSection& section,
                    const identification::GreyBoxQuantity& quantity);

/// "tachometer scale: 1.04 times the stated value, 3.8 standard uncertainties; ...", of each number
/// by records and all other stated numbers.
std::string departures_of(const std::vector<identification::StatedNumberCheck>& numbers);

/// A sentence if records and stated numbers contradict each other significantly; else empty.
std::string contradiction_with_case(const identification::GreyBoxResult& found);

/// Quantities that the records do not determine.
std::vector<std::string> not_identifiable(const CampaignSection& section);

/// Numbers stated in the case that differ from the records by more than two combined standard
/// uncertainties, the largest difference first.
std::vector<Contradiction> contradictions(const CampaignSection& section, const Case& antenna);

}  // namespace boresight::io
