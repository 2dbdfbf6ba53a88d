#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/design/studies/state_space_study.hpp>

namespace boresight::app {

/// The verdict, and the state-space controller beside the recommended loops in the same runs.
Document document_of(const design::StateSpaceStudy& study, const TimeDomainSection& loops);

/// What it reaches, in a sentence for the decision; empty unless its verdict is better.
std::string state_space_advantage(const design::StateSpaceStudy& study,
                                  const TimeDomainSection& loops);

}  // namespace boresight::app
