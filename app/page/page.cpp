#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <boresight/app/document/document_html.hpp>
#include <boresight/app/figures/figure_json.hpp>
#include <boresight/app/figures/figure_svg.hpp>
#include <boresight/app/page/embedded_files.hpp>
#include <boresight/app/page/html_text.hpp>
#include <boresight/app/page/loop_sliders_panel.hpp>
#include <boresight/app/page/page.hpp>
#include <boresight/app/page/section_methods.hpp>
#include <boresight/app/page/what_if_panel.hpp>

namespace boresight::app {
namespace {

/// A heading of the page, as the contents list it.
struct Section {
  std::string id, title;  // title: HTML
};

// The headings of HTML that to_html(Document) wrote.
std::vector<Section> sections_of(std::string_view html) {
  constexpr std::string_view open = "<section id=\"", title = "<h2>", close = "</h2>";
  std::vector<Section> sections;
  for (auto at = html.find(open); at != std::string_view::npos; at = html.find(open, at)) {
    at += open.size();
    const auto id_end = html.find('"', at);
    const auto begin = html.find(title, id_end) + title.size();
    const auto end = html.find(close, begin);
    sections.push_back(
        {std::string(html.substr(at, id_end - at)), std::string(html.substr(begin, end - begin))});
  }
  return sections;
}

// Of a drawing, as its first attribute of that name has it: the style sheet keeps letters large
// enough by it.
std::string_view width_of(std::string_view svg) {
  constexpr std::string_view attribute = " width=\"";
  const auto begin = svg.find(attribute) + attribute.size();
  return svg.substr(begin, svg.find('"', begin) - begin);
}

std::string figure_html(const Figure& figure, std::size_t number) {
  const std::string svg = to_svg(figure);
  std::string html = fmt::format(
      "<figure class=\"plot\" id=\"figure-{}\" tabindex=\"0\" aria-label=\"Figure {}: {}\" "
      "style=\"--drawing: {}\">\n"
      "<div class=\"canvas\"><div class=\"static\">{}</div>{}</div>\n",
      figure.id, number, escaped_html(figure.title), width_of(svg), svg,
      plotting_library().empty() ? "" : "<div class=\"live\"></div>");
  if (!plotting_library().empty()) {
    html += fmt::format(
        "<div class=\"controls\"><button type=\"button\" class=\"explore\" hidden=\"\">Explore"
        "</button><p class=\"reading\" aria-live=\"polite\"></p></div>\n"
        "<script type=\"application/json\" class=\"data\">{}</script>\n",
        json_for_script(figures_json({figure}).at(0).dump()));
  }
  return html + fmt::format("<figcaption><b>Figure {}. {}.</b> {}</figcaption>\n</figure>\n",
                            number, escaped_html(figure.title), escaped_html(figure.caption));
}

/// Places figures in the sections that they name, each once.
class FigurePlacer {
 public:
  explicit FigurePlacer(const std::vector<Figure>& figures) : figures_(figures) {}

  std::string of(std::string_view heading) {
    std::string html;
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      if (!figures_[i].section.empty() && heading.starts_with(figures_[i].section))
        html += place(i);
    }
    return html;
  }

  std::string others() {
    std::string html;
    for (std::size_t i = 0; i < figures_.size(); ++i) html += place(i);
    return html;
  }

 private:
  std::string place(std::size_t i) {
    if (!placed_.insert(i).second) return {};
    return figure_html(figures_[i], placed_.size());
  }

  const std::vector<Figure>& figures_;
  std::set<std::size_t> placed_;
};

std::string methods_html(const Document& document) {
  std::string rows;
  for (const auto& block : document.blocks) {
    const auto* heading = std::get_if<Heading>(&block.content);
    if (heading == nullptr) continue;
    const SectionMethod method = method_of(heading->title);
    if (method.how.empty()) continue;
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td><code>{}</code></td></tr>\n",
                        escaped_html(heading->title), escaped_html(method.how),
                        escaped_html(method.explained_in));
  }
  if (rows.empty()) return {};
  return "<h3>Methods</h3>\n<div class=\"table\"><table>\n<thead><tr><th "
         "scope=\"col\">section</th><th scope=\"col\">method</th><th "
         "scope=\"col\">documentation</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody>\n</table></div>\n";
}

