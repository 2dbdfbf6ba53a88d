#pragma once

#include <boresight/io/campaign/campaign_section.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::io {

/// The reconciled estimate of a quantity (GreyBoxQuantity::name), where there is one.
std::optional<numerics::Interval> reconciled(const CampaignSection& section,
                                             const std::string& quantity);
std::optional<Difference> difference_from_reconciled(const CampaignSection& section,
                                                     const std::string& quantity,
                                                     const numerics::Interval& other);

/// All motors over everything else (eq. 27) from a reflected inertia (kg m2).
numerics::Interval motor_to_load_ratio(const identification::DriveKnowledge& knowledge,
                                       const numerics::Interval& inertia);

/// One row a method, with the difference from the reconciled inertia and its reasons.
std::vector<InertiaRow> inertia_rows(const CampaignSection& section, const Case& antenna);

/// Other estimates of bulk modulus, oil stiffness, leakage, offset and Coulomb level.
std::vector<QuantityRow> quantity_rows(const CampaignSection& section);

/// For a section without a grey box: the mean of drawings and of either method's best estimate, or
/// that they contradict one another beyond chance.
void average_methods(CampaignSection& section);

/// Friction at the constant-speed tests' rates (some of them, where there are many, with more
/// between, where there are few) and at the tracking rate. Empty without any friction law.
std::vector<FrictionRow> friction_rows(const CampaignSection& section,
                                       const identification::Campaign& campaign);

/// Where a reconciled quantity comes from: "identified"; "slosh" where the lines' ringing gave the
/// prior (with volumes of the data sheet in the stiffness) and other records add little to it;
/// "drawings"; "not identifiable". "contradicts slosh", "contradicts drawings" where what fits the
/// records is more than two and a half of the prior's uncertainties away from it; "contradicts the
/// case" for all where the records contradict what inertia and stiffness rest on.
std::string verdict(const CampaignSection& section,
                    const identification::GreyBoxQuantity& quantity);

/// That records and stated numbers contradict one another beyond chance, in a sentence; empty if
/// they do not.
std::string contradiction_with_case(const identification::GreyBoxResult& found);

/// What the records cannot tell.
std::vector<std::string> not_identifiable(const CampaignSection& section);

/// Numbers that the case states and the records contradict by more than two combined standard
/// uncertainties, the worst first.
std::vector<Contradiction> contradictions(const CampaignSection& section, const Case& antenna);

}  // namespace boresight::io
