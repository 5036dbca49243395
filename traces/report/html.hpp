// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace parallax {

/// `text` as it may stand in HTML, also in an attribute's double quotes.
std::string escaped(std::string_view text);

/// A word with its meaning on hover; the word alone where nothing explains it.
std::string term(std::string_view word, std::string_view meaning);

/// "data:<type>;base64,..."
std::string data_uri(std::string_view type, const std::vector<unsigned char>& bytes);

/// A table of HTML. Cells and headings are HTML already.
class Table {
 public:
  explicit Table(std::string caption, const std::vector<std::string>& headings,
                 const std::string& classes = "");
  /// `attributes`: of the row, such as `id="stage-census"`.
  void row(const std::vector<std::string>& cells, std::string_view attributes = "");
  bool empty() const { return rows_.empty(); }
  std::string html() const;

 private:
  std::string head_;
  std::string rows_;
};

/// A part of the page that the navigation leads to.
std::string section(std::string_view id, std::string_view title, std::string_view content);

/// A frame that report.js draws a chart in; `label` says what it shows, for those who do not see it.
std::string canvas(std::string_view id, std::string_view label, bool tall = false);

}  // namespace parallax
