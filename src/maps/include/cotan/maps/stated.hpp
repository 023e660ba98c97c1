// How a map is to be read: what somebody says of it, and what its file says itself.
#pragma once

#include <string>

#include "cotan/convention_words.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

// The convention to read a map with. A file that stores two channels (BC5, KTX2 and DDS of red and green, grey with
// alpha) is believed: z comes from x and y where the words do not say how. file: its name. channels: Image::channels.
// option: what said the words, for messages.
// Errors: ErrorKind::usage, begun with `option`: the words name three channels, and the file has two;
// ErrorKind::input: the file has one.
Result<Convention> conventionOf(const StatedConvention& stated, const std::string& file, int channels,
                                const std::string& option);

// Undoes damage: the curve on red, green and blue, then their order. Values keep their type; of unorm ones the nearest
// step is taken, which for a map that was saved through the curve by mistake is the step that it had.
void undo(const Damage& damage, Image& image);

} // namespace cotan::maps
