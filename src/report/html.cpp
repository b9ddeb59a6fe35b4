#include "report/html.hpp"

#include <fmt/format.h>

#include "codec/utf8.hpp"
#include "picture/colour.hpp"
#include "picture/number.hpp"

namespace sweepface::html {
namespace {

constexpr std::string_view kStyle = R"(
:root { --ink: #24262b; --soft: #6b6f78; --line: #dcdad6; --paper: #f4f2f0; --blue: #1a6aa8; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1080px; padding: 0 20px 60px; color: var(--ink); background: #fff; overflow-wrap: anywhere;
  font: 16px/1.55 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 2.2rem 0 .3rem; }
h2 { font-size: 1.3rem; margin: 3rem 0 .4rem; padding-top: .8rem; border-top: 1px solid var(--line); }
p { max-width: 46rem; }
.lead { color: var(--soft); margin-top: 0; }
.facts, .row, .times { display: grid; gap: 12px; margin: 18px 0; }
.facts { grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); }
.facts div { background: var(--paper); border-radius: 8px; padding: 12px 14px; }
.facts b { display: block; font-size: 1.45rem; line-height: 1.25; }
.facts span { color: var(--soft); font-size: .86rem; }
.row { grid-template-columns: 1fr 1fr; }
.row svg { max-width: 520px; }
.row.four { grid-template-columns: repeat(4, 1fr); }
.times { grid-template-columns: repeat(6, 1fr); gap: 6px; }
figure { margin: 0; background: var(--paper); border-radius: 8px; overflow: hidden; }
figure img { display: block; width: 100%; height: auto; }
figcaption { padding: 6px 12px 10px; color: var(--soft); font-size: .86rem; }
.times div { display: grid; gap: 6px; }
.times figcaption { padding: 3px 6px 6px; font-size: .75rem; }
.wide { overflow-x: auto; margin: 18px 0; }
table { border-collapse: collapse; font-size: .88rem; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 10px; text-align: right; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
thead th { border-bottom: 2px solid var(--ink); vertical-align: bottom; }
tr.strong td { font-weight: 600; border-bottom: 2px solid var(--ink); }
svg { display: block; width: 100%; max-width: 600px; height: auto; font: 13px system-ui, "Segoe UI", Roboto, sans-serif; }
.wide svg { width: auto; max-width: none; }
.scale { max-width: 460px; margin: 14px auto; font-size: .82rem; color: var(--soft); text-align: center; }
.scale i { display: block; height: 14px; border-radius: 3px; }
.scale span { display: flex; justify-content: space-between; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 22px; justify-content: center; font-size: .86rem; margin: 10px 0; }
.legend i { display: inline-block; width: 26px; height: 4px; border-radius: 2px; margin-right: 8px; vertical-align: middle; }
@media (max-width: 620px) {
  body { font-size: 15px; padding: 0 14px 40px; }
  .times { grid-template-columns: repeat(3, 1fr); }
  .row.plots { grid-template-columns: 1fr; }
  .row.four { grid-template-columns: 1fr 1fr; }
  th, td { padding: 4px 8px; }
}
@media (prefers-reduced-motion: reduce) {
  .law i { animation: none !important; }
  .moving { display: none; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10.5pt; }
  h2 { break-after: avoid; margin-top: 1.6rem; }
  figure, svg, tr, .facts, .law { break-inside: avoid; }
  figure, .facts div, .scale i, .legend i, .law i { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  .wide { overflow: visible; }
  table { font-size: 8.5pt; }
  th, td { padding: 2px 6px; }
}
)";

std::string cells(const std::vector<std::string>& texts, std::string_view tag) {
  std::string row;
  for (const std::string& text : texts) row += fmt::format("<{0}>{1}</{0}>", tag, escaped(text));
  return row;
}

}  // namespace

std::string escaped(std::string_view text) {
  const bool isUtf8 = codec::isUtf8(text);
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (isUtf8 || c == '\n' || (c >= ' ' && c < 0x7f))
          result += c;
        else
          result += "\uFFFD";
    }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto byte = [&](std::size_t i) -> unsigned {
      return k + i < bytes.size() ? static_cast<unsigned char>(bytes[k + i]) : 0u;
    };
    const unsigned word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t i = 0; i < 4; ++i)
      text += k + i <= bytes.size() ? digits[word >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

std::string hex(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", toByte(colour.r), toByte(colour.g), toByte(colour.b));
}

Result<std::string> figure(const Image& image, std::string_view caption) {
  const Result<std::string> png = encodePng(image);
  if (!png) return std::unexpected(png.error());
  return fmt::format(
      "<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">"
      "<figcaption>{}</figcaption></figure>\n",
      image.width, image.height, escaped(caption), base64(*png), escaped(caption));
}

Table::Table(const std::vector<std::string>& head) : head_(cells(head, "th")) {}

void Table::add(const std::vector<std::string>& row, bool strong) {
  body_ += fmt::format("<tr{}>{}</tr>\n", strong ? " class=\"strong\"" : "", cells(row, "td"));
}

std::string Table::html() const {
  return fmt::format(
      "<div class=\"wide\"><table><thead><tr>{}</tr></thead><tbody>\n{}</tbody></table></div>\n",
      head_, body_);
}

std::string scale(double top, std::string_view title) {
  std::string stops;
  for (int k = 0; k <= 28; ++k) stops += ", " + hex(heatColour(k / 28.0));
  std::string ticks;
  for (int k = 0; k <= 4; ++k) ticks += "<b>" + number(top * k / 4) + "</b>";
  return fmt::format(
      "<div class=\"scale\">{}<i style=\"background: linear-gradient(to right{})\"></i>"
      "<span>{}</span></div>\n",
      escaped(title), stops, ticks);
}

std::string legend(const std::vector<Key>& keys) {
  std::string items;
  for (const Key& key : keys)
    items += fmt::format("<span><i style=\"background: {}\"></i>{}</span>", hex(key.colour),
                         escaped(key.text));
  return fmt::format("<div class=\"legend\">{}</div>\n", items);
}

std::string page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>{}</style>\n</head>\n"
      "<body>\n{}</body>\n</html>\n",
      escaped(title), kStyle, body);
}

}  // namespace sweepface::html
