#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <boresight/app/document/document.hpp>

namespace boresight::app {

/// Text as it may stand between tags and in quoted attributes: & < > " and ' escaped; control
/// characters other than line end and tab, and bytes that are not UTF-8, as U+FFFD.
std::string escaped_html(std::string_view text);

/// More HTML for a section; empty for none.
struct SectionAdditions {
  std::string behind_heading = {};
  /// Behind the section's first table, so that its figures follow its numbers; behind the heading's
  /// addition where it has none.
  std::string behind_first_table = {};
};

/// What a section gets, by its title as the heading has it.
using AdditionsOf = std::function<SectionAdditions(std::string_view title)>;

/// The document as the inside of a page's <body> or <main>: HTML that is well-formed XML too.
/// - Each heading opens <section id="..."> with <h2>, and the additions stand in it as they are;
///   what comes before the first heading stands in no section. The id is the title up to its
///   first colon, comma or bracket in small letters and hyphens, so that it does not depend on the
///   numbers that follow there; sections of the same one get -2, -3 ... behind it, in order.
/// - Subheadings are <h3>, paragraphs <p>, with class "nested" where deeper indented than others.
///   Paragraphs and verbatim text that follow one another stand in one <div class="notes">.
/// - Tables are <div class="table"><table> with <thead> of <th scope="col"> and <tbody> of rows
/// whose
///   first cell is <th scope="row">; empty cells are <td>, short rows are filled with them. Cells
///   of columns to the right have class "right", those indented class "nested".
/// - Verbatim text is <pre>, without blank lines around it.
std::string to_html(const Document& document, const AdditionsOf& additions_of = {});

}  // namespace boresight::app
