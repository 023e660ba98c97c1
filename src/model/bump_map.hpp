// Grey bump maps as normal maps.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// Whether the picture is grey, as a height map is and a normal map is not: red and blue differ by
// less than 3 % on average (compression leaves some colour in grey pictures).
bool looksLikeHeight(const Image& image);

// The normal map of a height map by central differences, wrapping at the borders: xyz, exact
// expansion, green against +v (glTF's form). White is 1 % of the picture's width above black,
// times `strength`; material files give no unit. 8 bit for 8-bit heights, otherwise 16.
Image normalMapFromHeight(const Image& height, float strength);

} // namespace cotan
