#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <boresight/app/page/embedded_files.hpp>
#include <boresight/app/page/html_text.hpp>
#include <boresight/app/page/page.hpp>
#include <boresight/app/page/section_methods.hpp>
#include <boresight/app/report/json_writer.hpp>
#include <boresight/io/description/adjustable_loop_description.hpp>

namespace boresight::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Figure figure_of(const std::string& id, const std::string& section) {
  Figure figure;
  figure.id = id;
  figure.section = section;
  figure.title = "Title of " + id;
  figure.caption = "</script><b>";
  figure.x.label = "frequency";
  FigurePanel panel;
  FigureSeries series;
  series.name = "<script>";
  series.x = {1.0, 2.0, 3.0};
  series.y = {1.0, 4.0, 9.0};
  panel.series.push_back(series);
  figure.panels.push_back(panel);
  return figure;
}

Page page_of_two_sections() {
  Page page;
  page.command = "tune";
  page.title = "A & B <antenna>";
  page.axis = "elevation axis";
  page.seed = 7;
  page.decision = {"Choose <this>."};
  page.reservations = {"If <that> holds."};
  page.document = heading("Tuned loops: PI") + wrapped("First.", "  ") + heading("Assumed inputs") +
                  wrapped("Second.", "  ");
  page.figures = {figure_of("first", "Assumed inputs"), figure_of("second", "Nowhere")};
  return page;
}

const Provenance provenance{"boresight tune 'a b.toml'", {{"a b.toml", 12, io::sha256_hex("abc")}}};

TEST(Page, NoTagBeginsInEmbeddedJson) {
  const nlohmann::json value{{"text", "</script><!-- <script>"}};
  const std::string embedded = json_for_script(value.dump());
  EXPECT_THAT(embedded, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::json::parse(embedded), value);
}

TEST(Page, StyleSheetStringsCannotEndEarly) {
  EXPECT_EQ(css_string("a\"b\\c</style>"), "\"a\\22 b\\5c c\\3c /style>\"");
}

TEST(Page, FiguresStandInTheirSectionsAndNoneIsLost) {
  const std::string html = to_html(page_of_two_sections(), provenance);
  const auto heading_at = html.find("<h2>Assumed inputs");
  const auto first = html.find("id=\"figure-first\""), second = html.find("id=\"figure-second\"");
  const auto text = html.find("Second.");
  const auto further = html.find("<h2>Further figures");
  ASSERT_NE(first, std::string::npos);
  EXPECT_LT(heading_at, first);
  EXPECT_LT(first, text);
  EXPECT_LT(text, further);
  EXPECT_LT(further, second);
  EXPECT_THAT(html, HasSubstr("Figure 1. Title of first."));
  EXPECT_THAT(html, HasSubstr("Figure 2. Title of second."));
}

TEST(Page, GainsStandBesideTheDecisionBeforeEveryFigure) {
  Page page = page_of_two_sections();
  EXPECT_THAT(to_html(page, provenance), Not(HasSubstr("class=\"gains\"")));
  page.gains = subheading("Gains to load: PI") + table({{"gain", "value"}, {"kr <gain>", "0.38"}});
  const std::string html = to_html(page, provenance);
  const auto decision = html.find("Choose &lt;this&gt;."), gains = html.find("kr &lt;gain&gt;");
  ASSERT_NE(gains, std::string::npos);
  EXPECT_LT(decision, gains);
  EXPECT_LT(gains, html.find("<nav"));
  EXPECT_LT(gains, html.find("<figure"));
}

TEST(Page, KeepsEachGainOfTheCardOnOneLine) {
  Page page = page_of_two_sections();
  page.card = {{"Load", "PI: kr = 0.38, wi = 0.22 rad/s", "Tuned loops"}};
  EXPECT_THAT(to_html(page, provenance),
              HasSubstr("PI: kr&#160;=&#160;0.38, wi&#160;=&#160;0.22 rad/s <span>Tuned loops"));
}

TEST(Page, SaysHowItWasMade) {
  const std::string html = to_html(page_of_two_sections(), provenance);
  EXPECT_THAT(html, HasSubstr("boresight tune &#39;a b.toml&#39;"));
  EXPECT_THAT(html, HasSubstr(io::sha256_hex("abc")));
  EXPECT_THAT(html, HasSubstr("design/tuning/tuner.hpp"));
  EXPECT_THAT(html, HasSubstr("<td>7</td>"));
  EXPECT_EQ(html, to_html(page_of_two_sections(), provenance));
}

