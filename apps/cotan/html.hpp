// Text and bytes as HTML has them.
#pragma once

#include <string>
#include <string_view>

namespace cotan {

// Text that HTML shows as it is, inside elements and quoted attributes.
std::string escapeHtml(std::string_view text);

// RFC 4648 base64, with padding.
std::string toBase64(std::string_view bytes);

} // namespace cotan
