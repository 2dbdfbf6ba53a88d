#pragma once

#include <string>

#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// The report as text for a terminal: paragraphs of 108 columns, tables as wide as they need;
/// angles at the sky in mdeg.
std::string to_text(const Report& report);

// One function a section; each begins with its heading.
/// What the records say: what is not identifiable, the reconciled estimate, the methods beside it.
std::string to_text(const CampaignSection& section);
/// The records: tests, defects with place and count, everything that was taken for granted.
std::string to_text(const CampaignNotes& notes);
std::string to_text(const IdentificationSection& section);
/// Every finding by kind, numbered, then the summary.
std::string to_text(const AuditReport& report);
/// How many places do not follow, and which of them move a headline result by more than 0.1 %.
std::string audit_summary(const AuditReport& report);
std::string to_text(const PlantSection& section);
std::string to_text(const TuningSection& section);
/// The table of tuned laws, gains before and after, what limits each, what cannot be reached.
std::string to_text(const TuneSection& section);
std::string choices_text(const std::vector<ChoiceResult>& choices);
std::string to_text(const MatchingSection& section);
std::string assumed_text(const std::vector<Quantity>& assumed);

}  // namespace boresight::app
