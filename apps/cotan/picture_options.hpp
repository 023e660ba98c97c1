// The options of `render` and `compare`, which say which model, seen how, drawn by what, as the command line declares
// them: their help and groups. Words and bounds are those of picture/option_words.hpp.
#pragma once

#include <string>

#include "cotan/picture.hpp"
#include "picture/option_words.hpp"
#include "terminal/arguments.hpp"

namespace cotan::app {

// The names of the frames to choose from: those that no input makes NaN. The others are historical, to compare with.
std::string usefulFrameNames();

// Adds --list-frames, which prints all of them, a line for each.
void addListOfFrames(Arguments& a);

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

} // namespace cotan::app
