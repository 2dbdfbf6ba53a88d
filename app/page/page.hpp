#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boresight/app/document/document.hpp>
#include <boresight/app/figures/figure.hpp>
#include <boresight/app/report/redesign_card.hpp>
#include <boresight/io/files/input_files.hpp>

namespace boresight::app {

/// A report as a page has it.
struct Page {
  std::string command;  // "redesign"
  std::string title;    // of the antenna
  std::string axis;     // words_beside the title; may be empty
  std::uint64_t seed = 1;
  bool interrupted = false;
  /// A redesign's card, before the decision in a few sentences.
  std::vector<CardLine> card;
  /// Gains to load, before every figure; empty for none (gains_to_load.hpp).
  Document gains;
  /// The decision, in a few sentences.
  std::vector<std::string> decision;
  /// Assumptions and open questions of the decision, in smaller type below it.
  std::vector<std::string> reservations;
  Document document;  // the report's text
  std::vector<Figure> figures;
  /// JSON of the table behind the matching sliders (what_if_description.hpp); empty: none.
  std::string what_if;
  /// JSON of the loop behind the sliders over gains (adjustable_loop_description.hpp); empty: none.
  std::string adjustable_loop;
};

/// How a page was made: enough to make it again, and to see that it is of the same inputs.
struct Provenance {
  std::string command_line;
  std::vector<io::InputFile> inputs;
};

/// One HTML file without references to any other: header, decision with the gains to load,
/// contents, the document's sections with each figure in the one that it names, behind that
/// section's first table (in a section of their own where no heading is theirs), how each number
/// was made. Complete without scripts; with them figures can be explored, if the program has the
/// plotting library in it (plotting_library()). The same input gives the same bytes. @throws
/// InvalidInput as to_svg.
std::string to_html(const Page& page, const Provenance& provenance);

}  // namespace boresight::app
