#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/edited_case.hpp"
#include <boresight/app/document/document_html.hpp>
#include <boresight/app/document/document_text.hpp>
#include <boresight/app/redesign/assumed_inputs.hpp>
#include <boresight/app/redesign/sections.hpp>
#include <boresight/app/report/text_report.hpp>
#include <boresight/io/case/case_file.hpp>

namespace boresight::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// What a strict reader of XML finds in HTML; throws at the first offence.
class StrictHtml {
 public:
  explicit StrictHtml(std::string_view html) : rest_(html) {
    while (!rest_.empty()) {
      if (rest_.front() == '<') {
        read_tag();
      } else {
        const std::string text = unescaped(take(rest_.find('<')));
        if (!cells.empty() && in_cell_) cells.back() += text;
        all_text += text;
      }
    }
    if (!open_.empty()) throw std::runtime_error("not closed: " + open_.back());
  }

  std::vector<std::string> ids;
  std::vector<std::string> cells;  // of all tables, in order
  std::map<std::string, int> tags;
  std::string all_text;

 private:
  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  static std::string unescaped(std::string_view text) {
    static const std::map<std::string_view, char> entities{
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}};
    std::string plain;
    while (!text.empty()) {
      std::size_t length = 1;
      if (text.front() == '&') {
        length = text.find(';') + 1;
        plain += entities.at(text.substr(0, length));
      } else if (text.front() == '>' || text.front() == '"' || text.front() == '\'' ||
                 (static_cast<unsigned char>(text.front()) < 0x20U && text.front() != '\n')) {
        throw std::runtime_error("not escaped: " + std::string(text));
      } else {
        plain += text.front();
      }
      text.remove_prefix(length);
    }
    return plain;
  }

  void read_tag() {
    const std::string_view tag = take(rest_.find('>') + 1);
    if (tag.starts_with("</")) {
      const std::string name(tag.substr(2, tag.size() - 3));
      if (open_.empty() || open_.back() != name) throw std::runtime_error("closes: " + name);
      open_.pop_back();
      in_cell_ = false;
      return;
    }
    std::string_view inside = tag.substr(1, tag.size() - 2);
    const std::string name(inside.substr(0, inside.find(' ')));
    inside.remove_prefix(name.size());
    while (!inside.empty()) {
      const std::size_t equal = inside.find("=\"");
      const std::size_t end = inside.find('"', equal + 2);
      if (inside.front() != ' ' || end == std::string_view::npos) {
        throw std::runtime_error("attributes of " + std::string(tag));
      }
      const std::string_view value = inside.substr(equal + 2, end - equal - 2);
      if (inside.substr(1, equal - 1) == "id") ids.push_back(unescaped(value));
      inside.remove_prefix(end + 1);
    }
    open_.push_back(name);
    ++tags[name];
    in_cell_ = name == "td" || name == "th";
    if (in_cell_) cells.emplace_back();
  }

  std::string_view rest_;
  std::vector<std::string> open_;
  bool in_cell_ = false;
};

// Cells of all tables, short rows filled to the widest.
std::vector<std::string> cells_of(const Document& document) {
  std::vector<std::string> cells;
  for (const Block& block : document.blocks) {
    const auto* table = std::get_if<Table>(&block.content);
    if (table == nullptr) continue;
    std::size_t columns = 0;
    for (const auto& row : table->rows) columns = std::max(columns, row.size());
    for (auto row : table->rows) {
      row.resize(columns);
      cells.insert(cells.end(), row.begin(), row.end());
    }
  }
  return cells;
}

std::string words_of(std::string_view text) {
  std::string words;
  for (const char c : text) {
    if (c != ' ' && c != '\n' && c != '-') words += c;
  }
  return words;
}

Document real_report() {
  const io::Case antenna = io::read_case(case_path("dss14-70m"));
  Report report;
  report.command = "model";
  report.title = antenna.title;
  report.axis = io::pointing_axis(antenna);
  report.assumed = assumed_inputs(antenna);
  report.identification = identify(antenna, {});
  report.plant = describe_plant(antenna);
  report.conclusions = {"Less <than> it & \"more\" isn't."};
  return document_of(report) + document_of(audit_report(antenna)) +
         document_of(audit_report(antenna));
}

