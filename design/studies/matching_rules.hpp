#pragma once

#include <vector>

#include <boresight/design/studies/matching_study.hpp>

namespace boresight::design {

/// The classic rules against the curves of a study that has its points and series: the inertia that
/// each asks for and, between points by straight lines, what following it costs every structure.
std::vector<RuleVerdict> judge_rules(const Mission& mission, const MatchingStudy& study);

}  // namespace boresight::design
