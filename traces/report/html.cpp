// SPDX-License-Identifier: Apache-2.0
#include "traces/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "traces/json_text.hpp"

namespace parallax {

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : valid_utf8(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string term(std::string_view word, std::string_view meaning) {
  if (meaning.empty()) return escaped(word);
  return fmt::format("<abbr title=\"{}\">{}</abbr>", escaped(meaning), escaped(word));
}

std::string data_uri(std::string_view type, const std::vector<unsigned char>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = fmt::format("data:{};base64,", type);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

Table::Table(std::string caption, const std::vector<std::string>& headings, const std::string& classes) {
  head_ = fmt::format("<div class=\"scroll\"><table class=\"{}\">", classes);
  if (!caption.empty()) head_ += fmt::format("<caption>{}</caption>", caption);
  head_ += "<thead><tr>";
  for (const std::string& heading : headings) head_ += fmt::format("<th scope=\"col\">{}</th>", heading);
  head_ += "</tr></thead><tbody>\n";
}

void Table::row(const std::vector<std::string>& cells, std::string_view attributes) {
  rows_ += fmt::format("<tr{}{}>", attributes.empty() ? "" : " ", attributes);
  for (std::size_t i = 0; i < cells.size(); ++i)
    rows_ += fmt::format(i == 0 ? "<th scope=\"row\">{}</th>" : "<td>{}</td>", cells[i]);
  rows_ += "</tr>\n";
}

std::string Table::html() const { return head_ + rows_ + "</tbody></table></div>\n"; }

std::string section(std::string_view id, std::string_view title, std::string_view content) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escaped(title), content);
}

std::string canvas(std::string_view id, std::string_view label, bool tall) {
  return fmt::format(
      "<div class=\"chart{} script-only\"><canvas id=\"{}\" role=\"img\" aria-label=\"{}\"></canvas></div>\n",
      tall ? " tall" : "", id, escaped(label));
}

}  // namespace parallax