std::string inputs_html(const std::vector<io::InputFile>& inputs) {
  std::string html =
      "<h3>Inputs</h3>\n<p>Every file read; <code>sha256sum</code> reproduces the "
      "digests.</p>\n<div class=\"table\"><table>\n<thead><tr><th scope=\"col\">file</th><th "
      "scope=\"col\" class=\"right\">bytes</th><th "
      "scope=\"col\">SHA-256</th></tr></thead>\n<tbody>\n";
  for (const auto& input : inputs) {
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"right\">{}</td><td class=\"digest\">{}</td></tr>"
        "\n",
        escaped_html(input.path), input.bytes, input.sha256);
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string provenance_html(const Page& page, const Provenance& provenance) {
  std::string html = fmt::format(
      "<section id=\"how-each-number-was-made\"><h2>How each number was made</h2>\n<div "
      "class=\"table\"><table><tbody>\n<tr><th scope=\"row\">program</th><td>Boresight "
      "{}</td></tr>\n<tr><th scope=\"row\">command line</th><td><code>{}</code></td></tr>\n<tr><th "
      "scope=\"row\">seed</th><td>{}</td></tr>\n</tbody></table></div>\n<p>The same inputs, seed "
      "and program give the same numbers, for any number of threads.</p>\n",
      BORESIGHT_VERSION, escaped_html(provenance.command_line), page.seed);
  html += inputs_html(provenance.inputs);
  html += methods_html(page.document);
  if (plotting_library().empty() && !page.figures.empty()) {
    html += "<p>Built without the plotting library: figures are static.</p>\n";
  }
  return html + "</section>\n";
}

std::string contents_html(const std::vector<Section>& sections) {
  std::string html = "<nav aria-labelledby=\"contents\"><h2 id=\"contents\">Contents</h2>\n<ol>\n";
  for (const auto& section : sections) {
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section.id, section.title);
  }
  return html + "</ol></nav>\n";
}

std::string header_html(const Page& page) {
  std::string html =
      fmt::format("<header>\n<p class=\"program\">Boresight {} &#183; {}</p>\n<h1>{}</h1>\n",
                  BORESIGHT_VERSION, escaped_html(page.command), escaped_html(page.title));
  if (!page.axis.empty()) {
    html += fmt::format("<p class=\"axis\">{}</p>\n", escaped_html(page.axis));
  }
  if (page.interrupted) {
    html +=
        "<p class=\"interrupted\">Interrupted: the results below are complete, others are "
        "missing.</p>\n";
  }
  return html + "</header>\n";
}

// Quantities "kr = 1.34" stay on one line.
std::string card_html(const std::vector<CardLine>& card) {
  if (card.empty()) return {};
  std::string html = "<table class=\"card\">\n";
  for (const auto& line : card) {
    std::string text = escaped_html(line.text);
    constexpr std::string_view equals = " = ";
    for (auto at = text.find(equals); at != std::string::npos; at = text.find(equals, at)) {
      text.replace(at, equals.size(), "&#160;=&#160;");
    }
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{} <span>{}</span></td></tr>\n",
                        escaped_html(line.label), text, escaped_html(line.evidence));
  }
  return html + "</table>\n";
}

// The card or the decision first, the gains to load beside it, conditions last.
std::string decision_html(const Page& page) {
  if (page.decision.empty()) return {};
  std::string html =
      "<div class=\"decision\" role=\"region\" aria-labelledby=\"decision\">"
      "<h2 id=\"decision\">The decision</h2>\n<div class=\"answer\">\n" +
      card_html(page.card);
  for (const auto& sentence : page.decision) {
    html += fmt::format("<p>{}</p>\n", escaped_html(sentence));
  }
  html += "</div>\n";
  if (const auto gains = to_html(page.gains); !gains.empty()) {
    html += "<div class=\"gains\">\n" + gains + "</div>\n";
  }
  if (!page.reservations.empty()) {
    html += "<div class=\"conditions\"><h3>Conditions</h3>\n<ul>\n";
    for (const auto& sentence : page.reservations) {
      html += fmt::format("<li>{}</li>\n", escaped_html(sentence));
    }
    html += "</ul></div>\n";
  }
  return html + "</div>\n";
}

