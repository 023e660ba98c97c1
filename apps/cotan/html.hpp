// Encodes text and bytes for HTML.
#pragma once

#include <string>
#include <string_view>

namespace cotan::app {

// Escapes text for elements and quoted attributes.
std::string escapeHtml(std::string_view text);

// RFC 4648 base64, with padding.
std::string toBase64(std::string_view bytes);

} // namespace cotan::app
