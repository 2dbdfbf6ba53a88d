#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/app/simulate/time_domain.hpp>
#include <boresight/control/controllers/loop_structure.hpp>
#include <boresight/design/studies/state_space_study.hpp>

namespace boresight::app {

/// A state-space controller instead of gains: its order, what it reads, where its matrices are.
std::string state_space_text(const control::LoopStructure& structure);

/// The verdict, and the state-space controller beside the recommended loops in the same runs.
Document document_of(const design::StateSpaceStudy& study, const TimeDomainSection& loops);

/// What it reaches, in a sentence for the decision; empty unless its verdict is better.
std::string state_space_advantage(const design::StateSpaceStudy& study,
                                  const TimeDomainSection& loops);

}  // namespace boresight::app