std::string script_html(std::string_view script) {
  return fmt::format("<script>{}</script>\n", script);
}

// Without the lines before the first heading, which name what the page's header and its last
// section do.
Document sections_only(const Document& document) {
  const auto first = std::ranges::find_if(document.blocks, [](const Block& block) {
    return std::holds_alternative<Heading>(block.content);
  });
  return {{first, document.blocks.end()}};
}

// Nothing is fetched, sent or run but the scripts here, by their digests.
std::string security_policy(const std::vector<std::string_view>& scripts) {
  std::string policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; ";
  policy += "base-uri 'none'; form-action 'none'; script-src";
  if (scripts.empty()) policy += " 'none'";
  for (const auto script : scripts)
    policy += fmt::format(" 'sha256-{}'", io::sha256_base64(script));
  return policy;
}

}  // namespace

std::string to_html(const Page& page, const Provenance& provenance) {
  FigurePlacer placer(page.figures);
  std::string what_if = page.what_if.empty() ? std::string() : what_if_panel(page.what_if);
  std::string main;
  if (!page.adjustable_loop.empty()) {
    main = "<section id=\"change-gains\"><h2>Change gains, wind and drive</h2>\n" +
           loop_sliders_panel(page.adjustable_loop) + "</section>\n";
  }
  main += to_html(sections_only(page.document), [&](std::string_view heading) {
    SectionAdditions additions{{}, placer.of(heading)};
    if (heading.starts_with("Inertia matching")) std::swap(additions.behind_heading, what_if);
    return additions;
  });
  if (!what_if.empty()) {
    main += "<section id=\"what-if\"><h2>What if</h2>\n" + what_if + "</section>\n";
  }
  if (const auto others = placer.others(); !others.empty()) {
    main += "<section id=\"further-figures\"><h2>Further figures</h2>\n" + others + "</section>\n";
  }
  main += provenance_html(page, provenance);

  const bool live = !plotting_library().empty() && !page.figures.empty();
  std::vector<std::string_view> scripts;
  if (live) {
    scripts.push_back(figures_script());
    scripts.push_back(plotting_library());
  }
  if (!page.what_if.empty()) scripts.push_back(what_if_script());
  if (!page.adjustable_loop.empty()) scripts.push_back(loop_sliders_script());

  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"Boresight {}\">\n<title>{}: {}</title>\n",
      security_policy(scripts), BORESIGHT_VERSION, escaped_html(page.title),
      escaped_html(page.command));
  html += fmt::format(
      "<style>\n{}\n@media print {{ @page {{ @bottom-left {{ content: {}; font: 8pt \"Liberation "
      "Sans\", Arial, sans-serif; color: #555; }} }} }}\n</style>\n</head>\n<body>\n",
      page_style(), css_string("Boresight " + page.command + ": " + page.title));
  html += "<a class=\"skip\" href=\"#report\">Skip to the report</a>\n<div class=\"page\">\n";
  html += header_html(page) + decision_html(page) + contents_html(sections_of(main));
  html += "<main id=\"report\">\n" + main + "</main>\n";
  html += fmt::format("<footer><p>Boresight {} {}, seed {}.</p></footer>\n</div>\n",
                      BORESIGHT_VERSION, escaped_html(page.command), page.seed);
  if (live) {
    html += fmt::format("<script type=\"text/plain\" id=\"plotting-library\">{}</script>\n",
                        plotting_library());
    html += script_html(figures_script());
  }
  if (!page.what_if.empty()) html += script_html(what_if_script());
  if (!page.adjustable_loop.empty()) html += script_html(loop_sliders_script());
  return html + "</body>\n</html>\n";
}

}  // namespace boresight::app
