// A self-contained HTML page: a single file without external resources, in the light or dark scheme of the reader.
#pragma once
#include <string>

namespace etendue::bench {

// `title` is plain text, `body` is HTML. A content security policy in the head prevents the page from loading anything.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace etendue::bench
