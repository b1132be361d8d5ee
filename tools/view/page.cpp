// SPDX-License-Identifier: MIT
#include "tools/view/page.h"

#include <fmt/format.h>

#include <initializer_list>

#include "tools/view/page_parts.h"

namespace grove::detail {
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

// Escapes every '<', so that no text can end the <script> element. JSON has '<' only in strings.
std::string without_markup(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

// Every page has a script element with data, whose id begins so.
constexpr std::string_view kDataElement = "<script type=\"application/json\" id=\"grove-";

struct Data {
  const char* id;         // after "grove-"
  std::string_view text;  // without '<'
};

// The server, if any, from which the page may request data.
enum class Asks { kNone, kItsServer };

// Returns the page as one HTML document. Its content security policy permits no external scripts,
// and no requests except those that `asks` permits.
std::string html(std::string_view title, const PageParts& parts, std::initializer_list<Data> all,
                 Asks asks = Asks::kNone) {
  std::string data;
  for (const auto& [id, text] : all)
    data += fmt::format("{}{}\">{}</script>\n", kDataElement, id, text);
  const bool is_followed = asks == Asks::kItsServer;
  return fmt::format(
      R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:{}">
<title>{}</title>
<style>{}</style>
</head>
<body{}>
<noscript>This page is a program: it needs JavaScript.</noscript>
{}<script>{}</script>
</body>
</html>
)",
      is_followed ? "; connect-src 'self'" : "", escaped(title), parts.style,
      is_followed ? " data-follow" : "", data, parts.program);
}

}  // namespace

bool is_page(std::string_view text) {
  return text.find(kDataElement) != std::string_view::npos;
}

std::string plan_page(std::string_view title, std::string_view data) {
  return html(title, plan_page_parts(), {{"data", data}});
}

std::string run_page(std::string_view title, std::string_view log) {
  return html(title, run_page_parts(), {{"log", without_markup(log)}});
}

std::string following_page(std::string_view title) {
  return html(title, run_page_parts(), {{"log", ""}}, Asks::kItsServer);
}

std::string drive_page(std::string_view title, std::string_view data, std::string_view order,
                       std::string_view drive) {
  return html(title, drive_page_parts(),
              {{"data", data}, {"order", order}, {"drive", without_markup(drive)}});
}

std::string following_drive_page(std::string_view title, std::string_view data,
                                 std::string_view order) {
  return html(title, drive_page_parts(), {{"data", data}, {"order", order}}, Asks::kItsServer);
}

std::string proof_page(std::string_view title, std::string_view data,
                       std::string_view certificate) {
  return html(title, proof_page_parts(), {{"data", data}, {"proof", certificate}});
}

}  // namespace grove::detail
