// The words of `render` and `compare`, which say which model, seen how, drawn by what: declared once, for the command
// line and for the C API.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/picture.hpp"
#include "picture/option_words.hpp"
#include "terminal/arguments.hpp"

namespace cotan {

// All frame names; the same, separated by commas.
std::vector<std::string> frameWords();
std::string frameNames();

// The names of the frames to choose from: those that no input makes NaN. The others are historical, to compare with.
std::string usefulFrameNames();

// Adds --list-frames, which prints all of them, a line for each.
void addListOfFrames(Arguments& a);

// A frame's name; the error lists all of them, and begins with the option or the field that it was given for.
Result<Frame> parseFrame(const std::string& text, std::string_view field = "frame");

// What the frame that the normal maps mean is called, where pictures are drawn.
inline constexpr std::string_view kAutoFrame = "auto";

// The same, or kAutoFrame for none.
Result<FrameChoice> parseFrameChoice(const std::string& text, std::string_view field = "frame");

// Adds --memory MIB.
// also: what else it limits, after the picture.
void addMemoryOption(Arguments& a, int& memory, const std::string& also = "");

// Adds --up, y or z. what: whose up it is.
void addUpOption(Arguments& a, Up& up, const std::string& what = "the model's file");

// Adds --tangents, stored or generated.
void addTangentsOption(Arguments& a, TangentOrigin& tangents, const std::string& help);

// Adds --device. use: what its help begins with.
void addDeviceOption(Arguments& a, std::string& device, const std::string& use = "device that draws: ");

// Adds --normal-map, --convention and --material.
void addOwnNormalMap(Arguments& a, OwnMaps& maps);

// Adds --frame, also for kAutoFrame, and --list-frames.
void addFrameOption(Arguments& a, std::string& frame);

// Adds --view.
void addShowOption(Arguments& a, std::string& show);

// Adds all others.
void addPictureOptions(Arguments& a, PictureOptions& options);

} // namespace cotan
