#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <boresight/io/case/case_declaration.hpp>
#include <boresight/io/units/quantity.hpp>

namespace boresight::io {

/// A number of a case that a proposal replaces, or multiplies.
struct ProposedChange {
  /// In the case's words: "motor.displacement", "gear_train.stage[3].driven_teeth" (counted from
  /// the motors, from 1), "gear_train.assembly[J3].inertia".
  std::string key;
  Quantity number;
  bool multiplies = false;  // the number is a factor
};

struct ProposedCost {
  Quantity amount;
  std::string currency;
};

/// The content of a proposal file: changes of an antenna as its case describes it.
struct Proposal {
  std::string path;
  std::string name;
  Location name_location;
  std::string description;
  std::optional<ProposedCost> cost;  // none: nobody has priced it
  Location cost_location;
  std::vector<std::string> risks;
  /// Loop structures to tune it with; empty: those of the present antenna.
  std::vector<std::string> structures;
  Location structures_location;
  std::vector<ProposedChange> changes;  // in the order of docs/proposals.md

  /// The change of that key, or none.
  const ProposedChange* find(std::string_view key) const;
};

/// Reads a proposal file (docs/proposals.md). @throws InvalidInput with one message: file, line,
/// column, key, what was expected and what was found. Whether it fits a case is
/// apply_proposal's to say.
Proposal read_proposal(const std::string& path);
/// Same, of a text.
Proposal parse_proposal(std::string_view text, const std::string& path);

}  // namespace boresight::io