TEST(DocumentText, BreaksParagraphsAtBlanksWithin108Columns) {
  const std::string word(35, 'x');
  const std::string text = word + " " + word + "  " + word;
  // 2 + 35 + 1 + 35 + 1 + 34 = 108; a letter more and the third word goes below.
  EXPECT_EQ(to_text(wrapped(text.substr(0, text.size() - 1), "  ")),
            "  " + word + " " + word + " " + word.substr(1) + "\n");
  EXPECT_EQ(to_text(wrapped(text, "  ", "    ")),
            "  " + word + " " + word + "\n      " + word + "\n");
  // Characters count, not bytes; and a word wider than the page is left whole.
  std::string umlauts;
  for (int i = 0; i < 34; ++i) umlauts += "ü";
  EXPECT_EQ(to_text(wrapped(word + " " + word + " " + umlauts, "  ")),
            "  " + word + " " + word + " " + umlauts + "\n");
  EXPECT_EQ(to_text(wrapped("a " + std::string(200, 'y') + " b", "")),
            "a\n" + std::string(200, 'y') + "\nb\n");
  EXPECT_EQ(to_text(wrapped("", "  ")), "");
}

TEST(DocumentText, ShowsTheDecisionThatAPageHasInItsBox) {
  const Document decided = "title\n" + lead({"Do this.", "Not that."}) + heading("Why");
  EXPECT_EQ(to_text(decided), "title\n\n  Do this.\n  Not that.\n\nWhy\n---\n");
  EXPECT_THAT(to_html(decided), Not(HasSubstr("Do this")));
  EXPECT_EQ(to_text(lead({})), "");
  const Document labelled{{{Lead{{{"text that is long", "  ", "     ", "Load"}}}}}};
  EXPECT_EQ(to_text(labelled), "\n  Load text that is long\n");
}

TEST(DocumentText, RulesHeadingsAsWideAsTheirCharacters) {
  EXPECT_EQ(to_text(heading("Über")), "\nÜber\n----\n");
  EXPECT_EQ(to_text(subheading("PI")), "\n  PI\n");
}

TEST(DocumentText, AlignsColumnsByTheirLetters) {
  EXPECT_EQ(to_text(table({{"név", "a", "of b"}, {"x", "12"}, {"longer", "3", "4"}}, "lrr")),
            "  név      a  of b\n"
            "  x       12\n"
            "  longer   3     4\n");
  EXPECT_EQ(to_text(table({{"a", "b"}, {"left", "is"}}, "rl")), "     a  b\n  left  is\n");
}

TEST(Document, KeepsStringsAsTheyAre) {
  Document document = "\n" + heading("A") + "  (1) as is\n";
  document += "  (2) too\n";
  document += Document();
  document += "";
  EXPECT_EQ(document.blocks.size(), 3U);
  EXPECT_EQ(to_text(document + verbatim("end")), "\n\nA\n-\n  (1) as is\n  (2) too\nend");
}

TEST(Document, ShortFormKeepsWhatIsEssential) {
  const Document document = "title\n" + lead({"Do this."}) + heading("All of it") +
                            wrapped("why", "  ") + heading("Gains") + essential(table({{"kr"}})) +
                            "note\n" + essential(verbatim("sum\n")) + "more\n";
  EXPECT_EQ(to_text(short_form(document)), "title\n\n  Do this.\n\nGains\n-----\n  kr\nsum\n");
  EXPECT_THAT(to_text(document), HasSubstr("note\nsum\nmore\n"));
  EXPECT_EQ(to_text(short_form(heading("All of it") + "note\n")), "");
}

TEST(Document, ShortFormCutsShortenedTables) {
  const Document rows = essential(table({{"gain"}, {"kr"}, {"wi"}, {"kp"}, {"wip"}}));
  EXPECT_EQ(to_text(short_form(heading("Gains") + shortened(rows, 2))),
            "\nGains\n-----\n  gain\n  kr\n  wi\n  and 2 more\n");
  // The remark would take the place of the row.
  EXPECT_EQ(to_text(short_form(shortened(rows, 3))), to_text(rows));
  EXPECT_EQ(to_text(shortened(rows, 2)), to_text(rows));
}

