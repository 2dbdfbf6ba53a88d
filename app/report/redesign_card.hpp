#pragma once

#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/report/report.hpp>

namespace boresight::app {

/// A line of the card that a review board decides by.
struct CardLine {
  std::string label, text;
  std::string evidence;  // how the heading of its section begins
};

/// The result of a redesign: the controller, its pointing error against the budgets, its margins,
/// the flywheels, contradictions, the next test, the confidence. Its figures are those of the
/// sections. Empty without a tuned controller.
std::vector<CardLine> redesign_card(const Report& report);

/// The card as the report's Lead.
Document document_of(const std::vector<CardLine>& card);

}  // namespace boresight::app
