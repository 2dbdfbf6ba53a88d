#pragma once

#include <string>
#include <vector>

#include <boresight/io/audit/case_audit.hpp>

namespace boresight::app {

/// An input or result that contradicts physics or the rest of the case: a check of
/// io::check_physics that fails, in words.
struct Implausibility {
  /// Subject of the check, in the words of audit_description.cpp: "wave speed".
  std::string check;
  /// The quantity, by id.
  std::string id;
  /// One sentence with the numbers in it.
  std::string reasoning;
  /// The numbers that it uses; deflection in mdeg.
  std::vector<design::CheckedNumber> numbers;
};

/// A note of the case's author on a place of the source.
struct Remark {
  std::string place;
  std::string text;
};

/// What an audit of a case found, in words.
struct AuditReport {
  std::string title;
  std::vector<design::Finding> findings;
  std::vector<Implausibility> implausible;
  /// The case writer's own, what no recomputation can find.
  std::vector<Remark> remarks;
  /// As of io::CaseAudit.
  std::size_t checked = 0;
  std::vector<std::string> compared;
};

/// io::audit of the case in words. @throws as that.
AuditReport audit_report(const io::Case& antenna);

/// Number of failed physical checks and their subjects: "3 physical checks fail: wave speed (2),
/// recorder limit".
std::string failing_checks(const std::vector<Implausibility>& implausible);

}  // namespace boresight::app
