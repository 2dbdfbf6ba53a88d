#include <utility>

#include <fmt/format.h>

#include <boresight/io/case/field.hpp>
#include <boresight/io/case/mission_of.hpp>
#include <boresight/io/proposals/compared_antennas.hpp>
#include <boresight/io/units/wording.hpp>

namespace boresight::io {
namespace {

void check_together(const std::vector<Proposal>& proposals) {
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    const auto& one = proposals[i];
    if (one.name == as_it_is) {
      refuse_at(
          one.name_location, "name",
          fmt::format("expected another name than {}, which is the antenna without proposals, "
                      "found it",
                      in_quotes(as_it_is)));
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (proposals[k].name == one.name) {
        refuse_at(one.name_location, "name",
                  fmt::format("expected a name of its own, found {}, which {} has too",
                              in_quotes(one.name), proposals[k].path));
      }
      const auto& other = proposals[k].cost;
      if (one.cost && other && other->currency != one.cost->currency) {
        refuse_at(one.cost_location, "cost.currency",
                  fmt::format("expected the currency of {}, {}, since costs are compared, found {}",
                              proposals[k].path, in_quotes(other->currency),
                              in_quotes(one.cost->currency)));
      }
    }
  }
}

}  // namespace

ComparedAntennas compared_antennas(const Case& antenna, const std::vector<Proposal>& proposals,
                                   const std::vector<std::string>& structures) {
  check_together(proposals);
  ComparedAntennas compared;
  const auto add = [&](ProposedCase proposed, std::string name, std::optional<double> cost,
                       const std::vector<std::string>& asked) {
    compared.antennas.push_back({std::move(name), mission_of(proposed.antenna),
                                 asked_structures(proposed.antenna, asked), cost,
                                 !proposed.changes.empty()});
    design::validate(constraints(compared.antennas.back().mission));
    compared.cases.push_back(std::move(proposed));
  };
  add({antenna, {}, {}}, std::string(as_it_is), 0.0, structures);
  for (const auto& proposal : proposals) {
    if (proposal.cost) compared.currency = proposal.cost->currency;
    add(apply_proposal(antenna, proposal), proposal.name,
        proposal.cost ? std::optional(proposal.cost->amount.value) : std::nullopt,
        proposal.structures.empty() ? structures : proposal.structures);
  }
  return compared;
}

void check_proposals(const Case& antenna, const std::vector<Proposal>& proposals) {
  check_together(proposals);
  for (const auto& proposal : proposals) {
    design::validate(make_goals(apply_proposal(antenna, proposal).antenna));
  }
}

}  // namespace boresight::io
