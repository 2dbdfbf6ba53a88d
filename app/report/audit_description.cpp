#include <boresight/app/report/audit_description.hpp>
#include <boresight/io/description/visitor.hpp>

namespace boresight::app {
namespace {

using design::FindingKind;

// The unit stands beside the number, since the quantities have many.
constexpr io::KeyUnit as_named{.suffix = "si"};

void describe_form(io::Visitor& v, const design::DepartingForm& form) {
  v.text("printed_text", form.text, "As printed.");
  v.number("printed", form.printed, as_named, "As printed.");
  v.text("would_be_text", form.would_be_text, "What would follow, with as many digits.");
  v.number("would_be", form.would_be, as_named, "What would follow.");
  v.number("tolerance", form.tolerance, as_named,
           "Printed rounding of this number and of all it comes from.", {.minimum = 0.0});
  v.number("relative_error", form.relative_error(), io::key_units::ratio,
           "Printed over what would follow, less 1.");
}

void describe_derived_quantity(io::Visitor& v, const design::DerivedQuantity& derived_quantity) {
  v.text("id", derived_quantity.id, "The result.");
  v.text("unit", derived_quantity.unit, "SI unit of its numbers.");
  v.number("as_printed", derived_quantity.as_printed, as_named, "With the number as printed.");
  v.number("as_corrected", derived_quantity.as_corrected, as_named, "With what would follow.");
  v.number("relative_change", derived_quantity.relative_change(), io::key_units::ratio,
           "As printed over as corrected, less 1.");
}

void describe_finding(io::Visitor& v, const design::Finding& finding) {
  v.word("kind", to_string(finding.kind),
         {to_string(FindingKind::conversion), to_string(FindingKind::derivation),
          to_string(FindingKind::restatement)},
         "What does not agree: columns of one statement, a derived number with its inputs, an "
         "input printed twice.");
  v.text("id", finding.id, "The quantity.");
  v.text("description", finding.description, "The quantity in words.");
  v.text("unit", finding.unit, "SI unit of the forms' numbers.");
  v.text("source", finding.source, "Where it is printed.");
  v.list("forms", finding.forms, "Each printed form that departs.",
         [&](const design::DepartingForm& form) { describe_form(v, form); }, {.minimum = 1});
  v.flag("within_parents_rounding", finding.within_parents_rounding,
         "The rounding of what it is computed from could hide it.");
  v.texts("explanations", finding.explanations, "What would make it follow.");
  v.texts("evidence", finding.evidence, "What speaks for one column.");
  v.list("derived_quantities", finding.derived_quantities,
         "Headline results that it moves, most first.",
         [&](const design::DerivedQuantity& one) { describe_derived_quantity(v, one); });
}

void describe_implausible(io::Visitor& v, const Implausibility& one) {
  v.word("check", one.check,
         {"inertia remainder",
          "friction slope",
          "friction against the supply",
          "friction tests",
          "return pressure",
          "wave speed",
          "structural bound",
          "impulse order",
          "resonance expected",
          "resonance damping",
          "recorder limit",
          "Coulomb levels",
          "coincidence",
          "carrier frequency",
          "valve stroke",
          "inertia against the dish",
          "flywheel",
          "structural predictions",
          "structural fractions",
          "motors held",
          "gear stiffness",
          "ensemble range"},
         "The check.");
  v.text("id", one.id, "The quantity.");
  v.text("reasoning", one.reasoning, "One sentence with the numbers in it.");
  v.list("numbers", one.numbers, "What the reason rests on.",
         [&](const design::CheckedNumber& number) {
           v.text("name", number.name, "What it is.");
           v.number("value", number.value, as_named, "In `unit`, which is SI or Hz.");
           v.text("unit", number.unit, "Its unit.");
         });
}

}  // namespace

void describe(io::Visitor& v, const AuditReport& report) {
  v.defined_as("audit",
               "Printed numbers that do not follow from each other, and inputs that contradict "
               "physics. Numbers whose key ends in _si are in the SI unit that `unit` names (Hz "
               "for frequencies).");
  v.count("checked_numbers", report.checked, "Printed numbers that were compared with something.");
  v.list("findings", report.findings, "Numbers that do not follow.",
         [&](const design::Finding& finding) { describe_finding(v, finding); });
  v.list("implausible", report.implausible, "Physical checks that fail.",
         [&](const Implausibility& one) { describe_implausible(v, one); });
  v.list("remarks", report.remarks, "The case writer's own.", [&](const Remark& remark) {
    v.text("place", remark.place, "Where in the source.");
    v.text("text", remark.text, "What is there.");
  });
}

}  // namespace boresight::app
