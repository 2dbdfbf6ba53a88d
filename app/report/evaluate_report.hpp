#pragma once

#include <string>

#include <boresight/app/document/document.hpp>
#include <boresight/app/evaluate/evaluate_section.hpp>

namespace boresight::io {
class Visitor;
}

namespace boresight::app {

/// The headings of the section and of its part about probabilities, which figures name too.
std::string heading_of(const EvaluateSection& section);
std::string heading_of(const DecisionSection& decision);

/// The section of the report.
Document document_of(const EvaluateSection& section);
/// Its part about probabilities, regrets and tests.
Document document_of(const EvaluateSection& section, const DecisionSection& decision);

/// "evaluated" of docs/report.schema.json, and its "decision".
void describe(io::Visitor& v, const EvaluateSection& section);
void describe_decision(io::Visitor& v, const EvaluateSection& section,
                       const DecisionSection& decision);

}  // namespace boresight::app
