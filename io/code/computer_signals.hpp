#pragma once

#include <string>
#include <vector>

#include <boresight/control/program/controller_program.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// A signal of the antenna's computer, for a reader.
struct SignalDescription {
  std::string signal;   // "encoder", "tachometer", "pressure difference", "valve command"
  std::string scale;    // with units
  bool stated = false;  // by the case; else a default, to be replaced before use
};

struct CaseSignals {
  control::program::ComputerSignals signals;
  std::vector<SignalDescription> descriptions;
};

/// The signals by [computer] and [tachometer] of the case. Defaults: encoder counts 2^n nearest to
/// the resolution (design::encoder_step), 0 at 0 deg, travel about 45 deg of an elevation axis and
/// 180 deg of another; tachometer in rad/s of motor; torque as pressure difference between the
/// ports in pascals, described only if `reads_torque`; valve command in percent of the full stroke.
/// @throws InvalidInput without [simulation], which states that stroke.
CaseSignals computer_signals(const Case& antenna, const design::Mission& mission,
                             bool reads_torque = true);

}  // namespace boresight::io
