#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The whole report, the decision first, angles at the sky in mdeg; and as text for a terminal.
Document document_of(const Report& report);
std::string to_text(const Report& report);

// One function per section; each begins with its heading.
// Results of the records: quantities that are not identifiable, the combined estimate, the single
// methods.
Document document_of(const io::CampaignSection& section);
/// The records: tests, defects with place and count, everything that was taken for granted.
Document document_of(const io::CampaignNotes& notes);
/// What each channel must be for the others to be right.
Document document_of(const std::vector<identification::ChannelCheck>& channels);
Document document_of(const IdentificationSection& section);
/// Every finding by kind, numbered, then the summary.
Document document_of(const AuditReport& report);
/// How many places do not follow, and which of them move a headline result by more than 0.1 %.
std::string audit_summary(const AuditReport& report);
Document document_of(const PlantSection& section);
Document document_of(const TuningSection& section);
/// The table of tuned controllers, gains before and after, active constraints, requirements out of
/// reach.
Document document_of(const TuneSection& section);
/// The controller on the nonlinear antenna.
Document document_of(const TimeDomainSection& section);
/// The result of each interpretation of contradictory numbers in the case.
Document document_of(const std::vector<InterpretationResult>& interpretations);
Document document_of(const MatchingSection& section);
/// Inputs that the records have replaced, before and after.
Document document_of(const std::vector<io::SupersededInput>& superseded);
/// The assumed inputs, and why each.
Document document_of(const std::vector<io::Quantity>& assumed);

}  // namespace boresight::app
