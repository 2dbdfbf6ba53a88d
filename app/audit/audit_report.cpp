#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boresight/app/audit/audit_report.hpp>
#include <boresight/app/audit/check_sentences.hpp>
#include <boresight/io/case/case_file.hpp>
#include <boresight/io/case/case_statements.hpp>
#include <boresight/numerics/angles.hpp>

namespace boresight::app {
namespace {

const CheckWording& wording_of(const design::PhysicalCheck& check) {
  for (const auto wordings : {drive_wordings(), antenna_wordings()}) {
    const auto found = std::ranges::find(wordings, check.id, &CheckWording::id);
    if (found != wordings.end()) return *found;
  }
  throw std::logic_error("no words for the check " + check.id);
}

std::vector<Implausibility> implausibilities(const io::Case& antenna,
                                             const io::PhysicalChecks& physics) {
  std::vector<Implausibility> found;
  for (const design::PhysicalCheck& check : physics.checks) {
    if (check.holds) continue;
    const CheckWording& wording = wording_of(check);
    found.push_back({std::string(wording.name), check.quantity,
                     wording.sentence({check, antenna, physics}), check.numbers});
    if (check.id != "structural_shares") continue;
    for (design::CheckedNumber& bending : found.back().numbers) {
      bending.value /= millidegree;
      bending.unit = "mdeg";
    }
  }
  return found;
}

}  // namespace

AuditReport audit_report(const io::Case& antenna) {
  io::CaseAudit found = io::audit(antenna);
  std::vector<Remark> remarks;
  for (const auto& remark : antenna.remarks) remarks.push_back({remark.place, remark.text});
  return {antenna.title,
          std::move(found.findings),
          implausibilities(antenna, found.physics),
          std::move(remarks),
          found.checked,
          std::move(found.compared)};
}

std::string failing_checks(const std::vector<Implausibility>& implausible) {
  if (implausible.empty()) return "no physical check fails";
  std::vector<std::pair<std::string, int>> counts;
  for (const Implausibility& one : implausible) {
    const auto known = std::find_if(counts.begin(), counts.end(),
                                    [&](const auto& count) { return count.first == one.check; });
    if (known == counts.end()) {
      counts.emplace_back(one.check, 1);
    } else {
      ++known->second;
    }
  }
  std::vector<std::string> subjects;
  for (const auto& [check, count] : counts) {
    subjects.push_back(count == 1 ? check : fmt::format("{} ({})", check, count));
  }
  return fmt::format("{}: {}",
                     implausible.size() == 1
                         ? "1 physical check fails"
                         : fmt::format("{} physical checks fail", implausible.size()),
                     fmt::join(subjects, ", "));
}

}  // namespace boresight::app
