#pragma once

#include <string>
#include <vector>

#include <boresight/control/controllers/controller.hpp>
#include <boresight/design/problem/mission.hpp>
#include <boresight/io/case/case_declaration.hpp>

namespace boresight::io {

/// The units that a case writes gains in: of the present gains of a structure, or the lower bounds
/// of a [[loop]]; of other structures SI.
class GainUnits {
 public:
  /// SI only.
  GainUnits() = default;
  explicit GainUnits(const Case& stated);

  /// The gains in the structure's order: "0.127 Hz".
  std::vector<std::string> texts(const control::Controller& controller) const;

 private:
  struct Unit {
    std::string symbol;
    double factor = 1.0;
  };
  struct Written {
    control::LoopStructure structure;
    std::vector<Unit> units;  // of each gain
  };
  std::vector<Written> written_;
};

/// The controllers that the antenna runs on now, by the case: of [gains] and of each [[loop]] with
/// present values. Names are those that --structure takes.
std::vector<design::NamedController> present_controllers(const Case& stated);

}  // namespace boresight::io
