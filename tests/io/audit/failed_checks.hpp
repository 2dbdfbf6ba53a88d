#pragma once

#include <string>
#include <vector>

#include "io/edited_case.hpp"
#include <boresight/io/audit/case_graph.hpp>
#include <boresight/io/audit/physical_checks.hpp>

namespace boresight::io {

using Checks = std::vector<design::PhysicalCheck>;

/// The checks of that id that fail.
inline Checks failed(const Case& antenna, const std::string& id) {
  Checks found = check_physics(antenna, case_graph(antenna)).checks;
  std::erase_if(found, [&](const auto& check) { return check.holds || check.id != id; });
  return found;
}

inline Checks failed(const EditedCase& edited, const std::string& id) {
  return failed(parse_case(edited.text(), "case.toml"), id);
}

}  // namespace boresight::io
