#pragma once

#include <vector>

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// Evaluates the classic rules on the curves of a study that has its points and series. For each
/// rule: the inertia it requires, and its cost for every structure, interpolated linearly between
/// points.
std::vector<RuleVerdict> evaluate_rules(const Mission& mission, const MatchingStudy& study);

}  // namespace boresight::design