TEST(DocumentHtml, WritesEachBlockAsWhatItIs) {
  const Document document = "before\n" + heading("Gains, before & after") + subheading("PI") +
                            table({{"gain", "now"}, {"", "SI"}, {"  K", "1"}, {"T"}}, "l", 2) +
                            wrapped("term  text", "    ", "  ") + "\n  a\n    b\n\n";
  EXPECT_EQ(to_html(document),
            "<div class=\"notes\">\n<pre>before</pre>\n</div>\n"
            "<section id=\"gains\">\n<h2>Gains, before &amp; after</h2>\n<h3>PI</h3>\n"
            "<div class=\"table\"><table>\n<thead>\n"
            "<tr><th scope=\"col\">gain</th><th scope=\"col\" class=\"right\">now</th></tr>\n"
            "<tr><td></td><th scope=\"col\" class=\"right\">SI</th></tr>\n"
            "</thead>\n<tbody>\n"
            "<tr><th scope=\"row\" class=\"nested\">  K</th><td class=\"right\">1</td></tr>\n"
            "<tr><th scope=\"row\">T</th><td class=\"right\"></td></tr>\n"
            "</tbody>\n</table></div>\n"
            "<div class=\"notes\">\n<p class=\"nested\">term  text</p>\n<pre>  a\n    "
            "b</pre>\n</div>\n</section>\n");
  EXPECT_THAT(to_html(table({{"no", "header"}}, "l", 0)), Not(HasSubstr("thead")));
  EXPECT_EQ(to_html(table({}) + wrapped(" ", "") + "\n \n"), "");
}

TEST(DocumentHtml, PutsMoreBehindTheHeadingOrTheFirstTableOfASection) {
  const Document document = heading("A: 1") + wrapped("one", "  ") + heading("B") + "two\n" +
                            table({{"a"}, {"1"}}) + table({{"b"}, {"2"}});
  std::vector<std::string> asked;
  const std::string html = to_html(document, [&](std::string_view title) {
    asked.emplace_back(title);
    return title == "B" ? SectionAdditions{"<aside></aside>\n", "<figure></figure>\n"}
                        : SectionAdditions{{}, "<figure></figure>\n"};
  });
  EXPECT_THAT(asked, ElementsAre("A: 1", "B"));
  const auto table_of = [](std::string_view name, std::string_view value) {
    return fmt::format(
        "<div class=\"table\"><table>\n<thead>\n<tr><th scope=\"col\">{}</th></tr>\n</thead>\n"
        "<tbody>\n<tr><th scope=\"row\">{}</th></tr>\n</tbody>\n</table></div>\n",
        name, value);
  };
  EXPECT_EQ(html,
            "<section id=\"a\">\n<h2>A: 1</h2>\n<figure></figure>\n"
            "<div class=\"notes\">\n<p>one</p>\n</div>\n</section>\n"
            "<section id=\"b\">\n<h2>B</h2>\n<aside></aside>\n"
            "<div class=\"notes\">\n<pre>two</pre>\n</div>\n" +
                table_of("a", "1") + "<figure></figure>\n" + table_of("b", "2") + "</section>\n");
}

TEST(DocumentHtml, GivesEverySectionAnIdOfItsOwn) {
  const Document document = heading("Records") + heading("Records (2)") + heading("records 2") +
                            heading("The case's ¶ own") + heading("¶") + heading("") +
                            heading("Records");
  EXPECT_THAT(StrictHtml(to_html(document)).ids,
              ElementsAre("records", "records-2", "records-2-2", "the-cases-own", "section",
                          "section-2", "records-3"));
}

TEST(DocumentHtml, EscapesWhatCouldBeTakenForMarkup) {
  EXPECT_EQ(escaped_html("<a b=\"c\">&'é\n"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;é\n");
  EXPECT_EQ(escaped_html(std::string_view("\0\x1B\xFFz\xC3", 5)),
            "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBDz\xEF\xBF\xBD");
  const std::string hostile = "</pre></td>\"'<script>alert(1)</script>&amp;";
  const StrictHtml page(to_html(hostile + heading(hostile) + subheading(hostile) +
                                table({{hostile}, {hostile, hostile}}) + wrapped(hostile, "")));
  EXPECT_EQ(page.tags.count("script"), 0U);
  EXPECT_THAT(page.cells, ElementsAre(hostile, "", hostile, hostile));
}

TEST(DocumentHtml, SaysAllThatTheTextSays) {
  Document document = real_report();
  std::erase_if(document.blocks,
                [](const Block& one) { return std::holds_alternative<Lead>(one.content); });
  const StrictHtml page(to_html(document));
  EXPECT_GT(page.tags.at("table"), 4);
  EXPECT_EQ(std::set(page.ids.begin(), page.ids.end()).size(), page.ids.size());
  EXPECT_EQ(page.ids.size(), static_cast<std::size_t>(page.tags.at("h2")));
  EXPECT_EQ(page.cells, cells_of(document));
  EXPECT_EQ(words_of(page.all_text), words_of(to_text(document)));
}

}  // namespace
}  // namespace boresight::app
