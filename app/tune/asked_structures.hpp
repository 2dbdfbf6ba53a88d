#pragma once

#include <string>
#include <vector>

#include <boresight/io/case/case_file.hpp>

namespace boresight::app {

/// The loop structures to tune: those asked for; else those of the case's [tuning]; else PI, DPF,
/// LL, FULL, PI+C, DPF+C and the case's own.
/// @throws InvalidInput for one that is none or stands twice.
std::vector<std::string> asked_structures(const io::Case& antenna, std::vector<std::string> asked);

}  // namespace boresight::app
