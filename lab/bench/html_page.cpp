#include "bench/html_page.h"

#include "metrics/drawing.h"

namespace etendue::bench {
namespace {

constexpr const char* kHead = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<meta http-equiv="Content-Security-Policy"
  content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<meta name="color-scheme" content="light dark">
<style>
:root { --text: #1c2024; --soft: #5b6470; --page: #fff; --card: #f5f6f8; --line: #d9dde3; --accent: #0b63c5;
  --warn: #fff3d6; --bad: #fde4e1 }
@media (prefers-color-scheme: dark) {
  :root { --text: #dde1e6; --soft: #9aa4b0; --page: #15181c; --card: #1f242a; --line: #39404a; --accent: #6cb0ff;
    --warn: #43360f; --bad: #5a2420 }
  .inverts { filter: invert(1) hue-rotate(180deg) }
}
body { font: 15px/1.5 system-ui, sans-serif; color: var(--text); background: var(--page); max-width: 1200px;
  margin: 24px auto; padding: 0 16px }
h1 { font-size: 24px; margin: 0 0 4px } h2 { font-size: 18px; margin: 40px 0 8px }
p, .note { max-width: 80ch } .note { color: var(--soft); font-size: 13px }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums }
th, td { text-align: left; padding: 5px 10px 5px 0; border-bottom: 1px solid var(--line); vertical-align: middle }
thead th { color: var(--soft); font-weight: 500; font-size: 13px }
.scroll { overflow-x: auto }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px }
img { image-rendering: pixelated; display: block }
</style>
<title>)html";

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return kHead + metrics::escape_markup(title) + "</title></head>\n<body>\n" + body + "</body></html>\n";
}

}  // namespace etendue::bench
