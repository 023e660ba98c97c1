// Declares the options of the table picture/option_table.hpp on the command line, all of them or single ones.
#pragma once

#include <optional>
#include <string>

#include "cotan/picture.hpp"
#include "picture/option_words.hpp"
#include "terminal/arguments.hpp"

namespace cotan::app {

// The names of the frames recommended for use: those that give no NaN for any input. Others are historical.
std::string usefulFrameNames();

// Adds --list-frames, which prints all frames, one per line.
void addListOfFrames(Arguments& a);

// Adds --memory MIB. also: what else it limits, appended to "image".
void addMemoryOption(Arguments& a, int& memory, const std::string& also = "");

// Adds --up, y or z. what: whose up axis it is.
void addUpOption(Arguments& a, Up& up, const std::string& what = "the model's file");
// Adds --high-up, the same for the high mesh.
void addHighUpOption(Arguments& a, std::optional<Up>& up);

// Adds --tangents, stored or generated.
void addTangentsOption(Arguments& a, TangentOrigin& tangents, const std::string& help);

// Adds --device. use: the beginning of its help.
void addDeviceOption(Arguments& a, std::string& device, const std::string& use = "device that draws: ");

// Adds --normal-map, --convention and --material.
void addOwnNormalMap(Arguments& a, OwnMaps& maps);

// Adds --frame, which also accepts kAutoFrame, and --list-frames.
void addFrameOption(Arguments& a, std::string& frame);

// Adds --max-degrees, the limit of chooseFrames.
void addMaxDegreesOption(Arguments& a, double& degrees);

// Adds --view, and --mask for it.
void addShowOption(Arguments& a, PictureOptions& options);

// Adds the model and all other options of the table.
void addPictureOptions(Arguments& a, PictureOptions& options);

} // namespace cotan::app
