#pragma once

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// Sensitivity of the rms to single inputs; empty where none was evaluated.
Document input_effects_part(const TuningSection& section);

}  // namespace boresight::app
