// SPDX-License-Identifier: MIT
#include "tools/view/page.h"

#include <fmt/format.h>

#include "tools/view/page_parts.h"

namespace grove {
namespace {

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      default:
        html += c;
    }
  return html;
}

}  // namespace

// The policy allows what is in the page and nothing else: no requests, no scripts of others.
std::string page(std::string_view title, std::string_view data) {
  return fmt::format(
      R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<title>{}</title>
<style>{}</style>
</head>
<body>
<noscript>This page is a program: it needs JavaScript.</noscript>
<script type="application/json" id="grove-data">{}</script>
<script>{}</script>
</body>
</html>
)",
      escaped(title), page_style(), data, page_program());
}

}  // namespace grove