TEST(Page, TextOfOthersIsEscaped) {
  const std::string html = to_html(page_of_two_sections(), provenance);
  EXPECT_THAT(html, HasSubstr("A &amp; B &lt;antenna&gt;"));
  EXPECT_THAT(html, HasSubstr("Choose &lt;this&gt;."));
  EXPECT_THAT(html, HasSubstr("<li>If &lt;that&gt; holds.</li>"));
  EXPECT_THAT(html, Not(HasSubstr("<antenna>")));
  EXPECT_THAT(html, Not(HasSubstr("</script><b>")));
}

TEST(Page, OnlyItsOwnScriptsMayRun) {
  const std::string html = to_html(page_of_two_sections(), provenance);
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  if (plotting_library().empty()) {
    EXPECT_THAT(html, HasSubstr("script-src 'none'"));
    EXPECT_THAT(html, HasSubstr("figures are static"));
  } else {
    EXPECT_THAT(html, HasSubstr("'sha256-" + io::sha256_base64(figures_script()) + "'"));
    EXPECT_THAT(html, HasSubstr("'sha256-" + io::sha256_base64(plotting_library()) + "'"));
  }
  Page still = page_of_two_sections();
  still.figures.clear();
  EXPECT_THAT(to_html(still, provenance), HasSubstr("script-src 'none'"));
}

// A loop of three gains whose plant has no friction.
std::string loop_without_friction() {
  design::AdjustableLoop loop;
  loop.structure = "PI";
  loop.controller = {
      control::LoopStructure("three", {{control::LoopPath::rate,
                                        control::BlockKind::gain,
                                        {{"rate <gain>", "kr", "1", 0.1, 1.0}}},
                                       {control::LoopPath::rate,
                                        control::BlockKind::integral,
                                        {{"corner", "wi", "rad/s", 0.1, 1.0}}},
                                       {control::LoopPath::position,
                                        control::BlockKind::gain,
                                        {{"position gain", "kp", "1/s", 0.1, 1.0}}}}),
      {0.2, 0.8, 0.3}};
  loop.problem.wind.mean_speed = 10.0;
  loop.problem.plant.drive.oil_stiffness = 50.0;
  loop.problem.plant.drive.leakage_rate = 1.2;
  return json_of(loop).dump();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Page, SlidersOverGainsStandFirstAndRunByTheirDigest) {
  Page page = page_of_two_sections();
  const std::string digest = "'sha256-" + io::sha256_base64(loop_sliders_script()) + "'";
  EXPECT_THAT(to_html(page, provenance), Not(HasSubstr(digest)));
  page.adjustable_loop = loop_without_friction();
  const std::string html = to_html(page, provenance);
  EXPECT_THAT(html, HasSubstr(digest));
  EXPECT_LT(html.find("id=\"change-gains\""), html.find("<h2>Tuned loops"));
  EXPECT_THAT(html, HasSubstr("rate &lt;gain&gt;"));
}

TEST(Page, SlidersAreOneAGainAndOneANumberOfTheDriveThatIsNotZero) {
  Page page = page_of_two_sections();
  page.adjustable_loop = loop_without_friction();
  const std::string html = to_html(page, provenance);
  EXPECT_EQ(count(html, " data-gain=\""), 3U);
  EXPECT_EQ(count(html, " data-setting=\""), 3U);
  EXPECT_THAT(html, Not(HasSubstr("data-setting=\"viscous_friction\"")));
}

TEST(Page, AnInterruptIsSaidAtTheTop) {
  Page page = page_of_two_sections();
  EXPECT_THAT(to_html(page, provenance), Not(HasSubstr("others are missing")));
  page.interrupted = true;
  EXPECT_THAT(to_html(page, provenance), HasSubstr("others are missing"));
}

TEST(SectionMethods, AreFoundByTheBeginningOfAHeading) {
  EXPECT_EQ(method_of("Inertia matching").explained_in, "docs/matching.md");
  EXPECT_EQ(method_of("Inertia matching: re-tuned at each motor inertia").explained_in,
            "design/tuning/design_study.hpp");
  EXPECT_TRUE(method_of("Nothing known").how.empty());
}

}  // namespace
}  // namespace boresight::app
